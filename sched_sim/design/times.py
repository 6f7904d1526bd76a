"""A design in hertz and milliseconds, and what it is in steps of the HR loop at a rate.

One rule for what does not divide: a measurement is of the first step at or after the instant at which it is taken, is
used in the first at or after its arrival, and nothing is promised later than it was asked for. So the interval between
measurements is that of the shortest, the delay is rounded up, and the time by which the correction must land is rounded
down, for the measurement that waits longest for its step.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor
from typing import NamedTuple

from sched_sim.bounds import MOST_STEPS, short
from sched_sim.errors import InputError, option
from sched_sim.ticks import Number, exact, positive


class Steps(NamedTuple):
    """N, M and L as in `Timing`; None for what was not said."""

    N: int | None
    M: int | None
    L: int | None


class Instants(NamedTuple):
    """When measurements are taken, and how much later they arrive, in HR steps that need not be whole."""

    every: Fraction
    delay: Fraction


@dataclass(frozen=True, slots=True)
class Times:
    """What holds at any rate of the HR loop; each None if it was not said.

    measurement_hz: rate of the measurements, the first at the start of a step; delay_ms: from when one is taken until
    it is there; land_within_ms: from when it is taken until its correction must be in the state.
    Raises InputError for a rate or a time that cannot be.
    """

    measurement_hz: Fraction | None = None
    delay_ms: Fraction | None = None
    land_within_ms: Fraction | None = None

    @classmethod
    def of(
        cls,
        measurement_hz: Number | None = None,
        delay_ms: Number | None = None,
        land_within_ms: Number | None = None,
    ) -> Times:
        """Of numbers as people write them."""
        times = cls(
            None if measurement_hz is None else positive(measurement_hz, option("measurement_hz")),
            None if delay_ms is None else exact(delay_ms, option("delay_ms")),
            None if land_within_ms is None else exact(land_within_ms, option("land_within_ms")),
        )
        if times.delay_ms is not None and times.delay_ms < 0:
            raise InputError(
                f"{option('delay_ms')} is {delay_ms}: it must be 0 or more, for no measurement arrives before it is "
                f"taken"
            )
        if times.land_within_ms is not None and times.land_within_ms < (times.delay_ms or 0):
            raise InputError(
                f"{option('land_within_ms')} is {land_within_ms}: it must not be less than the delay, "
                f"{float(times.delay_ms or 0):g} ms, for no correction lands before its measurement arrives"
            )
        return times

    def steps(self, hr_hz: Fraction) -> Steps:
        """At this rate. Raises InputError for measurements that come more often than steps, and for too many steps."""
        N = None if self.measurement_hz is None else floor(hr_hz / self.measurement_hz)
        if N == 0:
            raise InputError(
                f"{option('measurement_hz')} {float(self.measurement_hz or 0):g} is above {option('hr_hz')} "
                f"{float(hr_hz):g}: a step takes one measurement at the most"
            )
        M = None if self.delay_ms is None else ceil(self.delay_ms * hr_hz / 1000)
        L = None if self.land_within_ms is None else floor(self.land_within_ms * hr_hz / 1000 - self.wait(hr_hz))
        for name, steps in (("measurement_hz", N), ("delay_ms", M), ("land_within_ms", L)):
            if steps is not None and steps > MOST_STEPS:
                raise InputError(
                    f"{option('hr_hz')} {float(hr_hz):g} and {option(name)} {float(getattr(self, name)):g} make "
                    f"{short(steps)} HR steps: give values that make at most {MOST_STEPS:,}"
                )
        return Steps(N, M, L)

    def instants(self, hr_hz: Fraction) -> Instants | None:
        """At this rate; None if measurements are whole steps apart, or it was not said how far."""
        if self.measurement_hz is None or (every := hr_hz / self.measurement_hz).denominator == 1:
            return None
        return Instants(every, (self.delay_ms or Fraction(0)) * hr_hz / 1000)

    def wait(self, hr_hz: Fraction) -> Fraction:
        """The longest time, in HR steps, from when a measurement is taken to the start of its step k: where two of them
        are p / q steps apart, (q - 1) / q of one; 0 where the rate of measurements was not said."""
        if self.measurement_hz is None:
            return Fraction(0)
        parts = (hr_hz / self.measurement_hz).denominator
        return Fraction(parts - 1, parts)

    def landing_ms(self, L: int, hr_hz: Fraction) -> Fraction:
        """From when a measurement is taken to the start of step k + L, at the latest."""
        return (L + self.wait(hr_hz)) * 1000 / hr_hz

    def words(self, hr_hz: Fraction) -> Iterator[str]:
        """What each became, and how it was rounded."""
        N, M, L = self.steps(hr_hz)
        period_ms = 1000 / hr_hz
        if N is not None and self.measurement_hz is not None:
            between = hr_hz / self.measurement_hz
            rounded = ""
            if between != N:
                rounded = (
                    f", the shorter of the intervals of {N} and {N + 1} between measurements; each is taken up to "
                    f"{_ms(self.landing_ms(0, hr_hz))} before its step k, and landings in ms are from then"
                )
            yield f"{float(self.measurement_hz):g} Hz: N = {N} steps{rounded}"
        if M is not None and self.delay_ms is not None:
            used = "" if M * period_ms == self.delay_ms else f", used in the first step after: {_ms(M * period_ms)}"
            yield f"{_ms(self.delay_ms)} late: M = {M} steps{used}"
        if L is not None and self.land_within_ms is not None:
            latest_ms = self.landing_ms(L, hr_hz)
            rounded = "" if latest_ms == self.land_within_ms else f", the last one by then: {_ms(latest_ms)}"
            yield f"lands within {_ms(self.land_within_ms)}: L = {L} steps{rounded}"


def _ms(value: Fraction) -> str:
    return f"{float(value):.6g} ms"
