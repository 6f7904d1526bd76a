"""When measurements are taken and when they arrive, in steps and in time; a shipped model has its own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, floor

from filters.accuracy.pattern import Interval
from filters.accuracy.shipped import ShippedModel
from sched_sim.bounds import whole
from sched_sim.design.times import Times
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.ticks import Number, exact, positive


@dataclass(frozen=True, slots=True)
class Sampling:
    """N, M: steps between measurements, and those until one arrives, as in `Timing`, but M may be above N.

    hr_hz: steps in a second, None if that was not said; times: what holds at any rate then.
    """

    N: int
    M: int
    hr_hz: Fraction | None = None
    times: Times | None = None

    @classmethod
    def of(
        cls,
        shipped: ShippedModel | None = None,
        N: int | None = None,
        M: int | None = None,
        hr_hz: Number | None = None,
        measurement_hz: Number | None = None,
        delay_ms: Number | None = None,
    ) -> Sampling:
        """What a shipped model has stands for what is not given. Raises InputError for what cannot be."""
        asked = with_defaults(shipped, N, M, hr_hz, measurement_hz, delay_ms)
        rate = None if asked.hr_hz is None else positive(asked.hr_hz, option("hr_hz"))
        times = Times.of(asked.measurement_hz, asked.delay_ms)
        if rate is None and times != Times():
            raise InputError(
                f"{option('measurement_hz')} and {option('delay_ms')} need {option('hr_hz')}, the rate of the HR loop"
            )
        steps = Times().steps(Fraction(1)) if rate is None else times.steps(rate)
        N, M = steps.N if asked.N is None else asked.N, steps.M if asked.M is None else asked.M
        if N is None or M is None:
            what = option("N") if N is None else option("M")
            raise InputError(f"{what} is missing: give it in HR steps, or rates and times with {option('hr_hz')}")
        if whole(N, "N") < 1:
            raise InputError(f"{option('N')} is {N}: give at least 1 step between measurements")
        if whole(M, "M") < 0:
            raise InputError(f"{option('M')} is {M}: give 0 or more steps of delay")
        if rate is not None:
            period_ms = 1000 / rate
            times = replace(
                times,
                measurement_hz=times.measurement_hz or rate / N,
                delay_ms=M * period_ms if times.delay_ms is None else times.delay_ms,
            )
        return cls(N, M, rate, None if rate is None else times)

    def using(self, every: int) -> Sampling:
        """Every so manieth measurement alone."""
        if every == 1:
            return self
        if self.times is None or self.times.measurement_hz is None or self.hr_hz is None:
            return replace(self, N=every * self.N)
        hz = self.times.measurement_hz / every
        return replace(self, N=floor(self.hr_hz / hz), times=replace(self.times, measurement_hz=hz))

    def timing(self, delay: int, L: int) -> Timing:
        """Of the filter that has so many steps of delay, and lands at L."""
        instants = None if self.times is None or self.hr_hz is None else self.times.instants(self.hr_hz)
        return Timing(self.N, delay, L, instants)

    @property
    def between(self) -> Interval:
        """Steps from one measurement to the next, a quotient where N is the shorter of two intervals."""
        if self.times is None or self.times.measurement_hz is None or self.hr_hz is None:
            return self.N
        between = self.hr_hz / self.times.measurement_hz
        return int(between) if between.denominator == 1 else between

    def taken(self, steps: int) -> list[int]:
        """The steps in which measurements are taken, up to this one."""
        return [ceil(number * self.between) for number in range(floor(steps / self.between) + 1)]

    def oldest_ms(self, L: int) -> float | None:
        """From when a measurement is taken until just before the landing of the next, L steps after its own; at the
        most."""
        if self.hr_hz is None:
            return None
        between = Fraction(self.between)
        return float((L + between - Fraction(1, between.denominator)) * 1000 / self.hr_hz)

    def mean_age_ms(self, L: int) -> float | None:
        """From when a measurement is taken to the outputs in which it is the newest, on average."""
        if self.hr_hz is None:
            return None
        between = Fraction(self.between)
        return float((L + (between - Fraction(1, between.denominator)) / 2) * 1000 / self.hr_hz)

    def ms(self, steps: float | None) -> float | None:
        """From when a measurement is taken to so many steps after its own, at the latest."""
        if steps is None or self.hr_hz is None or self.times is None:
            return None
        return float((exact(steps, "steps") + self.times.wait(self.hr_hz)) * 1000 / self.hr_hz)

    @property
    def delay_s(self) -> float | None:
        """Until a measurement is used, as M steps."""
        return None if self.hr_hz is None else float(self.M / self.hr_hz)


@dataclass(frozen=True, slots=True)
class Asked:
    """As they were given, or a shipped model has them."""

    N: int | None
    M: int | None
    hr_hz: Number | None
    measurement_hz: Number | None
    delay_ms: Number | None


def with_defaults(
    shipped: ShippedModel | None,
    N: int | None,
    M: int | None,
    hr_hz: Number | None,
    measurement_hz: Number | None,
    delay_ms: Number | None,
) -> Asked:
    """The rate of the HR loop, the interval of measurements and the delay, where they were not given in either form."""
    if shipped is None:
        return Asked(N, M, hr_hz, measurement_hz, delay_ms)
    if hr_hz is None:
        hr_hz = exact(shipped.hr_hz, "hr_hz")
    if N is None and measurement_hz is None:
        measurement_hz = 1 / exact(shipped.interval_s, "interval_s")
    if M is None and delay_ms is None:
        delay_ms = 1000 * exact(shipped.delay_s, "delay_s")
    return Asked(N, M, hr_hz, measurement_hz, delay_ms)
