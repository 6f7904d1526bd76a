"""The worst response of each job where the phases of tasks are not known, with fixed priorities.

A job is latest in a busy period that starts where something whose phase is known is released, and every task whose
phase is not known with it, the first time as late as its jitter allows and then as early as it may (K. Tindell, Adding
time-offsets to schedulability analysis, 1994; J. C. Palencia and M. Gonzalez Harbour, Schedulability analysis for tasks
with static and dynamic offsets, 1998). All such starts are tried, so the answer holds for every phase. It is exact but
for this: of jobs of equal priority one that is a task counts as more urgent; a correction counts in every step in which
it may come; of Larsen's method with M = N the longer of the first step, which has no measurement yet, and of the others
at k; each job is charged two context switches; on a second processor LR propagate comes as late as its HR job may
finish, and the next as early.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from sched_sim.design.phased import LONGEST_BUSY, Phased, PhasedTask, Work, ceiling
from sched_sim.design.whole import Flags, Ints
from sched_sim.schedule.jobs import HR, LR

MOST_BURSTS = 2_000
"""So often more may come while what has come is done; then a busy period is taken for one without end."""

Come = Callable[[Ints], Ints]
"""The work that comes in windows of these lengths, from the start of each on."""


class EndlessError(Exception):
    """A busy period has no end: the work is all that the processor can do, or more."""


class Level(NamedTuple):
    """What delays a job of one priority on one processor.

    tasks: those as urgent, or more; block: work of a less urgent job that cannot be preempted.
    """

    cpu: int
    high: bool
    low: bool
    tasks: tuple[PhasedTask, ...]
    block: int

    @property
    def of_filter_alone(self) -> bool:
        return not self.tasks and not self.block


class Finishes(NamedTuple):
    """When jobs of one kind finish at the latest, and when they must. kind: as in a schedule; start: of the busy period
    in which it is so; held: whether it starts before the release of the job."""

    kind: str
    at: Ints
    due: Ints
    start: Ints
    held: Flags


def finishes(design: Phased) -> Iterator[Finishes]:
    """HR jobs, LR jobs, tasks. Of those behind a job that is late, none. Raises EndlessError."""
    high = _high_jobs(design)
    yield high
    if (high.at > high.due).any():
        return
    late = int((high.at - high.due + design.period)[:: design.N].max()) if design.options.cpus == 2 else 0
    yield from _low_jobs(design, late)
    for task in design.tasks:
        yield _task_jobs(design, task, late)


def critical_start(design: Phased) -> int:
    """Where all tasks whose phase may be any are released together so that the job with the least slack is latest; 0 if
    no busy period ends."""
    try:
        _slack, start = min(
            (int((found.due - found.at).min()), int(found.start[(found.due - found.at).argmin()]))
            for found in finishes(design)
        )
    except EndlessError:
        return 0
    return start % (design.steps * design.period)


def _high_jobs(design: Phased) -> Finishes:
    """One after another, each in its step."""
    level = _level(design, 0, HR)
    others = _others(design, level)
    step = design.counted(design.steps)
    release, due = step * design.period, (step + 1) * design.period

    def found(start: Ints, job: Ints) -> Finishes:
        first = design.first_step(start)
        fixed = design.high(first, step[job] + 1) + design.corrections(first, step[job] + (not design.cycle.apart))
        return _finishes("hr", lambda length: fixed + others(start, length), start, job, release, due)

    at_once = found(release, np.arange(design.steps))
    if (at_once.at > due).any():  # a processor that is much too slow has long busy periods, which need not be tried
        return at_once
    return found(*_busy_before(design, level, release, 0))


def _low_jobs(design: Phased, late: int) -> Iterator[Finishes]:
    """One after another; where the correction is a job of its own, that too."""
    level = _level(design, design.low_cpu, LR)
    others = _others(design, level)
    cycle = design.counted(design.steps // design.N)
    k, span = cycle * design.N * design.period, design.N * design.period
    landing = design.cycle.landing % max(len(design.cycle.low), 1)
    for number, low in enumerate(design.cycle.low):
        release, due = k + low.release * design.period + late * low.after_high, k + low.due * design.period
        start, job = _busy_before(design, level, release, late)
        ahead = 0 * start
        for other, work in enumerate(design.cycle.low):
            since = start - late * work.after_high - work.release * design.period
            count = cycle[job] - (other > number) - ceiling(since, span) + 1
            ahead = ahead + np.maximum(count, 0) * (work.work + design.switches)

        last = cycle[job] - (number <= landing)  # of the corrections that can have come

        def come(length: Ints, start: Ints = start, last: Ints = last, ahead: Ints = ahead) -> Ints:
            work = ahead + others(start, length)
            if level.high:
                first, end = design.first_step(start), design.first_step(start + length)
                work = work + design.high_and_corrections(first, end, last)
            return work

        found = _finishes(low.kind, come, start, job, release, due)
        yield found
        if design.cycle.apart and number == landing:
            yield _feedback(design, come, start, job, release, found)


def _feedback(design: Phased, come: Come, start: Ints, job: Ints, release: Ints, update: Finishes) -> Finishes:
    """The correction as a job of its own, behind the LR update."""
    work = design.cycle.correction + design.switches
    if design.options.cpus == 1:
        return _finishes("hr_update", lambda length: come(length) + work, start, job, release, update.due)
    level = _level(design, 0, HR)
    at_once, others = starts(design, level, 0), _others(design, level)
    waiting = 1 + (design.cycle.last - design.cycle.first) // design.N
    ahead = int(np.diff(design.before).max()) + waiting * work
    length = _first_idle(lambda length: ahead + others(at_once, length), 0 * at_once + 1, update.due.max())
    return update._replace(kind="hr_update", at=update.at + length.max())


def _task_jobs(design: Phased, task: PhasedTask, late: int) -> Finishes:
    """Of a task whose phase may be any, those of a busy period; else those until all repeats."""
    level = _level(design, task.cpu, task.priority, besides=task)
    if task.first is None:
        count = 1 if task.preemptive else longest_busy(design, _with(level, task), late) // task.period + 1
        opened = starts(design, level, late)
        start = np.repeat(opened, count)
        before = np.tile(design.counted(count), len(opened))
        nominal = start - task.jitter + before * task.period
        release, job = np.maximum(start, nominal), np.arange(len(start))
    else:
        span = design.steps * design.period
        nominal = task.first + design.counted(span // task.period) * task.period
        release = nominal + task.jitter
        start, job = _busy_before(design, _with(level, task), release, late)
        since = ceiling(start - task.jitter - task.first, task.period)
        before = (nominal[job] - task.first) // task.period - since
    if task.preemptive:
        own, least, after = (before + 1) * task.work, 1, 0
    else:
        own, least, after = before * task.work, 0, task.work

    demand = _demand(design, level, late)

    def come(length: Ints) -> Ints:
        return own + demand(start, length + 1 - least)

    return _finishes(task.name, come, start, job, release, nominal + task.deadline, least, after)


def _level(design: Phased, cpu: int, priority: int, besides: PhasedTask | None = None) -> Level:
    here = [task for task in design.tasks if task.cpu == cpu and task is not besides]
    return Level(
        cpu,
        cpu == 0 and priority >= HR,
        cpu == design.low_cpu and priority >= LR,
        tuple(task for task in here if task.priority <= priority),
        max((task.work for task in here if task.priority > priority and not task.preemptive), default=0),
    )


def _with(level: Level, task: PhasedTask) -> Level:
    return level._replace(tasks=(*level.tasks, task))


def _others(design: Phased, level: Level) -> Work:
    """Work of the tasks of a level, and what is not preempted."""
    of_tasks = design.of_tasks(level.tasks)
    return lambda start, length: level.block + of_tasks(start, length)


def _demand(design: Phased, level: Level, late: int) -> Work:
    """All the work of a level."""
    others = _others(design, level)

    def demand(start: Ints, length: Ints) -> Ints:
        work = others(start, length)
        if level.high:
            first, end = design.first_step(start), design.first_step(start + length)
            work = work + design.high_and_corrections(first, end)
        return work + design.low(start, start + length, late) if level.low else work

    return demand


def starts(design: Phased, level: Level, late: int) -> Ints:
    """Where a busy period of the level may start, in order, until all repeats."""
    span, cycle = design.steps * design.period, design.N * design.period
    instants = [design.counted(design.steps) * design.period] if level.high else []
    if level.low and not level.high:
        k = design.counted(design.steps // design.N) * cycle
        instants += [k + job.release * design.period + late * job.after_high for job in design.cycle.low]
    for task in level.tasks:
        if task.first is not None:
            instants.append((task.first + task.jitter + design.counted(span // task.period) * task.period) % span)
    return np.unique(np.concatenate(instants)) if instants else design.counted(1)


def _busy_before(design: Phased, level: Level, release: Ints, late: int) -> tuple[Ints, Ints]:
    """Pairs of a start and a job: every start of a busy period that may last until the release of the job."""
    if level.tasks or level.block or (level.low and design.cycle.several):
        busy = longest_busy(design, level, late)
    else:  # what came before k has been done by then, or something is late
        busy = design.N * design.period if level.low else 0
    span, once = design.steps * design.period, starts(design, level, late)
    opened = np.concatenate([once - back * span for back in range(busy // span + 2, -2, -1)])
    first = np.searchsorted(opened, release - busy, "left")
    count = np.searchsorted(opened, release, "right") - first
    job = np.repeat(np.arange(len(release)), count)
    within = np.arange(len(job)) - np.repeat(np.cumsum(count) - count, count)
    return opened[first[job] + within], job


def longest_busy(design: Phased, level: Level, late: int) -> int:
    opened, demand = starts(design, level, late), _demand(design, level, late)
    length = 0 * opened + 1
    limit = LONGEST_BUSY * design.period
    for _ in range(MOST_BURSTS):
        needed = demand(opened, length)
        if (needed <= length).all():
            return int(length.max())
        if needed.max() > limit:
            break
        length = np.maximum(needed, length)
    raise EndlessError


def _finishes(
    kind: str, come: Come, start: Ints, job: Ints, release: Ints, due: Ints, least: int = 1, after: int = 0
) -> Finishes:
    """least: ticks after its release that a job is under way at the least; after: work that nothing delays any more."""
    length = _first_idle(come, release[job] - start + least, due[job] - start - after)
    finish = start + length + after
    at, opened = 0 * release, 0 * release
    np.maximum.at(at, job, finish)
    latest = finish == at[job]
    opened[job[latest]] = start[latest]
    return Finishes(kind, at, due, opened, opened < release)


def _first_idle(come: Come, length: Ints, limit: Ints) -> Ints:
    """The least lengths, not below those given, in which all that came is done; where that is beyond the limit, one
    more than the limit."""
    while True:
        needed = np.maximum(np.minimum(come(length), limit + 1), length)
        if (needed == length).all():
            return length
        length = needed
