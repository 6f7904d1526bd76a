"""The event loop: from one instant at which something happens to the next. At one instant finishes come first, then
releases, then dispatch."""

from __future__ import annotations

from typing import Any

from sched_sim.scenario.engine.composed import release_composed
from sched_sim.scenario.engine.corrections import begin_next, catch_up
from sched_sim.scenario.engine.dual_rate import finish_dual_rate, release_dual_rate
from sched_sim.scenario.engine.jobs import dispatch, forget, new_job, ready
from sched_sim.scenario.engine.landing import land
from sched_sim.scenario.engine.memory import (
    ARRIVES,
    CATCHES_UP,
    CPU,
    CPUS,
    CPUS_END,
    DEADLINE,
    DUAL_RATE,
    DUE,
    FINISH,
    FIRST,
    FREE_JOBS,
    HORIZON,
    INSTANTS,
    JOB_STEP,
    KIND,
    LANDS,
    LOG_DEADLINE,
    LOG_END,
    LOG_KIND,
    LOG_RELEASE,
    LOG_STEP,
    LOGGED,
    NEXT,
    NEXT_FINISH,
    NEXT_TASK,
    NO_KIND,
    NOTHING,
    NOW,
    OF,
    PERIOD,
    PREEMPTIVE,
    RELEASE,
    ROOM,
    RULE,
    RUNNING,
    SENSOR_KIND,
    SINCE,
    STEP,
    TAKEN_AT,
    TASK,
    TASK_COST,
    TASK_COUNT,
    TASK_CPU,
    TASK_DUE,
    TASK_KIND,
    TASK_LANE,
    TASK_NOMINAL,
    TASK_PERIOD,
    TASK_PREEMPTIVE,
    TASK_RELEASE,
    TASKS,
    TASKS_END,
    THEN,
    TICKS_BUSY,
    UNDER_WAY,
    WAITING,
    WATCHED,
    Memory,
)
from sched_sim.scenario.engine.nearness import is_elsewhere


def advance(memory: Memory, log: Any, until: int) -> bool:
    """Goes on up to the instant `until`, of which nothing is done yet, to the end of the horizon, or to a step at whose
    start the jobs that are watched are elsewhere (`nearness`); whether there was room for all jobs.

    log: an array with a row for each job that finishes.
    """
    while memory[NOW] < until:
        if memory[FREE_JOBS] < memory[ROOM]:
            return False
        now = memory[NOW]
        if memory[WATCHED] != NO_KIND and is_elsewhere(memory, now):
            return True
        if now == memory[NEXT_FINISH]:
            for cpu in range(memory[CPUS], memory[CPUS_END], CPU):
                if memory[cpu + RUNNING] and memory[cpu + FINISH] == now:
                    _finish(memory, log, cpu, now)
        if now == memory[HORIZON]:
            return True
        next_step = memory[STEP] * memory[PERIOD]
        if now == next_step:
            _release_step(memory, now)
            next_step += memory[PERIOD]
        if now == memory[NEXT_TASK]:
            _release_tasks(memory, now)
        memory[INSTANTS] += 1
        memory[NOW] = dispatch(memory, now, min(next_step, memory[NEXT_TASK], memory[HORIZON]))
    return True


def _release_step(memory: Memory, now: int) -> None:
    if memory[RULE] == DUAL_RATE:
        release_dual_rate(memory, now)
    else:
        release_composed(memory, now)
    memory[STEP] += 1


def _release_tasks(memory: Memory, now: int) -> None:
    """Those whose release has come, in the tasks' order, and when the next is."""
    following = memory[HORIZON]
    for task in range(memory[TASKS], memory[TASKS_END], TASK):
        if memory[task + TASK_RELEASE] == now:
            deadline = memory[task + TASK_NOMINAL] + memory[task + TASK_DUE]
            memory[task + TASK_NOMINAL] += memory[task + TASK_PERIOD]
            memory[task + TASK_RELEASE] = memory[task + TASK_NOMINAL]
            job = new_job(
                memory,
                memory[task + TASK_KIND],
                memory[task + TASK_COUNT],
                now,
                deadline,
                memory[task + TASK_LANE],
                memory[task + TASK_CPU],
                memory[task + TASK_COST],
                NOTHING,
            )
            memory[job + PREEMPTIVE] = memory[task + TASK_PREEMPTIVE]
            memory[task + TASK_COUNT] += 1
            ready(memory, job)
        following = min(following, memory[task + TASK_RELEASE])
    memory[NEXT_TASK] = following


def _finish(memory: Memory, log: Any, cpu: int, now: int) -> None:
    job = memory[cpu + RUNNING]
    memory[cpu + RUNNING] = 0
    memory[cpu + TICKS_BUSY] += now - memory[cpu + SINCE]
    then = memory[job + THEN]
    if then == CATCHES_UP and catch_up(memory, job, now):
        return
    if then in (LANDS, CATCHES_UP):
        _finish_corrections(memory, log, job, now)
    else:
        _write(
            memory, log, memory[job + KIND], memory[job + JOB_STEP], memory[job + RELEASE], memory[job + DEADLINE], now
        )
        if then != NOTHING:
            finish_dual_rate(memory, job, now)
    forget(memory, job)


def _write(memory: Memory, log: Any, kind: int, step: int, release: int, deadline: int, now: int) -> None:
    """That a job has finished."""
    row = memory[LOGGED]
    log[row, LOG_KIND], log[row, LOG_STEP], log[row, LOG_END] = kind, step, now
    log[row, LOG_RELEASE], log[row, LOG_DEADLINE] = release, deadline
    memory[LOGGED] = row + 1


def _finish_corrections(memory: Memory, log: Any, job: int, now: int) -> None:
    """Those that go together land."""
    period = memory[PERIOD]
    found = first = memory[job + FIRST]
    waiting = memory[memory[first + OF] + WAITING]
    while found:
        sensor, step = memory[found + OF], memory[found + TAKEN_AT]
        release, due = memory[found + ARRIVES] * period, (step + memory[sensor + DUE]) * period
        _write(memory, log, memory[sensor + SENSOR_KIND], step, release, due, now)
        found = memory[found + NEXT]
    land(memory, first, now)
    if memory[waiting + UNDER_WAY]:
        begin_next(memory, waiting, now)
