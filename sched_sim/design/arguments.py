"""What the functions of this package are given."""

from __future__ import annotations

from collections.abc import Iterable

from sched_sim.bounds import check_kind
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task, checked_tasks


def checked(timing: Timing, options: Options, tasks: Iterable[Task] = ()) -> tuple[Task, ...]:
    """The tasks. Raises InputError that names the argument which is of another kind."""
    check_kind(timing, Timing, "timing", "Timing(N, M, L)")
    check_kind(options, Options, "options", "Options(...), or leave it out")
    return checked_tasks(tasks, options.cpus)
