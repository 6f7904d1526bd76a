"""The highest rate where there is no closed form: with other work on the processor, or several corrections on their
way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice, pairwise
from typing import NamedTuple

from sched_sim.design.landing import landing
from sched_sim.design.load import loads
from sched_sim.design.rate_pieces import Pieces, last_digit, rounded_down
from sched_sim.errors import InputError
from sched_sim.schedule.jobs import HR
from sched_sim.schedule.tasks import Task

LOOKS = 24
"""So many rates, spread over those between, are looked at beside what bisection finds."""

STEPS_LOOKED_AT = 50_000
"""Of all looks together, at the most, but for four of them."""

LOCKED_LOOKS = 96
"""So many rates at which the phases of tasks are locked are looked at, spread over those between; fewer where
measurements are many steps apart. Most that do not fit miss a deadline soon."""


class Search(NamedTuple):
    """With other work on the processor. tasks: in HR periods of hr_hz."""

    pieces: Pieces
    tasks: tuple[Task, ...]
    hr_hz: Fraction

    def fits(self, rate: Fraction) -> bool:
        """At any phase."""
        timing = self.pieces.timing(rate * self.pieces.per_hz)
        if timing is None:
            return False
        costs, options, tasks = self.pieces.costs, self.pieces.options, _of_any_phase(self._tasks_at(rate))
        try:
            if not tasks:
                return landing(costs, timing, 1 / rate, options, ()) is not None
            from sched_sim.design.any_phase import late_job

            return late_job(costs, timing, 1 / rate, options, tasks) is None
        except InputError:
            return False

    def _tasks_at(self, rate: Fraction) -> list[Task]:
        return _at(self.tasks, rate / self.hr_hz)

    def highest(self) -> Fraction | None:
        least, most = self.pieces.range
        top = next(self.pieces.pieces(least, most), None)
        if top is None:
            return None
        above = self._not_too_much(self.pieces.hz(top[1]))
        drifting = self._at_any_phase(above)
        locked = self._locked(drifting or self.pieces.hz(least), above)
        return next(filter(self._fits_as_given, locked), drifting)

    def _locked(self, low: Fraction, high: Fraction) -> Iterator[Fraction]:
        """Rates between, from the top, which may fit, and at which the period of one task of given offset is a whole
        number of HR periods. The shortest first, which have the fewest: all together at most `LOCKED_LOOKS`."""
        if self.pieces.options.policy == "fixed":  # a more urgent job must leave something of each HR period
            high = min([high, *(2 / task.cost for task in self.tasks if _is_ahead(task))])
        N = int(high * self.pieces.per_hz) // self.pieces.by_N
        looks = max(min(LOCKED_LOOKS, LOCKED_LOOKS * STEPS_LOOKED_AT // (N + 1)), 4)
        rates: set[Fraction] = set()
        for hz in sorted({self.hr_hz / task.period for task in self.tasks if task.offset != "any"}, reverse=True):
            numbers = range(int(high // hz), int(low // hz), -1)
            if rates and len(rates) + len(numbers) > looks:
                break
            rates.update(number * hz for number in numbers[:: -(-len(numbers) // looks) or 1])
        for rate in sorted(rates, reverse=True):
            units = rate * self.pieces.per_hz
            if self.pieces.timing(units) and self.pieces.possible(units, units):
                yield rate

    def _fits_as_given(self, rate: Fraction) -> bool:
        """With the offsets that are given."""
        timing = self.pieces.timing(rate * self.pieces.per_hz)
        try:
            return timing is not None and (
                landing(self.pieces.costs, timing, 1 / rate, self.pieces.options, self._tasks_at(rate)) is not None
            )
        except InputError:
            return False

    def _at_any_phase(self, above: Fraction) -> Fraction | None:
        least = self.pieces.range[0]
        found = self._bisected(above)
        between = int((found or self.pieces.hz(least)) * self.pieces.per_hz), int(above * self.pieces.per_hz)
        for change in self._changes(*between):
            rate = self.pieces.hz(change)
            if self.fits(rate):
                following = self._next_change(change)
                return rounded_down(self._between(rate, self.pieces.hz(following)), self.fits)
        return None if found is None else rounded_down(found, self.fits)

    def _not_too_much(self, rate: Fraction) -> Fraction:
        """One above which there is more to do than time."""

        def too_much(rate: Fraction) -> bool:
            timing = self.pieces.timing(rate * self.pieces.per_hz)
            costs, options = self.pieces.costs, self.pieces.options
            return timing is not None and max(loads(costs, timing, 1 / rate, options, self._tasks_at(rate))) > 1

        low, high = Fraction(0), rate
        while high - low > high / 100:
            if too_much(middle := (low + high) / 2):
                high = middle
            else:
                low = middle
        return high if too_much(high) else rate

    def _bisected(self, above: Fraction) -> Fraction | None:
        rate = above
        while not self.fits(rate):
            rate /= 2
            if rate * self.pieces.per_hz < self.pieces.by_N:
                return None
        return self._between(rate, min(2 * rate, above))

    def _between(self, fitting: Fraction, above: Fraction) -> Fraction:
        """Near the last rate that fits, where a higher one is not looked at, or does not: to half of its last digit,
        which counts less than that of the rate above where that has more digits before the point."""
        unit = last_digit(fitting) / 2
        low, high = fitting // unit, -(-above // unit)
        while high - low > 1:
            middle = (low + high) // 2
            if self.fits(middle * unit):
                low = middle
            else:
                high = middle
        return max(low * unit, fitting)

    def _next_change(self, change: int) -> int:
        """Of N, M or L."""
        return min((change // by + 1) * by for by in (self.pieces.by_N, self.pieces.by_M, self.pieces.by_L) if by)

    def _changes(self, low: int, high: int) -> Sequence[int]:
        """From the top, at most `LOOKS`, or what `STEPS_LOOKED_AT` allows."""
        looks = max(min(LOOKS, STEPS_LOOKED_AT // (high // self.pieces.by_N + 1)), 4)
        all_of_them = list(islice(self._points(low, high), looks + 1))
        if len(all_of_them) <= looks:
            return all_of_them
        ends = [low + (high - low) * share // looks for share in range(looks + 1)]
        spread = [next(self._points(start, end), None) for start, end in pairwise(ends)]
        return [point for point in reversed(spread) if point is not None]

    def _points(self, low: int, high: int) -> Iterator[int]:
        """Rates at which a step changes and which may fit."""
        for _, upper in self.pieces.pieces(low, high):
            if self.pieces.timing(upper) and self.pieces.possible(upper, upper):
                yield upper


def _at(tasks: Sequence[Task], scale: Fraction) -> list[Task]:
    """The same tasks in HR periods that are so many times as short."""
    return [
        replace(
            task,
            period=scale * task.period,
            jitter=scale * task.jitter,
            deadline=None if task.deadline is None else scale * task.deadline,
            offset=task.offset if task.offset == "any" else scale * task.offset,
        )
        for task in tasks
    ]


def _is_ahead(task: Task) -> bool:
    """Of the HR jobs, always."""
    return task.priority < HR and task.cpu == 1


def _of_any_phase(tasks: Sequence[Task]) -> list[Task]:
    return [replace(task, offset="any") for task in tasks]
