"""The jobs of `dual_rate.DualRateFilter`.

Measurements stand in the memory in the order in which they are taken: those behind one, taken since, are the next up to
TAKEN. The ring PENDING has those that are corrected and not in the state yet.
"""

from __future__ import annotations

from sched_sim.scenario.engine.jobs import new_job, ready
from sched_sim.scenario.engine.landing import put_in_order
from sched_sim.scenario.engine.links import pop, push, remove
from sched_sim.scenario.engine.memory import (
    ARRIVED,
    ARRIVES,
    BEHIND,
    BUSY,
    CORRECT,
    CORRECTED,
    CPUS,
    DEADLINE,
    DUE,
    ENDS_CORRECTION,
    ENDS_GAIN,
    ENDS_LOSS,
    FIRST,
    FOLLOWING,
    FREES_GAINS,
    GAIN,
    GAIN_AGAIN,
    GAIN_KEPT,
    GAIN_KIND,
    HR_LANE,
    HR_PASS,
    HR_RESTART,
    HR_STREAM,
    HR_UPDATE,
    IN_PENDING,
    IN_STATE,
    LANE,
    LOSS_KIND,
    LOST,
    LR_PROPAGATE,
    MEASUREMENT,
    NOTHING,
    OF,
    PENDING,
    PERIOD,
    PREDICT,
    QUEUE,
    QUEUED,
    RESTARTS,
    SENSOR_CPU,
    SENSOR_KIND,
    STEP,
    STREAM,
    TAKEN,
    TAKEN_AT,
    THEN,
    WAITS,
    Memory,
)
from sched_sim.scenario.engine.words import total


def release_dual_rate(memory: Memory, now: int) -> None:
    step, stream, behind = memory[STEP], memory[HR_STREAM], memory[TAKEN]
    work = total(memory, memory[HR_RESTART] if memory[RESTARTS] else memory[PREDICT], stream, 1)
    work += _land(memory, stream)
    first = behind
    while memory[behind + TAKEN_AT] == step:
        behind += MEASUREMENT
    memory[TAKEN] = behind
    memory[RESTARTS] = behind > first
    then = FREES_GAINS if behind > first else NOTHING
    job = new_job(memory, 0, step, now, now + memory[PERIOD], memory[HR_LANE], memory[CPUS], work, then)
    memory[job + FIRST], memory[job + BEHIND] = first, behind
    ready(memory, job)
    while memory[memory[LOST]] == step:
        found = memory[memory[LOST] + 1]
        _queue_behind(memory, found, _loss(memory, found, now))
        memory[LOST] += 2
    while memory[memory[memory[ARRIVED]] + ARRIVES] == step:
        found = memory[memory[ARRIVED]]
        sensor = memory[found + OF]
        work = total(memory, memory[sensor + CORRECT], memory[sensor + STREAM], 1)
        _queue_behind(memory, found, _job(memory, memory[sensor + SENSOR_KIND], found, now, work, ENDS_CORRECTION))
        memory[ARRIVED] += 1
    _start_next(memory)


def _land(memory: Memory, stream: int) -> int:
    """The work of what lands, in the order in which it was taken."""
    work, place = 0, memory[PENDING + FOLLOWING]
    while place != PENDING:
        found = place - IN_PENDING
        work += total(memory, memory[HR_UPDATE], stream, 1)
        for other in range(found + MEASUREMENT, memory[TAKEN], MEASUREMENT):
            sensor = memory[other + OF]
            work += total(memory, memory[sensor + HR_PASS], stream, 1)
            if memory[other + CORRECTED] and not memory[other + IN_STATE]:
                work += total(memory, memory[sensor + CORRECT], stream, 1)
        memory[found + IN_STATE] = 1
        following = memory[place + FOLLOWING]
        remove(memory, place)
        place = following
    return work


def _loss(memory: Memory, found: int, now: int) -> int:
    """The job after it is known that it never arrives."""
    sensor = memory[found + OF]
    stream = memory[sensor + STREAM]
    work = total(memory, memory[sensor + GAIN_AGAIN], stream, 1)
    other = found + MEASUREMENT
    while other < memory[TAKEN] and memory[other + QUEUED]:  # else its gain is computed after this
        own = memory[other + OF]
        if memory[other + TAKEN_AT] != memory[other - MEASUREMENT + TAKEN_AT]:
            work += total(memory, memory[LR_PROPAGATE], stream, 1)
        work += total(memory, memory[own + (GAIN_KEPT if memory[other + IN_STATE] else GAIN_AGAIN)], stream, 1)
        if memory[other + CORRECTED] and not memory[other + IN_STATE]:
            work += total(memory, memory[own + CORRECT], stream, 1)
        other += MEASUREMENT
    job = _job(memory, memory[sensor + LOSS_KIND], found, now, work, ENDS_LOSS)
    memory[job + DEADLINE] = now + memory[sensor + DUE] * memory[PERIOD]
    return job


def _queue_behind(memory: Memory, found: int, job: int) -> None:
    """Behind its gain job."""
    if memory[found + QUEUED]:
        push(memory, QUEUE, job)
    else:
        memory[found + WAITS] = job


def finish_dual_rate(memory: Memory, job: int, now: int) -> None:
    """What follows when it has done its work."""
    then, found = memory[job + THEN], memory[job + FIRST]
    if then == FREES_GAINS:
        _free_gains(memory, found, memory[job + BEHIND], now)
    else:
        memory[BUSY] = 0
        if then == ENDS_CORRECTION:
            memory[found + CORRECTED] = 1
            put_in_order(memory, found)
        elif then == ENDS_LOSS:
            memory[found + IN_STATE] = 1
    _start_next(memory)


def _free_gains(memory: Memory, first: int, behind: int, now: int) -> None:
    """The message of the predict job of their step is there."""
    for found in range(first, behind, MEASUREMENT):
        sensor = memory[found + OF]
        work = total(memory, memory[LR_PROPAGATE], memory[sensor + STREAM], 1) if found == first else 0
        work += total(memory, memory[sensor + GAIN], memory[sensor + STREAM], 1)
        push(memory, QUEUE, _job(memory, memory[sensor + GAIN_KIND], found, now, work, ENDS_GAIN))
        memory[found + QUEUED] = 1
        if memory[found + WAITS]:
            push(memory, QUEUE, memory[found + WAITS])


def _start_next(memory: Memory) -> None:
    """The first of the queue, if none is under way."""
    if not memory[BUSY]:
        job = pop(memory, QUEUE)
        if job:
            memory[BUSY] = 1
            ready(memory, job)


def _job(memory: Memory, kind: int, found: int, now: int, work: int, then: int) -> int:
    """Of the low-rate task, due as the correction is."""
    sensor, step = memory[found + OF], memory[found + TAKEN_AT]
    due = (step + memory[sensor + DUE]) * memory[PERIOD]
    job = new_job(memory, kind, step, now, due, memory[sensor + LANE], memory[sensor + SENSOR_CPU], work, then)
    memory[job + FIRST] = found
    return job
