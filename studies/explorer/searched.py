"""Over how many HR periods a least speed is searched by simulation, and how many are while somebody waits."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from sched_sim.design.least_speed import has_closed_form
from sched_sim.design.long_pattern import of_bound
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts
from sched_sim.design.steady import hyperperiod_steps
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.tasks import Task, phases_matter

MOST = 5_000
"""HR periods, of the design itself: a second or two."""

MOST_BESIDE = 200
"""HR periods, of each method, landing or part beside it: some ten milliseconds."""


def most_beside(tasks: Sequence[Task]) -> int:
    """MOST_BESIDE, less where tasks may have any phase: each is looked at from each start of a busy period then."""
    return MOST_BESIDE // len(tasks) if phases_matter(tasks) else MOST_BESIDE


def searched(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> int:
    """HR periods until measurements and tasks are released together again, and of the longest landing; with tasks that
    may have any phase, those until measurements and the others repeat, for each task; of the dual-rate filter for each
    correction on its way. 0 in closed form."""
    costs, timing = of_bound(costs, timing)
    if has_closed_form(options, tasks, costs, timing):
        return 0
    landing = max(timing.M, timing.L)
    any_phase = phases_matter(tasks)
    periods = hyperperiod_steps(timing, [task for task in tasks if task.offset != "any"]) + landing
    times = len(tasks) if any_phase else 1
    return times * periods * (in_flight(timing.N, landing) if isinstance(costs, DualRateCosts) else 1)


def in_flight(N: int, landing: int) -> int:
    """Corrections on their way at once, at least one."""
    return max(landing // N, 1)


def check_searched(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> None:
    """Raises InputError for a design whose least speed takes too long to wait for."""
    periods = searched(costs, timing, options, tasks)
    if periods > MOST:
        raise InputError(
            f"the least speed takes a search by simulation over {periods:,} HR periods, and while you wait at most "
            f"{MOST:,} are looked at: ask `sched-sim minimum`, or take fewer HR steps between measurements, a shorter "
            f"delay, periods of tasks that divide {option('N')} {timing.N}, or one measurement on its way at a time"
        )


def check_beside(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> None:
    """Raises InputError for another method than the one that is looked at, whose least speed takes long to find."""
    periods = searched(costs, timing, options, tasks)
    if periods > most_beside(tasks):
        raise InputError(
            f"it takes a search by simulation over {periods:,} HR periods: choose it to see its least speed"
        )


MOST_WORK = 200_000
"""Points in time that the simulations of a search visit, of the design itself: some half a second. There are more only
where work piles up slowly, or many jobs come in a step."""

MOST_WORK_BESIDE = 40_000
"""As many, of each method, landing or part beside it."""


def patience(most: int) -> Callable[[int], None]:
    """For `least_speed` to call with the work of each simulation: raises InputError where there are more than so many
    points in time in all."""
    visited = 0

    def go_on(instants: int) -> None:
        nonlocal visited
        visited += instants
        if visited > most:
            raise InputError(
                f"the least speed takes a search by simulations of more than {most:,} points in time, as work piles "
                f"up slowly or many jobs come in a step: ask `sched-sim minimum`, or take one measurement on its way "
                f"at a time, no {option('context_switch')}, or fewer tasks"
            )

    return go_on
