"""N, M and L of a design as someone states them: in steps, or as rates and times."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple, Self

from sched_sim.design.methods import METHODS
from sched_sim.design.options import Options
from sched_sim.design.time_limits import check_times
from sched_sim.design.times import Steps, Times
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.ticks import Number


class Stated(NamedTuple):
    """N, M and L in steps, None where they were not said. words: what times became in steps, as a note; rate: of the HR
    loop, in Hz; times: what holds at any rate of it, None where there is none; said: what of that was given in
    seconds."""

    N: int
    M: int | None
    L: int | None
    words: str
    rate: Fraction | None
    times: Times | None
    said: Times

    @classmethod
    def of(
        cls,
        N: int | None,
        M: int | None,
        L: int | None,
        rate: Fraction | None,
        measurement_hz: Number | None = None,
        delay_ms: Number | None = None,
        land_within_ms: Number | None = None,
    ) -> Self:
        """Raises InputError for times without a rate, for steps and times that do not agree, and if there is no N."""
        times = Times.of(measurement_hz, delay_ms, land_within_ms)
        said = {
            "N": (N, "measurement_hz", measurement_hz),
            "M": (M, "delay_ms", delay_ms),
            "L": (L, "land_within_ms", land_within_ms),
        }
        names = [option(name) for _, name, value in said.values() if value is not None]
        if names and rate is None:
            raise InputError(
                f"{' and '.join(names)} without {option('hr_hz')}: give the rate of the HR loop, such as "
                f"{option('hr_hz')} 400"
            )
        if rate is None:
            return cls(_needed(N), M, L, "", None, None, times)
        became = times.steps(rate)
        for (step, (steps, name, value)), in_steps in zip(said.items(), became, strict=True):
            if steps is not None and in_steps is not None and steps != in_steps:
                raise InputError(
                    f"{option(step)} {steps} and {option(name)} {value} do not agree: at {float(rate):g} Hz that is "
                    f"{option(step)} {in_steps}; leave out the one that is wrong"
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
        return cls(N, M, L, "\n".join(times.words(rate)), rate, held, times)

    @property
    def shown(self) -> str:
        """As the title of a table has it."""
        delay = "none" if self.M is None else self.M
        return f"N={self.N} M={delay} L={'latest' if self.L is None else self.L}"

    def why_none(self, method: str, options: Options) -> str | None:
        """Why this delay leaves the method no L, in the units in which it was given; None if one is left, or if there
        is no such delay."""
        law = METHODS[method].law(options.feedback)
        if law.undelayed or self.M is None or self.M < 0 or self.N < 1:
            return None
        hz, delay_ms = self.said.measurement_hz, self.said.delay_ms
        if hz is None and delay_ms is None:
            return law.why_none(self.N, self.M)
        every = f"N={self.N}" if hz is None else f"{option('measurement_hz')} {float(hz):g}"
        delay = f"M={self.M}" if delay_ms is None else f"{option('delay_ms')} {float(delay_ms):g}"
        return law.why_none(self.N, self.M, f"{delay} and {every}")

    def timing(self, method: str, options: Options) -> Timing:
        """With the latest L that the method can have, if none was said. Raises InputError for a delay or a landing that
        it cannot have. Some methods can have several measurements on their way, so that M and L may be more than N. Of
        the standard filter, to which nothing is late, M and L are 0."""
        law = METHODS[method].law(options.feedback)
        delay = None if self.said.delay_ms is None else f"{option('delay_ms')} {float(self.said.delay_ms):g}"
        M = 0 if law.undelayed else self.M
        if self.rate is not None and M is not None and not (law.undelayed and self.M):
            before = None if law.several else law.before
            check_times(self.said, Steps(self.N, M, self.L), self.rate, law.after, before)
        if self.L is not None and M is not None and self.L < M:
            raise InputError(
                f"L={self.L} is less than M={M}: the correction cannot land before the measurement arrives; give L "
                f"from {M + law.after} on"
            )
        timing = _timing(self.N, self.M, self.L, method, options, delay)
        if method == "standard":
            return Timing(timing.N, 0, 0)
        if self.rate is None or self.times is None or law.undelayed:
            return timing
        return replace(timing, instants=self.times.instants(self.rate))


def _needed(N: int | None) -> int:
    if N is None:
        raise InputError(
            f"{option('N')} is missing: give the HR steps from one measurement to the next, such as {option('N')} 10, "
            f"or {option('measurement_hz')} with {option('hr_hz')}"
        )
    return N


def _timing(N: int, M: int | None, L: int | None, method: str, options: Options, delay: str | None = None) -> Timing:
    """With L the latest that the method can have, if it was not said. Multirate methods have no delay.

    delay: as it was written, where that was not M.
    """
    law = METHODS[method].law(options.feedback)
    if law.undelayed:
        if M:
            said = delay or f"{option('M')} {M}"
            raise InputError(
                f"{said}: {method} has no delay, it uses each measurement in its step: for a late one choose "
                f"{option('method')} recalculate, larsen, clone, carried-gain or dual-rate; without delay leave "
                f"{said.split()[0]} out"
            )
        M = 0
    if M is None:
        raise InputError(
            f"{option('M')} is missing: give the delay of the measurement in HR steps, such as {option('M')} 4, or "
            f"{option('delay_ms')} with {option('hr_hz')} (multirate and robust methods have none)"
        )
    if L is None:
        L = law.latest(N, M) if M >= 0 else M
    return Timing(N, M, L)
