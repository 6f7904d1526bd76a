"""How near the jobs of one kind are to missing their deadlines, at the start of a step."""

from __future__ import annotations

from sched_sim.scenario.engine.memory import (
    BEST,
    CPU,
    CPUS,
    CPUS_END,
    DEADLINE,
    FARTHEST,
    FINISH,
    HISTOGRAM,
    HORIZON,
    JOB_NEXT,
    KIND,
    LANES_END,
    NEAR,
    NEAREST,
    OVERHEAD,
    PERIOD,
    RELEASE,
    REMAINING,
    RUNNING,
    STEP,
    WATCHED,
    WATCHED_STEP,
    Memory,
)

TO_DEADLINE = 64
"""The time from release to deadline has so many parts."""
BINS = 2 * TO_DEADLINE


def is_elsewhere(memory: Memory, now: int) -> bool:
    """Whether this is the start of a step, for the first time, and the jobs that are watched are farther from their
    deadlines than FARTHEST, or as near as NEAREST or nearer; it is counted how near they are."""
    if now != memory[STEP] * memory[PERIOD] or now == memory[HORIZON] or memory[WATCHED_STEP] > memory[STEP]:
        return False
    memory[WATCHED_STEP] = memory[STEP] + 1
    memory[NEAR] = near = _nearness(memory, now)
    memory[memory[HISTOGRAM] + near] += 1
    return not memory[FARTHEST] <= near < memory[NEAREST]


def _nearness(memory: Memory, now: int) -> int:
    """When the latest would finish if nothing else were released, from its release, in TO_DEADLINE parts of the time to
    its deadline; less than BINS."""
    most = 0
    for cpu in range(memory[CPUS], memory[CPUS_END], CPU):
        end, job = now, memory[cpu + RUNNING]
        if job:
            end = memory[cpu + FINISH]
            most = max(most, _of_job(memory, job, end))
        for lane in range(memory[cpu + BEST], memory[cpu + LANES_END], 2):
            job = memory[lane]
            while job:
                end += memory[job + REMAINING] + memory[job + OVERHEAD]
                most = max(most, _of_job(memory, job, end))
                job = memory[job + JOB_NEXT]
    return most


def _of_job(memory: Memory, job: int, end: int) -> int:
    if memory[job + KIND] != memory[WATCHED]:
        return 0
    response, given = end - memory[job + RELEASE], memory[job + DEADLINE] - memory[job + RELEASE]
    return int(TO_DEADLINE * (response / given)) if response < 2 * given else BINS - 1
