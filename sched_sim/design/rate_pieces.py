"""Rates between which N, M and L of a design in seconds do not change.

N, M and L are steps of the rate, so whether a design fits goes up and down with it: at a rate at which the delay is a
whole number of steps it fits, and just above it not. Between two rates at which one of them changes, all three are
what they are, and so is the least speed, in work per HR period, or it changes at a few rates that are known: there the
best rate is known exactly. Such pieces are
taken from the top; whole ranges of them are left out together where they need more than there is (`necessary`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from sched_sim.bounds import MOST_STEPS
from sched_sim.design.demand import Demand, total_window, update_window, work_of
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import least_speed
from sched_sim.design.method import Law
from sched_sim.design.methods import method_of
from sched_sim.design.necessary import Range, demands
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts, JobCosts, converted, works
from sched_sim.design.times import Instants, Times
from sched_sim.design.timing import Timing
from sched_sim.design.uneven import PRODUCT_FROM, comes_unevenly, longest_job
from sched_sim.errors import InputError
from sched_sim.ticks import ticks_per_unit, to_ticks

DIGITS = 4
"""To so many the rate is rounded down, where that fits as well; else to the next number of digits that does."""

MOST_DIGITS = 12
"""A rate that fits alone, such as 1000/7 Hz, is not rounded."""

SOON, FINER = 8, 10**6
"""Intervals that repeat after so few measurements are looked at one by one, others as if after many times as many."""

MOST_CHANGES = 64
"""Where so many may be on their way that there are more numbers of them than this, one rate in a piece is looked at."""


class Pieces(NamedTuple):
    """Rates in whole units, of which `per_hz` make a hertz; between two at which a step changes lies one more.

    by_N, by_M, by_L: N, M and L change at the multiples of these; 0: never. L_bound: whether corrections must land by a
    time of their own. costs_in_ticks: at `per_cost` ticks per unit of the costs.
    """

    costs: Costs
    options: Options
    law: Law
    per_hz: int
    by_N: int
    by_M: int
    by_L: int
    L_bound: bool
    per_cost: int
    costs_in_ticks: JobCosts[int]

    @classmethod
    def of(cls, costs: Costs, times: Times, options: Options) -> Pieces:
        law = method_of(costs).law(options.feedback)
        assert times.measurement_hz is not None
        delay_ms = None if law.undelayed else times.delay_ms
        changes = [times.measurement_hz]
        changes += [Fraction(1000) / ms if ms else Fraction(0) for ms in (delay_ms, times.land_within_ms)]
        per_hz = 2 * ticks_per_unit(changes)
        by_N, by_M, by_L = (to_ticks(change, per_hz) for change in changes)
        costs = converted(costs, Fraction)
        per_cost = ticks_per_unit(works(costs))
        in_ticks = converted(costs, lambda work: to_ticks(work, per_cost))
        return cls(costs, options, law, per_hz, by_N, by_M, by_L, times.land_within_ms is not None, per_cost, in_ticks)

    @property
    def one_in_flight(self) -> bool:
        """Whether at no rate a correction is on its way that costs something when the next measurement is taken."""
        if self.law.only_first or not self.law.several:
            return True
        interval, delay, landing = (Fraction(1, by) if by else Fraction(0) for by in (self.by_N, self.by_M, self.by_L))
        return delay < interval and landing <= interval

    def hz(self, units: int) -> Fraction:
        return Fraction(units, self.per_hz)

    def steps(self, rate: int | Fraction) -> tuple[int, int, int]:
        """N, M and L at a rate in units, as `Times.steps` has them; where measurements are not whole steps apart they
        may wait for a step up to nearly one, which is taken for one."""
        N = int(rate // self.by_N)
        M = int(-(-rate // self.by_M)) if self.by_M else 0
        wait = 1 if rate % self.by_N else 0
        latest = self.law.latest(N, M)
        if not self.L_bound:
            return N, M, latest
        L = self.landing(rate) - wait
        return N, M, L if self.law.several else min(latest, L)

    def instants(self, rate: int | Fraction) -> Instants:
        return Instants(Fraction(rate) / self.by_N, Fraction(rate) / self.by_M if self.by_M else Fraction(0))

    def landing(self, rate: int | Fraction) -> int:
        """The last step that starts by the time by which corrections must land."""
        return int(rate // self.by_L) if self.by_L else 0

    def timing(self, rate: int | Fraction) -> Timing | None:
        """None where the method can have none."""
        N, M, L = self.steps(rate)
        if not 1 <= N <= MOST_STEPS or (M > N and not self.law.several):
            return None
        if self.one_in_flight and not self.law.one_in_flight(N, L):
            return None
        try:
            timing = Timing(N, M, L, self.instants(rate))
            method_of(self.costs).check_design(self.costs, timing, self.options.feedback)
        except InputError:
            return None
        return timing

    def fits(self, rate: Fraction) -> bool:
        """In hertz; in closed form."""
        timing = self.timing(rate * self.per_hz)
        return timing is not None and landing(self.costs, timing, 1 / rate, self.options, ()) is not None

    def possible(self, low: int | Fraction, high: int | Fraction, rate: int | Fraction | None = None) -> bool:
        """Whether a rate with the steps of one from low to high may fit, which is at least `rate`, by default low."""
        least_N, least_M, _ = self.steps(low)
        most_N, most_M, _ = self.steps(high)
        most_L = self.law.latest(most_N, most_M)
        if self.L_bound:
            most_L = self.landing(high) if self.law.several else min(most_L, self.landing(high))
        if least_N > MOST_STEPS or (least_M > most_N and not self.law.several) or most_L < least_M:
            return False
        timings = Range(least_N, most_N, least_M, most_M, most_L)
        period, rate = self.per_hz * self.per_cost, low if rate is None else rate  # in ticks of work, at a rate of 1
        costs = self.costs_in_ticks
        if isinstance(costs, DualRateCosts) and not self.one_in_flight:
            return costs.hr * rate <= period
        return all(work * rate <= periods * period for work, periods in demands(costs, timings, self.options))

    def change_between(self, low: int, high: int) -> int | None:
        """A rate at which a step changes, near the middle of those between; None if there is none."""
        for by in (self.by_N, self.by_M, self.by_L):
            if by:
                first, last = low // by + 1, -(-high // by) - 1
                if first <= last:
                    return (first + last) // 2 * by
        return None

    def pieces(self, low: int, high: int) -> Iterator[tuple[int, int]]:
        """Of the rates from low to high, not low itself, those between two changes and the upper of them: from the top,
        without those that cannot fit."""
        ranges = [(low, high)]
        while ranges:
            low, high = ranges.pop()
            if not self.possible(low, high):
                continue
            middle = self.change_between(low, high)
            if middle is None:
                yield low, high
            else:
                ranges += [(low, middle), (middle, high)]

    @property
    def range(self) -> tuple[int, int]:
        """Of all rates: that of the measurements is just above the lower end."""
        return self.by_N - 1, (MOST_STEPS + 1) * self.by_N

    def highest(self) -> Fraction | None:
        for low, high in self.pieces(*self.range):
            if self.possible(high, high) and self.fits(self.hz(high)):
                return rounded_down(self.hz(high), self.fits)
            if (found := self._highest_between(low, high)) is not None:
                return found
        return None

    def _highest_between(self, low: int, high: int) -> Fraction | None:
        """Where N, M and L do not change: the least speed there, or all but the upper end."""
        middle = (low + high) // 2
        timing = self.timing(middle) if low < middle < high else None
        if timing is None or not self.possible(middle, middle, low):
            return None
        if comes_unevenly(self.costs, timing):
            return self._highest_of_several(low, high, timing)
        below, above = self.hz(low), self.hz(high)
        best = 1 / least_speed(self.costs, timing, self.options).speed
        if best <= below:
            return None
        if best < above:
            return rounded_down(best, self.fits)
        found = rounded_down(above, lambda rate: below < rate < above and self.fits(rate))
        if found is not None:
            return found
        return next(
            (
                rounded_down(1 / pace, self.fits)
                for pace in sorted(_paces(self.costs_in_ticks, self.per_cost, timing, self.options))
                if below < 1 / pace < above and self.fits(1 / pace)
            ),
            None,
        )

    def _highest_of_several(self, low: int, high: int, timing: Timing) -> Fraction | None:
        """The same of methods whose work hangs on the intervals of measurements too: it is another beyond each rate at
        which so many of them are as long as it takes to arrive, or as a step more or less. Beside that, intervals that
        repeat soon are looked at, for which there may be less."""
        number = range(timing.M // (timing.N + 1), (timing.M + 1) // timing.N + 2)
        if len(number) > MOST_CHANGES:
            return self._highest_alike(low, high)
        changes = {Fraction(self.by_N * (timing.M + more), count) for count in number if count for more in (-1, 0, 1)}
        for count in number:
            if apart := Fraction(1, self.by_M) - Fraction(count, self.by_N):
                changes |= {steps / apart for steps in (1, PRODUCT_FROM)}
        ends: list[int | Fraction] = [low, *sorted(change for change in changes if low < change < high), high]
        alike = (self._highest_alike(below, above) for below, above in reversed([*pairwise(ends)]))
        found = next((rate for rate in alike if rate is not None), None)
        soon = {
            self.hz(1) * self.by_N * (timing.N + Fraction(part, count))
            for count in range(2, SOON + 1)
            for part in range(1, count)
        }
        alone = (rate for rate in sorted(soon, reverse=True) if low < rate * self.per_hz < high)
        higher = next((rate for rate in alone if (found is None or rate > found) and self.fits(rate)), None)
        return found if higher is None else rounded_down(higher, self.fits)

    def _highest_alike(self, low: int | Fraction, high: int | Fraction) -> Fraction | None:
        below, above = self.hz(1) * low, self.hz(1) * high
        timing = self.timing(Fraction(low + high) / 2)
        if timing is None or not comes_unevenly(self.costs, timing):
            return None
        if self.possible(high, high) and self.fits(above):
            return rounded_down(above, self.fits)
        best = min(1 / longest_job(self.costs, timing, FINER), above)
        return rounded_down(best, lambda rate: below < rate < above and self.fits(rate)) if best > below else None


def _paces(costs: JobCosts[int], per_cost: int, timing: Timing, options: Options) -> Iterator[Fraction]:
    """Speeds at which the dual-rate filter may begin to fit: where one that is a little slower lands later and fits,
    and one a little faster lands earlier, in a step that has more to do (`least_speed`), it takes one of these."""
    if not isinstance(costs, DualRateCosts):
        return
    jobs = [costs.hr, costs.hr_restart]
    for job in jobs:
        yield Fraction(job + costs.hr_update, per_cost)
    if options.feedback == "next-step":
        return
    work = work_of(costs, options)
    for following in (0, *(jobs if work.separate else ())):
        more = costs.hr_update + following
        for job in jobs:
            yield Fraction(job + more, 2 * per_cost)
        for end in range(timing.M + 1, min(timing.L + 2, timing.N) + 1):
            for later in (0, more):
                yield _pace(update_window(work, timing.N, timing.M, end, later), per_cost)
                yield _pace(total_window(work, timing.N, end, later), per_cost)


def _pace(demand: Demand, per_cost: int) -> Fraction:
    return Fraction(demand[0], demand[1] * per_cost)


def rounded_down(rate: Fraction, fits: Callable[[Fraction], bool]) -> Fraction | None:
    """To the fewest digits, at least `DIGITS`, at which it fits; where no more than `MOST_DIGITS` do, the rate itself,
    or None if that does not either."""
    for digits in range(DIGITS, MOST_DIGITS + 1):
        unit = last_digit(rate, digits)
        for number in (rate // unit, -(-rate // unit) - 1):
            if number and fits(number * unit):
                return number * unit
    return rate if fits(rate) else None


def last_digit(rate: Fraction, digits: int = DIGITS) -> Fraction:
    """What the last of so many digits of a rate counts."""
    exponent = len(str(rate.numerator)) - len(str(rate.denominator))
    if rate < Fraction(10) ** exponent:
        exponent -= 1
    return Fraction(10) ** (exponent + 1 - digits)
