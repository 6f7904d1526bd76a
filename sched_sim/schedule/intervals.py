"""A schedule as what a Gantt chart shows of it: intervals and instants in ticks, no graphics."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from sched_sim.schedule.outcome import Schedule, Slice

TASK = "task:"
OF_SENSOR = ("correct ", "gain ", "loss ")
"""Jobs of a composed filter, behind it the sensor's name: each sensor has a line of its own."""


class Row(NamedTuple):
    """A line of the chart: one class of jobs. cpu: from 0; None if there is no job of it."""

    name: str
    cpu: int | None


class Bar(NamedTuple):
    """Work of one label, done without interruption in [start, end); overdue: the deadline, if it passed before `end`.

    style: the label, or "task:NAME" for a user's task, whose name might be anyone's.
    """

    row: Row
    style: str
    start: int
    end: int
    kind: str
    step: int
    overdue: int | None


class JobSpan(NamedTuple):
    """One job from release to finish (None: unfinished at the horizon); runs: when it had the processor; preemptions:
    how often another job took it."""

    row: Row
    kind: str
    step: int
    release: int
    deadline: int
    finish: int | None
    missed: bool
    runs: tuple[tuple[int, int], ...]
    preemptions: int


@lru_cache(maxsize=256)
def row_of(kind: str, cpu: int | None) -> Row:
    """The line on which jobs of one kind are drawn."""
    if kind.startswith(TASK):
        return Row(kind.removeprefix(TASK), cpu)
    if kind == "predict":
        return Row(kind, cpu)
    for prefix in OF_SENSOR:
        if kind.startswith(prefix):
            return Row(kind.removeprefix(prefix), cpu)
    return Row("LR" if kind.startswith("lr_") else "HR", cpu)


def rows(schedule: Schedule) -> list[Row]:
    """The lines of the chart from top to bottom: by processor, then HR (or predict), LR, then sensors and the user's
    tasks by their first run.

    A processor on which nothing ever ran has a line "idle".
    """
    cpu_of: dict[str, int | None] = {}
    for piece in schedule.slices:
        cpu_of.setdefault(piece.kind, piece.cpu)
    for kind in schedule.responses:
        cpu_of.setdefault(kind, None)
    lines = list(dict.fromkeys(row_of(kind, cpu) for kind, cpu in cpu_of.items()))
    ran = {row.name for row in lines if row.cpu is not None}
    lines = [row for row in lines if row.cpu is not None or row.name not in ran]
    lines += [Row("idle", cpu) for cpu in range(schedule.cpus) if cpu not in {row.cpu for row in lines}]
    filter_rows = {"HR": 0, "predict": 0, "LR": 1}
    return sorted(lines, key=lambda row: (row.cpu is None, row.cpu or 0, filter_rows.get(row.name, 2)))


def bars(schedule: Schedule) -> list[Bar]:
    """Every piece of work that was done, in the order in which the processors gave it up."""
    all_bars = []
    for piece in schedule.slices:
        row = row_of(piece.kind, piece.cpu)
        for label, start, end in piece.pieces():
            is_switch = start < piece.start + piece.overhead
            style = piece.kind if piece.kind.startswith(TASK) and not is_switch else label
            overdue = piece.deadline if end > piece.deadline else None
            all_bars.append(Bar(row, style, start, end, piece.kind, piece.step, overdue))
    return all_bars


def jobs(schedule: Schedule) -> list[JobSpan]:
    """Every job, by release."""
    slices_of: dict[tuple[str, int], list[Slice]] = {}
    for piece in schedule.slices:
        slices_of.setdefault((piece.kind, piece.step), []).append(piece)
    spans = (_span(slices, schedule.horizon) for slices in slices_of.values())
    return sorted(spans, key=lambda job: (job.release, job.row.name))


def _span(slices: Sequence[Slice], horizon: int) -> JobSpan:
    last = slices[-1]
    finish = last.end if last.finished else None
    runs = tuple((piece.start, piece.end) for piece in slices if piece.start < piece.end)
    row = row_of(last.kind, last.cpu)
    preemptions = sum(_is_preempted(piece, horizon) for piece in slices)
    return JobSpan(row, last.kind, last.step, last.release, last.deadline, finish, last.missed, runs, preemptions)


def _is_preempted(piece: Slice, horizon: int) -> bool:
    """Whether another job took the processor at its end: not where it had done what it knew of, and went on. Of a job
    that has work."""
    if piece.finished or piece.end == horizon:
        return False
    return piece.begin + piece.end - piece.start - piece.overhead < sum(work for _, work in piece.parts)


def never_ran(schedule: Schedule) -> int:
    """How many of the missed jobs had not got the processor by the horizon."""
    return sum(job.missed and job.finish is None and not job.runs for job in jobs(schedule))


def waits(job: JobSpan, horizon: int) -> list[tuple[int, int]]:
    """When the job was released but did not run: before its first run, and whenever it was preempted."""
    end = job.finish if job.finish is not None else horizon
    instants = [job.release, *(instant for run in job.runs for instant in run), end]
    return [(start, stop) for start, stop in list(pairwise(instants))[::2] if start < stop]


def overdue_work(all_bars: Iterable[Bar]) -> list[tuple[Row, int, int]]:
    """(row, start, end) of the work done after its deadline."""
    return [
        (bar.row, max(bar.start, bar.overdue), bar.end)
        for bar in all_bars
        if bar.overdue is not None and bar.end > bar.overdue
    ]
