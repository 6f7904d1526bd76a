"""The user's other periodic tasks on the same processor: control law, telemetry, ..."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from sched_sim.bounds import MOST_TASKS, check_kind, short, whole
from sched_sim.errors import InputError, option
from sched_sim.schedule.jobs import Job
from sched_sim.ticks import exact, to_ticks


@dataclass(frozen=True, slots=True)
class Task:
    """A periodic task; its deadline is its next release.

    period, offset: in HR periods; cost: in the unit of the cost table;
    priority: smaller is more urgent; the filter's HR jobs run at 10, its LR jobs at 20;
    cpu: 1 or 2, where there are two.
    Raises InputError that names the task and lists all that is wrong with it.
    """

    name: str
    period: Fraction
    cost: Fraction
    priority: int
    offset: Fraction = Fraction(0)
    cpu: int = 1

    def __post_init__(self) -> None:
        for figure in ("period", "cost", "offset"):
            object.__setattr__(self, figure, exact(getattr(self, figure), f"task {self.name!r}: {figure}"))
        object.__setattr__(self, "priority", whole(self.priority, f"task {self.name!r}: priority"))
        wrong = []
        if not isinstance(self.name, str) or not self.name.strip():
            wrong.append("the name must be text, and not empty")
        if self.period <= 0:
            wrong.append(f"period {self.period} must be greater than 0 HR periods")
        if self.cost <= 0:
            wrong.append(f"cost {self.cost} must be greater than 0")
        if self.offset < 0:
            wrong.append(f"offset {self.offset} must be 0 or more HR periods")
        if self.cpu not in (1, 2):
            wrong.append(f"cpu {self.cpu} must be 1 or 2")
        if wrong:
            raise InputError(f"task {self.name!r}: {'; '.join(wrong)}")


def checked_tasks(tasks: Iterable[Task], cpus: int) -> tuple[Task, ...]:
    """The user's tasks. Raises InputError for anything else, for two of one name, and for a task on a processor that is
    not there."""
    if isinstance(tasks, str | Path | Task) or not isinstance(tasks, Iterable):
        raise InputError(f"tasks is {short(repr(tasks))}: give a list of Task(...), as `read_tasks` returns one")
    known = tuple(tasks)
    for task in known:
        check_kind(task, Task, "a task", "Task(name, period, cost, priority)")
    if together := wrong_together(known):
        raise InputError("; ".join(together))
    check_cpus(known, cpus)
    return known


def wrong_together(tasks: Sequence[Task]) -> list[str]:
    """What to say of names that several tasks have, and of more tasks than anyone has."""
    if len(tasks) > MOST_TASKS:
        return [f"there are {len(tasks):,} tasks: give at most {MOST_TASKS:,}"]
    count = Counter(task.name for task in tasks)
    return [f"task name {name!r} is used twice; give each task its own" for name, times in count.items() if times > 1]


def check_cpus(tasks: Sequence[Task], cpus: int) -> None:
    """Raises InputError for a task on a processor that is not there."""
    for task in tasks:
        if task.cpu > cpus:
            raise InputError(
                f"task {task.name!r}: cpu {task.cpu} is not there; give {option('cpus')} {task.cpu}, or cpu = 1"
            )


def work_and_times(task: Task, speed: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    """Cost, period and offset in cost units: what is to be a whole number of ticks."""
    return task.cost, task.period * speed, task.offset * speed


class TaskSource:
    """Releases one task's jobs. speed: cost units per HR period; resolution: ticks per cost unit (`work_and_times`)."""

    def __init__(self, task: Task, speed: Fraction, resolution: int) -> None:
        self.task = task
        self.cost, self.period, self.next_release = (
            to_ticks(value, resolution) for value in work_and_times(task, speed)
        )
        self.count = 0

    def release(self) -> tuple[Job, ...]:
        task, start, number = self.task, self.next_release, self.count
        self.next_release = due = start + self.period
        self.count = number + 1
        parts = ((task.name, self.cost),)
        return (Job(f"task:{task.name}", number, task.priority, start, due, self.cost, parts, cpu=task.cpu - 1),)

    def at_horizon(self) -> tuple[Job, ...]:
        return ()

    def state(self, now: int) -> Hashable:
        return self.next_release - now
