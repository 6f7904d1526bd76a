"""Runs the compiled event loop over a scenario, and gives it room where it runs out of it."""

from __future__ import annotations

import numpy as np

from sched_sim.compiled import compiled
from sched_sim.scenario.engine import memory as at
from sched_sim.scenario.engine.layout import memory_of, with_jobs
from sched_sim.scenario.engine.loop import advance
from sched_sim.scenario.engine.measured import Ints, Measured
from sched_sim.scenario.workload import Workload
from sched_sim.schedule.clock import REPORTS, OnProgress


def run(work: Workload, found: Measured, on_progress: OnProgress | None = None) -> tuple[Ints, Ints]:
    """The memory at the end, and the log: a row for each job that finished."""
    steps, memory, log = work.scenario.steps, memory_of(work, found), empty_log(work, found)
    stride = steps if on_progress is None else max(steps // REPORTS, 1)
    for step in range(0, steps, stride):
        if on_progress is not None:
            on_progress(step, steps, "HR steps")
        last = step + stride >= steps
        memory = advanced(memory, log, work.horizon + 1 if last else (step + stride) * work.period)
    return memory, log[: memory[at.LOGGED]]


def empty_log(work: Workload, found: Measured) -> Ints:
    """With a row for each job that may finish."""
    of_tasks = sum(work.horizon // source.period + 2 for source in work.tasks())
    return np.empty((work.scenario.steps + 2 * found.step.size + of_tasks, at.LOG), np.int64)


def advanced(memory: Ints, log: Ints, until: int) -> Ints:
    """The memory where `advance` has gone to."""
    go_on = compiled(advance)
    while not go_on(memory, log, until):
        memory = with_jobs(memory, (memory.size - memory[at.FIRST_JOB]) // at.JOB)
    return memory
