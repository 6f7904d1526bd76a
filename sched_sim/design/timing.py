"""N, M, L: when measurements are taken, when they arrive, when the correction must land."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from sched_sim.bounds import check_whole
from sched_sim.errors import InputError

Feedback = Literal["next-step", "same-step"]


@dataclass(frozen=True, slots=True)
class Timing:
    """The timeline of one filter, in high-rate (HR) steps (Steffes 2014, Sec. II and III.A).

    N: steps between measurement references, k = 0, N, 2N, ...
    M: delay; the measurement of step k is available at the start of m = k + M, 0 <= M <= N.
    L: feedback step; the correction must reach the state by l = k + L, M <= L <= N.
    """

    N: int
    M: int
    L: int

    def __post_init__(self) -> None:
        check_whole(self.N, "N")
        if self.N < 1:
            raise InputError(f"N={self.N} must be at least 1: it is the number of HR steps between measurements")
        if self.M < 0:
            raise InputError(f"M={self.M} must be at least 0: it is the delay of the measurement in HR steps")
        if self.M > self.N:
            raise InputError(f"M={self.M} must be <= N={self.N}: {several_in_flight(self.N, self.M)}")
        if self.L < self.M:
            raise InputError(
                f"L={self.L} must be > M={self.M}: the correction cannot land before the measurement arrives; "
                f"give L {_up_to(min(self.M + 1, self.N), self.N)}"
            )
        if self.L > self.N:
            raise InputError(
                f"L={self.L} must be <= N={self.N}: the correction must land before the next measurement is taken; "
                f"give L {_up_to(min(self.M + 1, self.N), self.N)}"
            )


def _up_to(first: int, N: int) -> str:
    return f"from {first} to N={N}" if first < N else f"of N={N}"


def several_in_flight(N: int, M: int) -> str:
    """Why no method here can have M > N, and what can."""
    return (
        f"these methods wait for one measurement at a time, and here others are taken before one arrives; simulate "
        f"several on their way with `sched-sim simulate --scenario FILE.toml`, and write in that file under [[sensor]] "
        f"`every = {N}` and `delay = {M}`"
    )


def latest_feedback_step(N: int, feedback: Feedback) -> int:
    """The largest L that the dual-rate filter may have: N, or N - 1 with same-step feedback."""
    return N if feedback == "next-step" else N - 1


INSTEAD = "choose --method recalculate or larsen, which correct the state in that very step"
"""Of the dual-rate filter, where M = N leaves it no step."""


def check_dual_rate(timing: Timing, feedback: Feedback) -> None:
    """Raises InputError unless M < L <= N (next-step) or M <= L < N (same-step)."""
    N, M, L = timing.N, timing.M, timing.L
    if feedback == "next-step" and L <= M:
        advice = f"give L from {M + 1} to N={N} (same-step feedback allows L = M)" if M < N else INSTEAD
        raise InputError(
            f"L={L} must be > M={M}: the dual-rate correction cannot land in the step in which the measurement "
            f"arrives; {advice}"
        )
    if feedback == "same-step" and L >= N:
        advice = f"give L from {M} to {N - 1}" if M < N else INSTEAD
        raise InputError(f"L={L} must be < N={N} with same-step feedback: the correction lands during step l; {advice}")


def impossible(method: str, timing: Timing) -> str | None:
    """Why the dual-rate filter cannot have this timing although other methods can: the measurement arrives as the next
    one is taken. None if it can, and for any other method."""
    if method == "dual-rate" and timing.M == timing.N:
        return f"with M=N={timing.N} no step is left to it between the measurement's arrival and the next one"
    return None


def check_two_rate(timing: Timing) -> None:
    """Raises InputError unless 1 <= L: what the LR job of step k computes is in use in step k + 1 at the earliest."""
    if timing.L < 1:
        raise InputError(
            f"L={timing.L} must be at least 1: what the LR job computes is in use from the next step on; "
            f"give L from 1 to N={timing.N}"
        )
