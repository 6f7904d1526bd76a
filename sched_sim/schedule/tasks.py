"""The user's other periodic tasks on the same processor: control law, telemetry, ...

Their offset, jitter and deadline are those of N. Audsley, A. Burns, M. Richardson, K. Tindell and A. J. Wellings,
Applying new scheduling theory to static priority pre-emptive scheduling, 1993.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Literal

from sched_sim.bounds import MOST_TASKS, check_kind, short, whole
from sched_sim.errors import InputError, option
from sched_sim.schedule.jobs import Job
from sched_sim.ticks import exact, to_ticks


@dataclass(frozen=True, slots=True)
class Task:
    """A periodic task.

    period: in HR periods; cost: in the unit of the cost table;
    priority: smaller is more urgent; the filter's HR jobs run at 10, its LR jobs at 20;
    offset: of the first release, in HR periods from step 0; "any" if it is not known: then answers hold for all;
    jitter: a release may come so much later than it should, in HR periods;
    deadline: in HR periods from when the release should come; by default the period;
    preemptive: whether other jobs may interrupt it; cpu: 1 or 2, where there are two.
    Raises InputError that names the task and lists all that is wrong with it.
    """

    name: str
    period: Fraction
    cost: Fraction
    priority: int
    offset: Fraction | Literal["any"] = "any"
    cpu: int = 1
    jitter: Fraction = Fraction(0)
    deadline: Fraction | None = None
    preemptive: bool = True

    def __post_init__(self) -> None:
        left_out = {"offset"} if self.offset == "any" else set()
        if self.deadline is None:
            left_out.add("deadline")
        for figure in ("period", "cost", "jitter", "deadline", "offset"):
            if figure not in left_out:
                object.__setattr__(self, figure, exact(getattr(self, figure), f"task {self.name!r}: {figure}"))
        object.__setattr__(self, "priority", whole(self.priority, f"task {self.name!r}: priority"))
        if wrong := list(_wrong(self)):
            raise InputError(f"task {self.name!r}: {'; '.join(wrong)}")

    @property
    def due(self) -> Fraction:
        """The deadline, the period for one that has none of its own."""
        return self.period if self.deadline is None else self.deadline

    @property
    def start(self) -> Fraction:
        """The offset, 0 for one that may be any."""
        return Fraction(0) if self.offset == "any" else self.offset


def _wrong(task: Task) -> Iterator[str]:
    if not isinstance(task.name, str) or not task.name.strip():
        yield "the name must be text, and not empty"
    if task.period <= 0:
        yield f"period {task.period} must be greater than 0 HR periods"
    if task.cost <= 0:
        yield f"cost {task.cost} must be greater than 0"
    if task.start < 0:
        yield f"offset {task.offset} must be 0 or more HR periods"
    if task.cpu not in (1, 2):
        yield f"cpu {task.cpu} must be 1 or 2"
    if task.preemptive not in (True, False):
        yield f"preemptive is {short(repr(task.preemptive))}: give true or false"
    if task.period > 0 and not 0 < task.due <= task.period:
        yield (
            f"deadline {float(task.due):g} must be greater than 0 and at most its period, {float(task.period):g}: a "
            f"job is done before the next one comes"
        )
    elif task.period > 0 and not 0 <= task.jitter < task.due:
        yield f"jitter {float(task.jitter):g} must be 0 or more and less than the deadline, {float(task.due):g}"


def checked_tasks(tasks: Iterable[Task], cpus: int) -> tuple[Task, ...]:
    """The user's tasks. Raises InputError for anything else, for two of one name, and for a task on a processor that is
    not there."""
    if tasks == ():
        return ()
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


def phases_matter(tasks: Sequence[Task]) -> bool:
    """Whether there are several schedules, of which an answer must hold for the worst."""
    return any(task.offset == "any" or task.jitter for task in tasks)


def work_and_times(task: Task, speed: Fraction) -> tuple[Fraction, ...]:
    """Cost, period, offset, jitter and deadline in cost units: what is to be a whole number of ticks."""
    return task.cost, *(time * speed for time in (task.period, task.start, task.jitter, task.due))


class TaskSource:
    """Releases one task's jobs. speed: cost units per HR period; resolution: ticks per cost unit (`work_and_times`).

    The first release comes late by the jitter, the others when they should: so two come as close as they can. An offset
    that may be any is 0.
    """

    def __init__(self, task: Task, speed: Fraction, resolution: int) -> None:
        self.task = task
        self.cost, self.period, self.nominal, jitter, self.deadline = (
            to_ticks(value, resolution) for value in work_and_times(task, speed)
        )
        self.next_release = self.nominal + jitter
        self.count = 0

    def release(self) -> tuple[Job, ...]:
        task, start, number = self.task, self.next_release, self.count
        due = self.nominal + self.deadline
        self.next_release = self.nominal = self.nominal + self.period
        self.count = number + 1
        parts = ((task.name, self.cost),)
        kind, cpu = f"task:{task.name}", task.cpu - 1
        return (Job(kind, number, task.priority, start, due, self.cost, parts, None, cpu, task.preemptive),)

    def at_horizon(self) -> tuple[Job, ...]:
        return ()

    def state(self, now: int) -> Hashable:
        return self.next_release - now
