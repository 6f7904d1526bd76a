"""Some steps of a scenario's run, as the schedule that a Gantt chart shows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf, isnan
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.engine.measured import Ints
from sched_sim.scenario.kinds import correct_kind, gain_kind, loss_kind
from sched_sim.scenario.scenario import Scenario
from sched_sim.schedule.intervals import TASK
from sched_sim.schedule.labels import MEANINGS
from sched_sim.text import visible
from studies.explorer.scenario_trace import AHEAD, Trace, TracedBars
from studies.explorer.scenario_waiting import Waiting, waiting
from studies.explorer.schedule import meaning

Columns: TypeAlias = dict[str, npt.NDArray[Any]]
Document: TypeAlias = dict[str, Any]

MOST_JOBS = 2_000
"""Of one window. Where work piles up, more wait: then those are left out that neither run in it nor are released or due
in it, and of these the last."""
MOST_MARKS = 60
"""More measurements than a chart has room for are not marked."""


class Seen(NamedTuple):
    """Jobs, by their indices in the trace, and others that wait and have not run; how many are left out, and the
    instant before which it is known what they did."""

    jobs: Ints
    waiting: Sequence[Waiting]
    left_out: int
    before: float


def window(trace: Trace, first: int, until: int) -> Document:
    """The steps from `first` on, before step `until`, which the trace `knows`.

    It has what does not lie outside, whole: bars, and the jobs that were released before its end and not finished
    before its start. What a job did AHEAD steps after the window, or later than the last bar ends, is not told: it has
    then no finish, and is missed if its deadline had passed. So the same window is the same, however far the trace goes
    on.
    """
    scenario = trace.scenario
    shown = [_columns(bars, bars.between(first, until)) for bars in trace.bars]
    seen = _seen(trace, first, until, shown)
    rows = row_kinds(scenario)
    jobs = _jobs(trace, seen, rows)
    bars = _bars(trace, shown, seen, rows)
    busy = sum(_busy(columns, first, until) for columns in shown)
    return {
        "origin": first,
        "steps": until,
        "period_ms": None if scenario.hr_hz is None else float(1000 / scenario.hr_hz),
        "cut": f"without {seen.left_out:,} more jobs that wait" if seen.left_out else "",
        "rows": [{"name": visible(row.name), "cpu": row.cpu} for row in rows],
        **bars,
        "jobs": jobs,
        "marks": marks(trace, first, until),
        "misses": sum(jobs["missed"]),
        "busy": busy / (until - first) / scenario.cpus,
    }


class RowKinds(NamedTuple):
    """A line of the chart, and the kinds of job on it. cpu: from 0."""

    name: str
    cpu: int
    kinds: tuple[str, ...]


def row_kinds(scenario: Scenario) -> list[RowKinds]:
    """The lines of all windows: by processor, the predict jobs first, then the sensors, then the tasks."""
    last = scenario.cpus - 1
    lines = [RowKinds("predict", 0, ("predict",))]
    lines += [
        RowKinds(sensor.name, last, (correct_kind(sensor), gain_kind(sensor), loss_kind(sensor)))
        for sensor in scenario.sensors
    ]
    lines += [RowKinds(task.name, task.cpu - 1, (f"{TASK}{task.name}",)) for task in scenario.tasks]
    return sorted(lines, key=lambda line: line.cpu)


def _columns(bars: TracedBars, part: slice) -> Columns:
    return {name: np.array(getattr(bars, name)[part]) for name in ("job", "run", "last", "style", "start", "end")}


def _seen(trace: Trace, first: int, until: int, shown: Sequence[Columns]) -> Seen:
    """shown: the bars."""
    last_end = max(float(bars["end"].max(initial=0)) for bars in shown)
    before = max(float(until + AHEAD), float(np.nextafter(last_end, inf)))
    if before >= trace.scenario.steps:
        before = inf
    more = [] if before == inf else waiting(trace, until, before)
    found = _alive(trace, first, until, before)
    idle = np.setdiff1d(found, np.concatenate([bars["job"] for bars in shown]))
    release = np.append(np.array(trace.jobs.release)[idle], [job.release for job in more])
    deadline = np.append(np.array(trace.jobs.deadline)[idle], [job.deadline for job in more])
    outside = (release < first) & ((deadline <= first) | (deadline > until))
    kept = np.sort(np.lexsort((release, outside))[: max(MOST_JOBS - (found.size - idle.size), 0)])
    left_out = np.setdiff1d(idle, idle[kept[kept < idle.size]])
    waits = [more[index - idle.size] for index in kept[kept >= idle.size]]
    return Seen(np.setdiff1d(found, left_out), waits, release.size - kept.size, before)


def _alive(trace: Trace, first: int, until: int, before: float) -> Ints:
    """Of the jobs that have run by `before`, those that are in the window."""
    jobs = trace.jobs
    seen, release, finish = (np.array(column) for column in (jobs.seen, jobs.release, jobs.finish))
    begun = (seen < before) & ((release < until) | (until == trace.scenario.steps))
    ended = (finish < before) & (finish <= first) & (release < first)
    return np.flatnonzero(begun & ~ended)


def _jobs(trace: Trace, seen: Seen, rows: Sequence[RowKinds]) -> Document:
    jobs, names, waits = trace.jobs, list(trace.kinds), seen.waiting
    row_of = {kind: number for number, row in enumerate(rows) for kind in row.kinds}
    kinds = [names[jobs.kind[job]] for job in seen.jobs] + [job.kind for job in waits]
    finish = [_known(jobs.finish[job], seen.before) for job in seen.jobs] + [None] * len(waits)
    deadline = [jobs.deadline[job] for job in seen.jobs] + [job.deadline for job in waits]
    late = trace.scenario.steps if seen.before == inf else float(np.nextafter(seen.before, 0))
    return {
        "row": [row_of[kind] for kind in kinds],
        "kind": [visible(kind) for kind in kinds],
        "step": [jobs.step[job] for job in seen.jobs] + [job.step for job in waits],
        "release": [jobs.release[job] for job in seen.jobs] + [job.release for job in waits],
        "start": [_known(jobs.start[job], seen.before) for job in seen.jobs] + [None] * len(waits),
        "finish": finish,
        "deadline": deadline,
        "missed": [due < done if done is not None else due <= late for due, done in zip(deadline, finish, strict=True)],
        "preemptions": _preemptions(trace, seen) + [0] * len(waits),
    }


def _known(time: float, before: float) -> float | None:
    return None if isnan(time) or time >= before else time


def _preemptions(trace: Trace, seen: Seen) -> list[int]:
    """So far: how often another job came between."""
    if not seen.jobs.size:
        return []
    starts = np.array([trace.jobs.start[job] for job in seen.jobs])
    first = float(starts[~np.isnan(starts)].min(initial=inf))
    last_run = np.zeros(len(trace.jobs.kind), np.int64)
    for bars in trace.bars:
        columns = _columns(bars, bars.between(first, seen.before))
        there = (columns["end"] < seen.before) & (columns["last"] == 1)
        np.maximum.at(last_run, columns["job"][there], columns["run"][there])
    found: list[int] = last_run[seen.jobs].tolist()
    return found


def _bars(trace: Trace, shown: Sequence[Columns], seen: Seen, rows: Sequence[RowKinds]) -> Document:
    """The styles that are used, and the bars by processor, in the order of time."""
    styles, kinds = list(trace.styles), list(trace.kinds)
    job, style, start, end = (
        np.concatenate([columns[name] for columns in shown]) for name in ("job", "style", "start", "end")
    )
    used = sorted({styles[index] for index in style}, key=_rank)
    number = {label: index for index, label in enumerate(used)}
    row_of = {kind: index for index, row in enumerate(rows) for kind in row.kinds}
    return {
        "styles": [{"label": visible(label), "meaning": visible(meaning(label))} for label in used],
        "bars": {
            "row": [row_of[kinds[trace.jobs.kind[index]]] for index in job],
            "style": [number[styles[index]] for index in style],
            "start": start.tolist(),
            "end": end.tolist(),
            "job": np.searchsorted(seen.jobs, job).tolist(),
        },
    }


def _rank(label: str) -> tuple[int, str]:
    known = list(MEANINGS)
    return (known.index(label) if label in MEANINGS else len(known), label)


def _busy(columns: Columns, first: int, until: int) -> float:
    inside = np.minimum(columns["end"], until) - np.maximum(columns["start"], first)
    return float(inside.sum())


def marks(trace: Trace, first: int, until: int) -> list[Document]:
    """k, m and l of the late measurements, in the steps of the window."""
    found = list(_marks(trace, first, until))
    return sorted(found, key=lambda mark: (mark["step"], mark["label"])) if len(found) <= MOST_MARKS else []


def _marks(trace: Trace, first: int, until: int) -> Iterator[Document]:
    late = [sensor for sensor in trace.scenario.sensors if sensor.delayed]
    for sensor in late:
        kind, name = correct_kind(sensor), visible(sensor.name)
        of = f" {name}" if len(late) > 1 else ""
        taken, arrives = trace.measured[kind]
        for letter, what, steps in (
            ("k", f"{name} measures", taken),
            ("m", f"a measurement of {name} arrives", arrives[arrives > taken]),
            ("l", f"a correction of {name} has landed", np.array(trace.landings[kind], np.int64)),
        ):
            for step in np.unique(steps[(steps >= first) & (steps < until)]).tolist():
                yield {"step": step, "label": letter + of, "meaning": what}
