"""Least speed by bisection on the simulation, where there is no closed form: context switches, the user's tasks,
earliest deadline first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import count
from math import ceil

from sched_sim.design.load import loads
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, works
from sched_sim.design.steady import Steady, longest_run, run_until_steady
from sched_sim.design.timing import Timing
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import ticks_per_unit

TICKS_PER_LOOP = 1_000_000
"""The least speed is found to this many ticks in the filter's largest job, or finer."""

MOST_LOADS = 100
"""Of ever later landings, that are tried before other speeds."""

FIRST_LOOK = 256
"""HR periods of the first simulations; most speeds that are too slow miss something in so many."""

OnProgress = Callable[[int], None]
"""Called with how many simulations have been run."""

OnWork = Callable[[int], None]
"""Called after each simulation with how many points in time it visited."""


def least_speed_by_simulation(
    costs: Costs,
    timing: Timing,
    options: Options,
    tasks: Sequence[Task],
    on_progress: OnProgress = lambda _runs: None,
    on_work: OnWork = lambda _instants: None,
) -> tuple[Fraction, str]:
    """(least speed, binding): there no deadline is ever missed, since all that can come has been seen
    (`run_until_steady`); one tick of period less is too slow: a deadline is missed, or work piles up without end.

    Where a slower processor may be lucky and do again (it may switch less often, or land in a shorter HR job), there
    are several such speeds, and this is one of them.
    Raises InputError if the tasks repeat with the measurements only after a very long time.
    """
    longest = longest_run(timing, tasks)
    resolution = search_resolution(costs, options, tasks)
    floor = max(loads(costs, timing, Fraction(1), options, tasks))
    runs = count(1)

    def run(period: int, steps: int) -> Steady:
        on_progress(next(runs))
        speed = Fraction(period, resolution)
        steady = run_until_steady(costs, timing, speed, options, tasks, steps)
        on_work(steady.schedule.instants)
        return steady

    piling = [ceil(load * resolution) for load in _loads_later(costs, timing, options, tasks)]
    too_slow = max(ceil(floor * resolution) - 1, 0)
    enough, steps = too_slow + 1, min(FIRST_LOOK, longest)
    steady = run(enough, steps)
    while not steady.repeats:
        if steady.schedule.misses or steps == longest:
            too_slow, enough, steady = _bisect(run, enough, steps, longest)
            continue
        piling = [load for load in piling if load >= enough]
        if piling and _is_least(run, load := piling.pop(0), longest):
            return Fraction(load, resolution), "load"
        steps = min(4 * steps, longest)
        steady = run(enough, steps)
    binding = _binding(run(too_slow, steps).schedule, costs, timing, options) if too_slow else "load"
    return Fraction(enough, resolution), binding


def _loads_later(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> list[Fraction]:
    """Those of corrections that land ever later, which takes more work: one of them is often the least speed."""
    law, (N, M, L) = method_of(costs).law(options.feedback), (timing.N, timing.M, timing.L)
    if not law.several or law.only_first:
        return []
    landings = [*range(M, L, N)[:MOST_LOADS], L]
    return sorted({max(loads(costs, replace(timing, M=at), Fraction(1), options, tasks)) for at in landings})


def _is_least(run: Callable[[int, int], Steady], period: int, longest: int) -> bool:
    return run(period, longest).repeats and not run(period - 1, longest).repeats


def _bisect(run: Callable[[int, int], Steady], too_slow: int, steps: int, longest: int) -> tuple[int, int, Steady]:
    """In so many steps: (a period that is too slow, the next, which is not, what was seen there)."""

    def fails(outcome: Steady) -> bool:
        return outcome.schedule.misses > 0 or (steps == longest and not outcome.repeats)

    ahead = 1
    while fails(steady := run(too_slow + ahead, steps)):
        too_slow, ahead = too_slow + ahead, 2 * ahead
    enough = too_slow + ahead
    while enough - too_slow > 1:
        middle = (too_slow + enough) // 2
        if fails(outcome := run(middle, steps)):
            too_slow = middle
        else:
            enough, steady = middle, outcome
    return too_slow, enough, steady


def search_resolution(costs: Costs, options: Options, tasks: Sequence[Task]) -> int:
    """Ticks per cost unit to which the least speed is searched: all work is whole, the largest piece at least
    TICKS_PER_LOOP; of a filter without work, the largest beside it."""
    work = [Fraction(value) for value in works(costs)]
    resolution = ticks_per_unit([options.context_switch, *work, *(task.cost for task in tasks)])
    largest = max(work) or max([options.context_switch, *(task.cost for task in tasks)]) or 1
    while largest * resolution < TICKS_PER_LOOP:
        resolution *= 10
    return resolution


def _binding(schedule: Schedule, costs: Costs, timing: Timing, options: Options) -> str:
    """The demand of the first job missed on a slightly too slow processor; "load" if work only piles up."""
    if schedule.first_miss is None:
        return "load"
    kind, held = schedule.first_miss
    return kind if kind.startswith("task:") else method_of(costs).binding(kind, held, timing, options)
