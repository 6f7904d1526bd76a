"""The jobs of `source.ComposedFilter`: what a step begins with, and what is taken and arrives in it."""

from __future__ import annotations

from sched_sim.scenario.engine.corrections import begin
from sched_sim.scenario.engine.jobs import new_job, ready
from sched_sim.scenario.engine.landing import apply, is_carried, is_late, leave, put_in_order
from sched_sim.scenario.engine.links import insert
from sched_sim.scenario.engine.memory import (
    ARRIVED,
    ARRIVES,
    AWAITED,
    AWAITED_ARRIVES,
    AWAITED_STEP,
    BESIDE,
    CARRIED,
    CARRY,
    CORRECT,
    CPUS,
    DELAYED,
    FLYING,
    FLYING_COUNT,
    FOLLOWING,
    HR_LANE,
    HR_STREAM,
    IN_CARRIED,
    IN_FLYING,
    LANE,
    LEADER,
    LOST,
    MEASUREMENT,
    NEVER,
    NEXT,
    NOTHING,
    OF,
    ONE,
    PERIOD,
    PREDICT,
    PREDICT_ACCUMULATE,
    PREVIOUS,
    RULE,
    SENSOR_CPU,
    SEVERAL,
    STEP,
    STREAM,
    TAKEN,
    TAKEN_AT,
    TO_COVARIANCE,
    Memory,
)
from sched_sim.scenario.engine.words import total


def release_composed(memory: Memory, now: int) -> None:
    step = memory[STEP]
    several, one = memory[RULE] == SEVERAL, memory[RULE] == ONE
    waits = one and (memory[AWAITED] or memory[CARRIED + FOLLOWING] != CARRIED)
    work = total(memory, memory[PREDICT_ACCUMULATE] if waits else memory[PREDICT], memory[HR_STREAM], 1)
    landing_first = 0
    place = memory[FLYING + FOLLOWING]
    while place != FLYING:
        found = place - IN_FLYING
        sensor = memory[found + OF]
        if _lands_first(memory, found, sensor, step):
            landing_first += 1
        else:
            work += total(memory, memory[sensor + CARRY], memory[HR_STREAM], 1)
        place = memory[place + FOLLOWING]
    found = memory[TAKEN]
    while memory[found + TAKEN_AT] == step:
        if memory[found + ARRIVES] != step and memory[memory[found + OF] + DELAYED]:
            if one:
                _await(memory, step, memory[found + ARRIVES])
            elif several:
                work += _correct_covariance(memory, found, memory[FLYING_COUNT] - landing_first)
        found += MEASUREMENT
    memory[TAKEN] = found
    while several and memory[memory[LOST]] == step:
        leave(memory, memory[memory[LOST] + 1])
        memory[LOST] += 2
    ready(memory, new_job(memory, 0, step, now, now + memory[PERIOD], memory[HR_LANE], memory[CPUS], work, NOTHING))
    if memory[AWAITED] and memory[AWAITED_ARRIVES] == step:
        memory[AWAITED] = 0
    _arrive(memory, step, now)


def _lands_first(memory: Memory, found: int, sensor: int, step: int) -> bool:
    """Whether it has arrived, and will have landed when the predict job of this step begins."""
    if memory[found + ARRIVES] == NEVER or memory[found + ARRIVES] > step:
        return False
    return bool(memory[sensor + LANE] < memory[HR_LANE] and memory[sensor + SENSOR_CPU] == memory[CPUS])


def _await(memory: Memory, step: int, arrives: int) -> None:
    """One that will never arrive is not waited for while another is in flight."""
    current = memory[AWAITED_ARRIVES]
    if arrives != NEVER or not memory[AWAITED] or current in (NEVER, step):
        memory[AWAITED], memory[AWAITED_STEP], memory[AWAITED_ARRIVES] = 1, step, arrives


def _correct_covariance(memory: Memory, found: int, in_flight: int) -> int:
    """The work of it, by one that comes late, with so many in flight; from now on it is too."""
    sensor = memory[found + OF]
    work = total(memory, memory[sensor + CORRECT], memory[sensor + STREAM], 1)
    work += total(memory, memory[sensor + BESIDE], memory[sensor + STREAM], in_flight)
    insert(memory, found + IN_FLYING, memory[FLYING + PREVIOUS])
    memory[FLYING_COUNT] += 1
    apply(memory, found + TO_COVARIANCE, memory[found + TAKEN_AT])
    return work


def _arrive(memory: Memory, step: int, now: int) -> None:
    """Those that arrive in this step, in the order of their corrections."""
    entry = memory[ARRIVED]
    while memory[memory[entry] + ARRIVES] == step:
        if is_carried(memory, memory[entry]):
            insert(memory, memory[entry] + IN_CARRIED, CARRIED)
        entry += 1
    behind = entry
    while memory[ARRIVED] < behind:
        begin(memory, _together(memory, behind), now)


def _together(memory: Memory, behind: int) -> int:
    """The next that arrives, and linked to it those that go back with it."""
    first = last = memory[memory[ARRIVED]]
    while True:
        memory[last + LEADER], memory[last + NEXT] = first, 0
        put_in_order(memory, last)
        memory[ARRIVED] += 1
        found = memory[memory[ARRIVED]]
        lane = memory[memory[first + OF] + LANE]
        if memory[ARRIVED] == behind or memory[memory[found + OF] + LANE] != lane:
            return int(first)
        if not (_goes_back(memory, first) and _goes_back(memory, found)):
            return int(first)
        memory[last + NEXT] = found
        last = found


def _goes_back(memory: Memory, found: int) -> bool:
    return bool(is_late(memory, found) and not is_carried(memory, found))
