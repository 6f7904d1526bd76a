"""Whether a simulation is short enough to be run."""

from __future__ import annotations

from collections.abc import Sequence

from sched_sim.bounds import MOST_JOBS, MOST_STEPS, short
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task


def check_simulation(steps: int, tasks: Sequence[Task], what: str, most: int = MOST_JOBS) -> int:
    """About how many jobs a simulation has. Raises InputError for one of too many steps, or of too many jobs of the
    filter and the tasks."""
    if steps > MOST_STEPS:
        raise InputError(f"{what} are {short(steps)} HR steps: at most {MOST_STEPS:,} are simulated; give fewer")
    jobs = steps + sum(int(steps / task.period) for task in tasks)
    if jobs > most:
        shortest = min(tasks, key=lambda task: task.period)
        raise InputError(
            f"{what} release {short(jobs)} jobs, most of them of task {shortest.name!r} with period "
            f"{float(shortest.period):g}: at most {most:,} are possible; check its period, or simulate fewer steps"
        )
    return jobs
