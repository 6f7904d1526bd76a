"""Least speed and landing that hold whatever the phases of the tasks are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import count
from math import ceil
from typing import NamedTuple

from sched_sim.design.load import loads
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.phased import Phased, ceiling, phased
from sched_sim.design.pieces import Costs, DelayedHorizonCosts, DualRateCosts, StandardCosts
from sched_sim.design.search import search_resolution
from sched_sim.design.timing import Timing
from sched_sim.design.worst_demand import overloaded
from sched_sim.design.worst_phase import EndlessError, finishes
from sched_sim.errors import InputError, option
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.tasks import Task, phases_matter

LOAD = "load"

MOST_JOBS_OF_A_CYCLE = 1_000_000

FIRST_STEP = 1_000
"""The search starts so small a share above the load: nearer to it, busy periods are long."""


def least_speed_of_any_phase(
    costs: Costs,
    timing: Timing,
    options: Options,
    tasks: Sequence[Task],
    on_progress: Callable[[int], None] = lambda _runs: None,
) -> tuple[Fraction, str]:
    """(least speed, binding): there no deadline is missed, whatever the phases, to one tick of `search_resolution`.

    on_progress: called with how many speeds have been looked at.
    """
    resolution = search_resolution(costs, options, tasks)
    runs = count(1)

    def binding(period: int) -> str | None:
        on_progress(next(runs))
        return late_job(costs, timing, Fraction(period, resolution), options, tasks)

    too_slow = max(ceil(max(loads(costs, timing, Fraction(1), options, tasks)) * resolution) - 1, 0)
    ahead, why = max(too_slow // FIRST_STEP, 1), LOAD
    while found := binding(too_slow + ahead):
        too_slow, ahead, why = too_slow + ahead, 2 * ahead, found
    enough = too_slow + ahead
    while enough - too_slow > 1:
        middle = (too_slow + enough) // 2
        if found := binding(middle):
            too_slow, why = middle, found
        else:
            enough = middle
    return Fraction(enough, resolution), why


def late_job(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> str | None:
    """What may be late at some phase, named as in a sweep's `binding`; None if nothing may.

    Raises InputError for earliest deadline first on two processors, and for tasks that release too many jobs.
    """
    return _settled(costs, timing, speed, options, tasks).late


def worst_landing(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> int | None:
    """The L at which corrections have landed at any phase; None where something may be late. Raises as `late_job`."""
    settled = _settled(costs, timing, speed, options, tasks)
    return _landed(costs, timing, settled.design) if settled.late is None else None


def late_for_less(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> str | None:
    """What may be late at some phase where executions take their costs or less, as `late_job` says it: a correction of
    the dual-rate filter may then come in any step from its earliest on. Else more work is never better."""
    settled = _settled(costs, timing, speed, options, tasks)
    one = method_of(costs).law(options.feedback).one_in_flight(timing.N, timing.L)
    if settled.late is not None or not isinstance(costs, DualRateCosts) or not one or options.policy == "edf":
        return settled.late
    return _corrected(
        costs, timing, speed, options, tasks, phased(costs, timing, speed, options, tasks).cycle.first
    ).late


class Settled(NamedTuple):
    """A design whose work is that of where it lands; late: as `late_job` says it."""

    design: Phased
    late: str | None


def _settled(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> Settled:
    if options.policy == "edf" and options.cpus == 2:
        name = next(task.name for task in tasks if phases_matter([task]))
        raise InputError(
            f"task {name!r} may have any phase, and what is the worst one is not known with {option('policy')} edf on "
            f"two processors: give each task an offset, and no jitter, or choose {option('policy')} fixed"
        )
    check_simulation(timing.N, tasks, f"the {timing.N} HR periods of a measurement cycle", MOST_JOBS_OF_A_CYCLE)
    if isinstance(costs, DelayedHorizonCosts):
        return _replayed(costs, timing, speed, options, tasks)
    if not method_of(costs).law(options.feedback).one_in_flight(timing.N, timing.L):
        return _in_flight(costs, timing, speed, options, tasks)
    if isinstance(costs, DualRateCosts) and options.policy == "fixed":
        return _corrected(costs, timing, speed, options, tasks, _first_correction(costs, timing, speed, options))
    design = phased(costs, timing, speed, options, tasks)
    return Settled(design, _late_of_all(costs, timing, speed, options, tasks, design))


def _replayed(
    costs: DelayedHorizonCosts[Fraction], timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]
) -> Settled:
    """Of a delayed horizon, which replays the longer the later it lands, as much in the update as its first landing
    needs that is no later than what is replayed for it."""
    landed = timing.M + 1
    while True:
        replayed = replace(costs, update=costs.update + landed * costs.replay, replay=Fraction(0))
        design = phased(replayed, timing, speed, options, tasks)
        late = _late_of_all(replayed, timing, speed, options, tasks, design)
        if late is not None or (lands := _landed(replayed, timing, design)) <= landed:
            return Settled(design, late)
        landed = lands


def _corrected(
    costs: DualRateCosts[Fraction], timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task], first: int
) -> Settled:
    """Of the dual-rate filter with fixed priorities, whose corrections come in no step before `first`: and in none
    after the first in which none comes later if they come no later (K. Tindell and J. Clark, Holistic schedulability
    analysis for distributed hard real-time systems, 1994)."""
    design = phased(costs, timing, speed, options, tasks)
    last = first
    while True:
        between = design._replace(cycle=design.cycle._replace(first=first, last=last))
        late = _late_of_all(costs, timing, speed, options, tasks, between)
        if late is not None or (lands := _landed(costs, timing, between)) <= last:
            return Settled(between, late)
        last = lands


def _in_flight(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> Settled:
    """Of several on their way, which take the more work the later they land, with that of the first landing that none
    comes after if none does."""
    lands = timing.M + method_of(costs).law(options.feedback).after
    while True:
        design = phased(costs, timing, speed, options, tasks, lands)
        late = _late_of_all(costs, timing, speed, options, tasks, design)
        if late is not None or lands >= timing.L or (landed := _landed(costs, timing, design)) <= lands:
            return Settled(design, late)
        lands = landed


def _first_correction(costs: DualRateCosts[Fraction], timing: Timing, speed: Fraction, options: Options) -> int:
    """The step, after k, in which it comes where neither tasks nor corrections nor context switches delay it; L if that
    is too late."""
    uncorrected, at_once = replace(costs, hr_update=Fraction(0)), replace(options, context_switch=Fraction(0))
    alone = phased(uncorrected, timing, speed, at_once, ())
    return timing.L if _late(alone)[0] else _step_done(alone, alone.cycle.low[-1].kind)


def _late_of_all(
    costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task], design: Phased
) -> str | None:
    if max(loads(costs, timing, speed, options, tasks)) > 1:
        return LOAD
    kind, held = _late(design)
    if kind is None or kind == LOAD or kind.startswith("task:"):
        return kind
    return method_of(costs).binding(kind, held, timing, options)


def _landed(costs: Costs, timing: Timing, design: Phased) -> int:
    """Where nothing is late."""
    if not design.cycle.low:
        return 0 if isinstance(costs, StandardCosts) else timing.M
    if design.options.policy == "edf":
        return timing.L
    return _step_done(design, "hr_update" if design.cycle.apart else design.cycle.low[design.cycle.landing].kind)


def _step_done(design: Phased, kind: str) -> int:
    """The step, after k, in which what these jobs compute is in the state."""
    found = [each for each in finishes(design) if each.kind == kind][-1]
    due = design.cycle.low[design.cycle.landing].due
    steps = int((ceiling(found.at - found.due, design.period) + due).max())
    return steps + design.cycle.passed - design.cycle.apart


def _late(design: Phased) -> tuple[str | None, bool]:
    """The kind of the first job found that may be late, and whether it waited for others of its chain."""
    try:
        if design.options.policy == "edf":
            return overloaded(design), False
        for found in finishes(design):
            late = found.at > found.due
            if late.any():
                return found.kind, bool(found.held[late].all())
    except EndlessError:
        return LOAD, False
    return None, False
