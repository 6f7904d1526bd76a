"""Least speed by bisection on the simulation, where there is no closed form: context switches, the user's tasks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple
from fractions import Fraction
from math import ceil, gcd, lcm

from sched_sim.costs import DualRateCosts, JobCosts
from sched_sim.errors import InputError
from sched_sim.options import Options
from sched_sim.schedule import Schedule
from sched_sim.simulate import simulate
from sched_sim.tasks import Task
from sched_sim.ticks import ticks_per_unit
from sched_sim.timing import Timing

TICKS_PER_LOOP = 1_000_000
"""The least speed is found to this many ticks in the filter's largest job, or finer."""

LONGEST_SEARCH = 400_000
"""HR periods that one simulation of the search may take."""


def least_speed_by_simulation(
    costs: JobCosts, timing: Timing, options: Options, tasks: Sequence[Task], at_least: Fraction
) -> tuple[Fraction, str]:
    """(least speed, binding): no deadline is missed there, and one is at one tick of period less.

    at_least: a speed below which it cannot be: that of the same filter alone on the processor.
    Where a slower processor may be lucky and do again (with context-switch costs, it may switch less often), there are
    several such speeds, and this is one of them.
    Raises InputError if the tasks repeat with the measurements only after a very long time.
    """
    cycles = cycles_to_simulate(timing, tasks)
    if tasks and cycles * timing.N > LONGEST_SEARCH:
        raise InputError(
            f"the tasks repeat together with the measurements only after {cycles * timing.N / 2:.3g} HR periods: round "
            f"their periods ({', '.join(f'{task.name} {float(task.period):g}' for task in tasks)}) to a common grid"
        )
    resolution = search_resolution(costs, options, tasks)

    def run(period: int) -> Schedule:
        return simulate(costs, timing, Fraction(period, resolution), cycles, options, tasks)

    too_slow = max(ceil(at_least * resolution) - 1, 0)
    enough = too_slow + 1
    while run(enough).misses:
        too_slow, enough = enough, 2 * enough
    while enough - too_slow > 1:
        middle = (too_slow + enough) // 2
        if run(middle).misses:
            too_slow = middle
        else:
            enough = middle
    binding = _binding(run(too_slow), costs, timing, options) if too_slow else "hr"
    return Fraction(enough, resolution), binding


def search_resolution(costs: JobCosts, options: Options, tasks: Sequence[Task]) -> int:
    """Ticks per cost unit to which the least speed is searched: all work is whole, the largest piece at least
    TICKS_PER_LOOP."""
    work = [Fraction(value) for value in astuple(costs)]
    resolution = ticks_per_unit([options.context_switch, *work, *(task.cost for task in tasks)])
    while max(work) * resolution < TICKS_PER_LOOP:
        resolution *= 10
    return resolution


def cycles_to_simulate(timing: Timing, tasks: Sequence[Task]) -> int:
    """Measurement cycles until the schedule repeats: the latest offset and two hyperperiods, at least four cycles."""
    hyperperiod = Fraction(timing.N)
    for task in tasks:
        hyperperiod = Fraction(
            lcm(hyperperiod.numerator, task.period.numerator), gcd(hyperperiod.denominator, task.period.denominator)
        )
    latest_offset = max((task.offset for task in tasks), default=Fraction(0))
    return max(4, ceil((latest_offset + 2 * hyperperiod) / timing.N))


def _binding(schedule: Schedule, costs: JobCosts, timing: Timing, options: Options) -> str:
    """The demand that the first missed job of a slightly too slow processor belongs to."""
    assert schedule.first_miss is not None
    kind, held = schedule.first_miss
    if kind == "hr" or kind.startswith("task:") or not isinstance(costs, DualRateCosts):
        return kind
    if kind in ("lr_propagate", "lr_gain") and timing.M and options.lr_propagate_by == "m":
        return "lr_propagate"
    return "lr_update" if timing.M and not held and kind in ("lr_update", "hr_update") else "lr_total"
