"""N, M and L of a command, given in steps or as rates and times."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from sched_sim.cli import options as opt
from sched_sim.design.options import Options
from sched_sim.design.times import Steps, Times
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from sched_sim.design.timing import Timing


class Design(NamedTuple):
    """What the user said of the steps. words: what times became in steps, as a note; times: what holds at any rate of
    the HR loop, None where there is none; said: what of that was given in seconds."""

    N: int
    M: int | None
    L: int | None
    words: str
    rate: Fraction | None
    times: Times | None
    said: Times

    @property
    def shown(self) -> str:
        """As the title of a table has it."""
        delay = "none" if self.M is None else self.M
        return f"N={self.N} M={delay} L={'latest' if self.L is None else self.L}"

    def why_none(self, method: str, options: Options) -> str | None:
        """Why this delay leaves the method no L, in the units in which it was given; None if one is left, or if there
        is no such delay."""
        from sched_sim.design.methods import METHODS

        law = METHODS[method].law(options.feedback)
        if law.undelayed or self.M is None or self.M < 0 or self.N < 1:
            return None
        hz, delay_ms = self.said.measurement_hz, self.said.delay_ms
        if hz is None and delay_ms is None:
            return law.why_none(self.N, self.M)
        every = f"N={self.N}" if hz is None else f"--measurement-hz {float(hz):g}"
        delay = f"M={self.M}" if delay_ms is None else f"--delay-ms {float(delay_ms):g}"
        return law.why_none(self.N, self.M, f"{delay} and {every}")

    def timing(self, method: str, options: Options) -> Timing:
        """With the latest L that the method can have, if none was said. Raises InputError for a delay or a landing that
        it cannot have. Some methods can have several measurements on their way, so that M and L may be more than N. Of
        the standard filter, to which nothing is late, M and L are 0."""
        from sched_sim.design.methods import METHODS
        from sched_sim.design.time_limits import check_times
        from sched_sim.design.timing import Timing

        law = METHODS[method].law(options.feedback)
        delay = None if self.said.delay_ms is None else f"--delay-ms {float(self.said.delay_ms):g}"
        M = 0 if law.undelayed else self.M
        if self.rate is not None and M is not None and not (law.undelayed and self.M):
            before = None if law.several else law.before
            check_times(self.said, Steps(self.N, M, self.L), self.rate, law.after, before)
        if self.L is not None and M is not None and self.L < M:
            raise InputError(
                f"L={self.L} is less than M={M}: the correction cannot land before the measurement arrives; give L "
                f"from {M + law.after} on"
            )
        timing = opt.make_timing(self.N, self.M, self.L, method, options, delay)
        if method == "standard":
            return Timing(timing.N, 0, 0)
        if self.rate is None or self.times is None or law.undelayed:
            return timing
        return replace(timing, instants=self.times.instants(self.rate))


def make_design(
    N: int | None,
    M: int | None,
    L: int | None,
    rate: Fraction | None,
    measurement_hz: str | None = None,
    delay_ms: str | None = None,
    land_within_ms: str | None = None,
) -> Design:
    """Raises InputError for times without a rate, for steps and times that do not agree, and if there is no N."""
    times = Times.of(measurement_hz, delay_ms, land_within_ms)
    said = {
        "-N": (N, "--measurement-hz", measurement_hz),
        "-M": (M, "--delay-ms", delay_ms),
        "-L": (L, "--land-within-ms", land_within_ms),
    }
    flags = [flag for _, flag, value in said.values() if value is not None]
    if flags and rate is None:
        raise InputError(f"{' and '.join(flags)} without --hr-hz: give the rate of the HR loop, such as --hr-hz 400")
    if rate is None:
        return Design(_needed(N), M, L, "", None, None, times)
    became = times.steps(rate)
    for (short, (steps, flag, value)), in_steps in zip(said.items(), became, strict=True):
        if steps is not None and in_steps is not None and steps != in_steps:
            raise InputError(
                f"{short} {steps} and {flag} {value} do not agree: at {float(rate):g} Hz that is {short} {in_steps}; "
                f"leave out the one that is wrong"
            )
    N, M, L = (step if step is not None else other for step, other in zip((N, M, L), became, strict=True))
    N = _needed(N)
    held = Times(
        times.measurement_hz or rate / N,
        times.delay_ms if times.delay_ms is not None or M is None else M * 1000 / rate,
        times.land_within_ms,
    )
    if L is not None and held.land_within_ms is None:
        held = replace(held, land_within_ms=held.landing_ms(L, rate))
    return Design(N, M, L, "\n".join(times.words(rate)), rate, held, times)


def _needed(N: int | None) -> int:
    if N is None:
        raise InputError(
            "-N is missing: give the HR steps from one measurement to the next, such as -N 10, or --measurement-hz "
            "with --hr-hz"
        )
    return N
