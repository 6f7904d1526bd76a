"""What the compiled engine keeps, as records of whole numbers of 64 bits, in arrays."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, Protocol, TypeAlias, TypeVar

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from sched_sim.design.engine.plan import Plan

    Numbers: TypeAlias = NDArray[np.int64]

Row = TypeVar("Row", covariant=True)


class Rows(Protocol[Row]):
    """An array of records."""

    @property
    def shape(self) -> tuple[int, ...]: ...

    def __getitem__(self, row: int, /) -> Row: ...

    def __iter__(self) -> Iterator[Row]: ...


class State:
    """Where the filter and the run as a whole stand."""

    step: int  # next to be released
    taken: int  # measurements, so far
    arrived: int
    carried: int  # that were taken as many steps ago as the plan says
    in_state: int  # corrections
    propagates: int  # LR propagates that have what they need
    updates: int  # LR updates that have it
    busy: int  # whether an LR job of the chain is released and unfinished
    freed: int  # how often the chain went on to the next
    replayed: int  # steps, by the LR update that runs
    order: int  # of the last release
    unused: int  # rows of jobs
    logged: int  # jobs
    full: int  # whether there was no room for more
    instants: int
    busy_ticks: int
    first_deadline: int  # of the first miss
    first_priority: int
    first_release: int
    first_kind: int  # -1: none
    first_held: int


class Cpu:
    """As `schedule.processor.Cpu`; ready: how many; running, last: rows of jobs, -1 for none."""

    ready: int
    running: int
    rank: int
    order: int
    since: int
    finish: int
    busy: int
    last: int


class Job:
    """As `schedule.jobs.Job`; kind: -1 where the row is unused; left: work, with that of context switches; follows: see
    `codes`; freed: how often the chain had been freed at its release, -1 for a job of no chain."""

    kind: int
    follows: int
    step: int
    priority: int
    cpu: int
    release: int
    deadline: int
    left: int
    freed: int
    preemptive: int


class TaskRow:
    """As `schedule.tasks.TaskSource`."""

    kind: int
    priority: int
    cpu: int
    preemptive: int
    period: int
    deadline: int
    cost: int
    nominal: int
    next_release: int
    count: int


class Figures:
    """As `schedule.outcome.Response`, of one kind of job; total: less than `event_loop.CARRY`, which is added `carries`
    times."""

    releases: int
    finished: int
    worst: int
    total: int
    misses: int
    worst_lateness: int
    preemptions: int
    carries: int


class Run(NamedTuple):
    """One simulation.

    unused: rows of jobs that are, as many as state.unused; phases: see `rules.is_taken`; queues, ends: a ring for each
    of `rules.CHAIN` and so on, and where it begins and ends; heaps: what is ready on each of two processors, and the
    next release of the filter and of each task; landed: L of each cycle, -1 before it has landed; log: kind, step,
    release and finish of the first jobs to finish, as many as it has rows.
    """

    plan: Plan
    state: State
    cpus: Rows[Cpu]
    jobs: Rows[Job]
    unused: Numbers
    phases: Numbers
    queues: Numbers
    ends: Numbers
    heaps: Numbers
    tasks: Rows[TaskRow]
    figures: Rows[Figures]
    landed: Numbers
    log: Numbers
