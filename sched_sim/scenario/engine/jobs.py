"""Jobs in the memory, and the processors that run them: each has a queue for each priority."""

from __future__ import annotations

from sched_sim.scenario.engine.links import pop, push, push_first
from sched_sim.scenario.engine.memory import (
    BEST,
    CPU,
    CPUS,
    CPUS_END,
    DEADLINE,
    FINISH,
    FREE,
    FREE_JOBS,
    HEAD,
    JOB_CPU,
    JOB_LANE,
    JOB_NEXT,
    JOB_STEP,
    JOBS,
    KIND,
    LANES_END,
    LAST_RUN,
    NEXT_FINISH,
    NO_KIND,
    NUMBER,
    OVERHEAD,
    PREEMPTED_JOBS,
    PREEMPTIVE,
    RELEASE,
    REMAINING,
    RUNNING,
    SINCE,
    SWITCH,
    THEN,
    TICKS_BUSY,
    Memory,
)


def new_job(
    memory: Memory, kind: int, step: int, release: int, deadline: int, lane: int, cpu: int, work: int, then: int
) -> int:
    """lane, cpu: where it will wait and run."""
    job: int = memory[FREE]
    memory[FREE] = memory[job + JOB_NEXT]
    memory[FREE_JOBS] -= 1
    memory[JOBS] += 1
    memory[job + NUMBER] = memory[JOBS]
    memory[job + KIND], memory[job + JOB_STEP] = kind, step
    memory[job + RELEASE], memory[job + DEADLINE] = release, deadline
    memory[job + JOB_LANE], memory[job + JOB_CPU], memory[job + PREEMPTIVE] = lane, cpu, 1
    memory[job + REMAINING], memory[job + OVERHEAD], memory[job + THEN] = work, 0, then
    return job


def forget(memory: Memory, job: int) -> None:
    """It has finished."""
    memory[job + KIND] = NO_KIND
    memory[job + JOB_NEXT] = memory[FREE]
    memory[FREE] = job
    memory[FREE_JOBS] += 1


def ready(memory: Memory, job: int) -> None:
    """It may run from now on."""
    lane, cpu = memory[job + JOB_LANE], memory[job + JOB_CPU]
    push(memory, lane, job)
    memory[cpu + BEST] = min(memory[cpu + BEST], lane)


def dispatch(memory: Memory, now: int, until: int) -> int:
    """Each processor goes on with the most urgent job; the next instant at which one finishes, or `until` if that is
    before."""
    memory[NEXT_FINISH] = -1
    for cpu in range(memory[CPUS], memory[CPUS_END], CPU):
        running, lane = memory[cpu + RUNNING], memory[cpu + BEST]
        end = memory[cpu + LANES_END]
        while lane < end and not memory[lane + HEAD]:
            lane += 2
        memory[cpu + BEST] = lane
        if lane < end and (not running or (memory[running + PREEMPTIVE] and lane < memory[running + JOB_LANE])):
            job = pop(memory, lane)
            if running:
                _preempt(memory, cpu, running, now)
            _start(memory, cpu, job, now)
            running = job
        if running and memory[cpu + FINISH] <= until:
            until = memory[NEXT_FINISH] = memory[cpu + FINISH]
    return until


def _preempt(memory: Memory, cpu: int, job: int, now: int) -> None:
    ran = now - memory[cpu + SINCE]
    overhead = min(ran, memory[job + OVERHEAD])
    memory[job + OVERHEAD] -= overhead
    memory[job + REMAINING] -= ran - overhead
    memory[cpu + TICKS_BUSY] += ran
    memory[memory[PREEMPTED_JOBS] + memory[job + KIND]] += 1
    push_first(memory, memory[job + JOB_LANE], job)


def _start(memory: Memory, cpu: int, job: int, now: int) -> None:
    if memory[SWITCH] and memory[job + NUMBER] != memory[cpu + LAST_RUN]:
        memory[job + OVERHEAD] += memory[SWITCH]
        memory[cpu + LAST_RUN] = memory[job + NUMBER]
    memory[cpu + RUNNING], memory[cpu + SINCE] = job, now
    memory[cpu + FINISH] = now + memory[job + REMAINING] + memory[job + OVERHEAD]
