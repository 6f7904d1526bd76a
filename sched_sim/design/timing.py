"""N, M, L: when measurements are taken, when they arrive, when the correction must land."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import floor
from typing import Literal

from sched_sim.bounds import whole
from sched_sim.design.taken import Taken
from sched_sim.design.time_limits import check_times
from sched_sim.design.times import Instants, Steps, Times
from sched_sim.errors import InputError, option
from sched_sim.ticks import Number, positive

Feedback = Literal["next-step", "same-step"]


@dataclass(frozen=True, slots=True)
class Timing:
    """The timeline of one filter, in high-rate (HR) steps (Steffes 2014, Sec. II and III.A).

    N: steps between measurement references, k = 0, N, 2N, ...
    M: delay; the measurement of step k is available at the start of m = k + M, 0 <= M.
    L: feedback step; the correction must reach the state by l = k + L, M <= L.

    Where M or L is more than N, several are on their way at once; not every method can have that (`Law.several`).

    instants: where measurements are not whole steps apart, N is the shorter of the intervals, others are N + 1. That
    is the worst, and all intervals count as N, but where several are on their way, or N is 1: there they come as
    they do, k the first step at or after each instant, and m = k + M. None where it does not matter.
    """

    N: int
    M: int
    L: int
    instants: Instants | None = None

    @classmethod
    def at(
        cls, hr_hz: Number, measurement_hz: Number, delay_ms: Number = 0, land_within_ms: Number | None = None
    ) -> Timing:
        """Of an HR loop at this rate, of measurements that come so often and so late, and whose corrections must be in
        the state so long after they were taken; by default before the first is taken after their arrival: L = N where
        M < N, else the next multiple of N (`latest`).

        N and L are rounded down and M up: a measurement is used in the first step at or after its arrival, and L is
        less by the longest time that one waits for its step k (`Times.wait`). Raises InputError as `Times` does.
        """
        rate, times = positive(hr_hz, "hr_hz"), Times.of(measurement_hz, delay_ms, land_within_ms)
        N, M, L = times.steps(rate)
        assert N is not None
        assert M is not None
        check_times(times, Steps(N, M, L), rate, before=None)
        return cls(N, M, latest(N, M) if L is None else L, times.instants(rate))

    def __post_init__(self) -> None:
        for name in ("N", "M", "L"):
            object.__setattr__(self, name, whole(getattr(self, name), name))
        if self.N < 1:
            raise InputError(f"N={self.N} must be at least 1: it is the number of HR steps between measurements")
        if self.M < 0:
            raise InputError(f"M={self.M} must be at least 0: it is the delay of the measurement in HR steps")
        if self.L < self.M:
            raise InputError(
                f"L={self.L} must be >= M={self.M}: the correction cannot land before the measurement arrives; "
                f"give L from {self.M} on, or from {self.M + 1} where it takes a step more (dual-rate with "
                f"next-step feedback)"
            )
        if self.instants is None:
            return
        if floor(self.instants.every) != self.N:
            raise InputError(f"instants {self.instants} and N={self.N} do not agree: N is the shorter interval")
        if self.instants.every.denominator == 1 or (max(self.M, self.L) <= self.N and self.N > 1):
            object.__setattr__(self, "instants", None)

    @property
    def interval(self) -> int | Fraction:
        """HR steps from one measurement to the next, on average."""
        return self.N if self.instants is None else self.instants.every

    @property
    def taken(self) -> Taken:
        """In which steps."""
        return Taken.each(self.interval)


def latest(N: int, M: int) -> int:
    """The L that is meant where none is given: by the step in which the first measurement is taken after this one has
    arrived. Where M < N that is the next one, L = N, as in the paper."""
    return (M // N + 1) * N if N > 0 else M


def one_at_a_time(timing: Timing) -> str | None:
    """Why a method cannot have M > N or L > N if it has one measurement on its way at a time, and what can; None if it
    can."""
    N, M, L = timing.N, timing.M, timing.L
    if N >= L:
        return None
    if M > N:
        return (
            f"M={M} must be <= N={N} with this method: it waits for one measurement at a time, and here others are "
            f"taken before one arrives; choose {option('method')} recalculate, larsen, clone, carried-gain or "
            f"dual-rate, or simulate several on their way with `sched-sim simulate --scenario FILE.toml`, and write in "
            f"it under [[sensor]] `every = {N}` and `delay = {M}`"
        )
    first = min(M + 1, N)
    return (
        f"L={L} must be <= N={N} with this method: the correction must land before the next measurement is taken; "
        f"give L {f'from {first} to N={N}' if first < N else f'of N={N}'}"
    )
