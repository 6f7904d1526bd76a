"""What may come in a window of time where the phases of tasks are not known: work released, and work released and due.

Times in ticks from a k at which all that is known repeats; a window [start, start + length) opens where something is
released, with every task whose phase is not known. Arrays throughout.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import NamedTuple

import numpy as np

from sched_sim.design.common_period import common_period
from sched_sim.design.cycle import Cycle, cycle_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, converted, works
from sched_sim.design.timing import Timing
from sched_sim.design.whole import Ints
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import ticks_per_unit, to_ticks

LONGEST_BUSY = 2**16
"""HR periods; a busy period that is longer is taken for one without end."""

MOST_AT_ONCE = 2**16
"""Numbers of an array; larger ones are slower than several."""

Work = Callable[[Ints, Ints], Ints]
"""Work released in windows [start, start + length), from start and length."""


def ceiling(a: Ints, b: int) -> Ints:
    """The least whole number that is not less than a / b."""
    up: Ints = -(-a // b)
    return up


class Rhythm(NamedTuple):
    """When tasks are released; as in `PhasedTask`."""

    period: int
    jitter: int
    first: int | None

    def released(self, start: Ints, length: Ints) -> Ints:
        """How often in [start, start + length), at the most."""
        if self.first is None:
            return ceiling(length + self.jitter, self.period)
        return ceiling(start + length - self.first, self.period) - ceiling(
            start - self.jitter - self.first, self.period
        )


class PhasedTask(NamedTuple):
    """A task. work: with its context switches; first: its first release in a period, None if it may be any; rhythm: of
    the same."""

    name: str
    priority: int
    cpu: int
    work: int
    period: int
    first: int | None
    jitter: int
    deadline: int
    preemptive: bool
    rhythm: Rhythm

    def due(self, start: Ints, length: Ints) -> Ints:
        """How often released and due in [start, start + length], at the most."""
        if self.first is None:
            return np.maximum((length + self.jitter - self.deadline) // self.period + 1, 0)
        before = ceiling(start - self.jitter - self.first, self.period)
        count: Ints = np.maximum((start + length - self.deadline - self.first) // self.period - before + 1, 0)
        return count


class Phased(NamedTuple):
    """A design at one speed.

    N: steps of a cycle; steps: after which all whose phase is known repeats; period: of the HR loop; switches: two
    context switches; before: work of the HR jobs of a cycle up to each step; policy and cpus are in the options.
    """

    N: int
    steps: int
    period: int
    switches: int
    cycle: Cycle
    before: Ints
    tasks: tuple[PhasedTask, ...]
    options: Options

    @property
    def low_cpu(self) -> int:
        return self.options.cpus - 1

    def counted(self, number: int) -> Ints:
        """0, 1, 2, ..., in the type of the others."""
        return np.arange(number).astype(self.before.dtype)

    def first_step(self, instant: Ints) -> Ints:
        """The first that begins then or later."""
        return ceiling(instant, self.period)

    def of_tasks(self, tasks: Sequence[PhasedTask]) -> Work:
        """Work of these tasks: those of one rhythm come together, and the rhythms of any phase are taken at once where
        that is few numbers."""
        works: dict[Rhythm, int] = {}
        for task in tasks:
            works[task.rhythm] = works.get(task.rhythm, 0) + task.work
        of_any = [rhythm for rhythm in works if rhythm.first is None]
        period, more, work = (
            np.array(column, dtype=self.before.dtype)[:, np.newaxis]
            for column in (
                [rhythm.period for rhythm in of_any],
                [rhythm.jitter + rhythm.period - 1 for rhythm in of_any],
                [works[rhythm] for rhythm in of_any],
            )
        )

        def released(start: Ints, length: Ints) -> Ints:
            at_once = len(start) * len(of_any) <= MOST_AT_ONCE
            total: Ints = ((length + more) // period * work).sum(axis=0) if at_once and of_any else 0 * start
            for rhythm, each in works.items():
                if not at_once or rhythm.first is not None:
                    total = total + rhythm.released(start, length) * each
            return total

        return released

    def high(self, first: Ints, end: Ints) -> Ints:
        """Work of the HR jobs of steps [first, end), without corrections."""
        return self._high_up_to(end) - self._high_up_to(first)

    def _high_up_to(self, step: Ints) -> Ints:
        work: Ints = step // self.N * self.before[-1] + self.before[(step % self.N).astype(np.intp)]
        return work

    def high_and_corrections(self, first: Ints, end: Ints, last_cycle: Ints | None = None) -> Ints:
        """Work of the HR jobs of steps [first, end), and of the corrections that may come in them, of cycles up to the
        last."""
        return self.high(first, end) + np.where(end > first, self.corrections(first, end, last_cycle), 0)

    def corrections(self, first: Ints, end: Ints, last_cycle: Ints | None = None) -> Ints:
        """Work of those that may come before step `end` and are not due before `first`, of cycles up to the last."""
        latest = (end - 1 - self.cycle.first) // self.N
        if last_cycle is not None:
            latest = np.minimum(latest, last_cycle)
        count: Ints = np.maximum(latest - ceiling(first - self.cycle.last, self.N) + 1, 0)
        return count * (self.cycle.correction + self.switches * self.cycle.apart)

    def low(self, start: Ints, end: Ints, late: int) -> Ints:
        """Work of the LR jobs that come in [start, end). late: those behind an HR job may come so much later."""
        cycle = self.N * self.period
        total = 0 * start
        for job in self.cycle.low:
            release = job.release * self.period
            first = ceiling(start - late * job.after_high - release, cycle)
            total = total + (ceiling(end - release, cycle) - first) * (job.work + self.switches)
        return total


def phased(
    costs: Costs,
    timing: Timing,
    speed: Fraction,
    options: Options,
    tasks: Sequence[Task],
    lands: int | None = None,
) -> Phased:
    """In the fewest ticks per cost unit in which all is whole; in int64 where nothing can overflow.

    lands: the L up to which corrections may come, by default that of the design.
    """
    costs = converted(costs, Fraction)
    others = [speed, options.context_switch, *works(costs)]
    resolution = lcm(ticks_per_unit(others), *(_denominator(*part) for task in tasks for part in _parts(task, speed)))
    period, switches = to_ticks(speed, resolution), 2 * to_ticks(options.context_switch, resolution)
    cycle = cycle_of(converted(costs, lambda work: to_ticks(work, resolution)), timing, options, lands)
    in_ticks = []
    for task in tasks:
        work, every, first, jitter, deadline = (above * resolution // below for above, below in _parts(task, speed))
        at = None if task.offset == "any" else first % every
        kind, work, rhythm = f"task:{task.name}", work + switches, Rhythm(every, jitter, at)
        in_ticks.append(
            PhasedTask(kind, task.priority, task.cpu - 1, work, every, at, jitter, deadline, task.preemptive, rhythm)
        )
    steps = common_period(timing.N, [task.period for task in tasks if task.offset != "any"])
    largest = max(
        [period, *(max(task.work, task.period) for task in in_ticks), *cycle.high, *(low.work for low in cycle.low)]
    )
    whole = np.int64 if largest * (steps + LONGEST_BUSY) < 2**56 else object
    before = np.concatenate([[0], np.cumsum(np.array(cycle.high, dtype=whole) + switches)]).astype(whole)
    return Phased(timing.N, steps, period, switches, cycle, before, tuple(in_ticks), options)


def _parts(task: Task, speed: Fraction) -> list[tuple[int, int]]:
    """Cost, period, offset, jitter and deadline in cost units, each as a quotient that need not be in lowest terms:
    fractions take most of the time where there are many tasks."""
    cost, above, below = task.cost, speed.numerator, speed.denominator
    times = (task.period, task.start, task.jitter, task.due)
    return [
        (cost.numerator, cost.denominator),
        *((time.numerator * above, time.denominator * below) for time in times),
    ]


def _denominator(above: int, below: int) -> int:
    return below // gcd(above, below)
