"""The jobs of a scenario's run that wait, and have not run for a long time: where work piles up."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, takewhile
from typing import NamedTuple

import numpy as np

from sched_sim.scenario.engine.measured import Ints
from sched_sim.scenario.kinds import correct_kind
from sched_sim.schedule.intervals import TASK
from sched_sim.schedule.tasks import Task
from studies.explorer.scenario_trace import Trace


class Waiting(NamedTuple):
    """A job that was released; times in HR periods."""

    release: float
    kind: str
    step: int
    deadline: float


def waiting(trace: Trace, until: int, before: float) -> list[Waiting]:
    """Of predict jobs, corrections and tasks those that were released before the start of step `until`, and had not run
    by `before`; in the order of their release. Jobs of one kind run in that order, but for corrections."""
    scenario = trace.scenario
    found = [Waiting(float(step), "predict", step, step + 1.0) for step in range(_ran(trace, "predict", before), until)]
    for task in scenario.tasks:
        released = _released(task, _ran(trace, f"{TASK}{task.name}", before))
        found += takewhile(lambda job: job.release < until, released)
    for sensor in scenario.sensors:
        kind, due = correct_kind(sensor), scenario.due(sensor)
        steps, arrives = trace.measured[kind]
        there = (arrives >= 0) & (arrives < until)
        late = ~np.isin(steps[there], _steps(trace, kind, before))
        pairs = zip(steps[there][late].tolist(), arrives[there][late].tolist(), strict=True)
        found += [Waiting(float(arrived), kind, step, float(step + due)) for step, arrived in pairs]
    return sorted(found)


def _ran(trace: Trace, kind: str, before: float) -> int:
    """How many jobs of a kind had run by then."""
    return _steps(trace, kind, before).size


def _steps(trace: Trace, kind: str, before: float) -> Ints:
    """Of the jobs of a kind that had run by then."""
    jobs = trace.jobs
    own = (np.array(jobs.kind) == trace.kinds[kind]) & (np.array(jobs.seen) < before)
    found: Ints = np.array(jobs.step, np.int64)[own]
    return found


def _released(task: Task, first: int) -> Iterator[Waiting]:
    """The jobs of a task from this number on, as `TaskSource` releases them."""
    for number in count(first):
        nominal = task.start + number * task.period
        release = nominal if number else nominal + task.jitter
        yield Waiting(float(release), f"{TASK}{task.name}", number, float(nominal + task.due))
