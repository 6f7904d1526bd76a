"""The corrections of `source.ComposedFilter`: when they start, their work, catching up, landing."""

from __future__ import annotations

from sched_sim.scenario.engine.jobs import new_job, ready
from sched_sim.scenario.engine.landing import first_after, is_carried, part_of
from sched_sim.scenario.engine.links import pop, push
from sched_sim.scenario.engine.memory import (
    ABOUT,
    AIM,
    APPLIED,
    ARRIVED,
    ARRIVES,
    AT,
    AWAITED,
    AWAITED_STEP,
    BEFORE,
    BESIDE,
    CARRIED,
    CATCHES_UP,
    CORRECT,
    CORRECT_ACCUMULATE,
    DUE,
    FIRST,
    FLYING,
    FOLLOWING,
    HEAD,
    IN_CARRIED,
    IN_FLYING,
    IN_PENDING,
    JOB_LANE,
    LAND,
    LANDED,
    LANDS,
    LANE,
    LEADER,
    NEXT,
    OF,
    ONE,
    ORDER,
    OVERHEAD,
    PENDING,
    PERIOD,
    PREDICT,
    PREEMPTED,
    PREVIOUS,
    REMAINING,
    RULE,
    SEEN,
    SENSOR_CPU,
    SENSOR_KIND,
    SEVERAL,
    STREAM,
    TAKEN_AT,
    TO_STATE,
    UNDER_WAY,
    WAITING,
    WAITING_QUEUE,
    Memory,
)
from sched_sim.scenario.engine.words import total


def begin(memory: Memory, first: int, now: int) -> None:
    """Of those that arrive together; a preempted one waits while another of its priority is under way."""
    sensor = memory[first + OF]
    if memory[sensor + PREEMPTED]:
        waiting = memory[sensor + WAITING]
        if memory[waiting + UNDER_WAY]:
            _wait(memory, waiting, first)
            return
        memory[waiting + UNDER_WAY] = 1
    _correct(memory, first, now)


def _wait(memory: Memory, waiting: int, first: int) -> None:
    found = first
    while found:
        following = memory[found + NEXT]
        push(memory, waiting + WAITING_QUEUE, found)
        found = following


def begin_next(memory: Memory, waiting: int, now: int) -> None:
    """A preempted correction has landed: the first that waits for it starts, with all the others unless it is carried,
    and they are not."""
    queue = waiting + WAITING_QUEUE
    first = last = pop(memory, queue)
    if not first:
        memory[waiting + UNDER_WAY] = 0
        return
    memory[first + NEXT] = 0
    if not is_carried(memory, first):
        found, memory[queue + HEAD] = memory[queue + HEAD], 0
        while found:
            following = memory[found + NEXT]
            if is_carried(memory, found):
                push(memory, queue, found)
            else:
                memory[last + NEXT], memory[found + NEXT] = found, 0
                last = found
            found = following
    _correct(memory, first, now)


def _correct(memory: Memory, first: int, now: int) -> None:
    """Settles the work of corrections that can start now."""
    sensor = memory[first + OF]
    then = LANDS
    if is_carried(memory, first):
        work = total(memory, memory[sensor + LAND], memory[sensor + STREAM], 1)
    else:
        work = _work(memory, first, now // memory[PERIOD])
        if memory[sensor + PREEMPTED]:
            then = CATCHES_UP
    step, period = memory[first + TAKEN_AT], memory[PERIOD]
    release, due = memory[first + ARRIVES] * period, (step + memory[sensor + DUE]) * period
    job = new_job(
        memory,
        memory[sensor + SENSOR_KIND],
        step,
        release,
        due,
        memory[sensor + LANE],
        memory[sensor + SENSOR_CPU],
        work,
        then,
    )
    memory[job + FIRST] = first
    memory[job + AIM], memory[job + SEEN] = now // period, memory[LANDED]
    memory[job + BEFORE] = memory[ARRIVED]
    ready(memory, job)


def _work(memory: Memory, first: int, step: int) -> int:
    """Of those that go together, to the state of this step."""
    stream = memory[memory[first + OF] + STREAM]
    accumulates = memory[RULE] == ONE and _waits(memory, first, step)
    work, back, found = 0, step, first
    while found:
        sensor = memory[found + OF]
        work += total(memory, memory[sensor + (CORRECT_ACCUMULATE if accumulates else CORRECT)], stream, 1)
        back = min(back, memory[found + TAKEN_AT])
        found = memory[found + NEXT]
    if memory[RULE] == SEVERAL:
        found, flying = first, _in_flight(memory, first, step)
        while found:
            sensor = memory[found + OF]
            work += total(memory, memory[sensor + BESIDE], memory[sensor + STREAM], flying)
            found = memory[found + NEXT]
    after = back - 1 if back < step else back  # from the prediction of step `back`, or from the state as it is
    work += total(memory, memory[PREDICT], stream, step - back)
    work += _arrived_after(memory, first, after, stream)
    return work + _applied_after(memory, after, stream)


def _arrived_after(memory: Memory, first: int, step: int, stream: int) -> int:
    """The corrections, in the history of the steps after this one, that land before these do."""
    place = memory[PENDING + PREVIOUS]
    while place != PENDING and memory[place - IN_PENDING + TAKEN_AT] > step:
        place = memory[place + PREVIOUS]
    place, work = memory[place + FOLLOWING], 0
    while place != PENDING:
        found = place - IN_PENDING
        if _is_ahead(memory, found, first) and not is_carried(memory, found):
            work += total(memory, memory[memory[found + OF] + CORRECT], stream, 1)
        place = memory[place + FOLLOWING]
    return work


def _applied_after(memory: Memory, step: int, stream: int) -> int:
    """The corrections that are in the history of the steps after this one."""
    place, work = first_after(memory, step), 0
    while place != APPLIED:
        work += total(memory, part_of(memory, place), stream, 1)
        place = memory[place + FOLLOWING]
    return work


def _is_ahead(memory: Memory, found: int, first: int) -> bool:
    """Whether the correction of one that has arrived lands before these do; those that wait for them do not."""
    own, sensor = memory[memory[found + OF] + LANE], memory[first + OF]
    if memory[sensor + PREEMPTED]:
        return bool(own < memory[sensor + LANE])
    return bool(own <= memory[sensor + LANE] and memory[found + LEADER] != first)


def _waits(memory: Memory, first: int, step: int) -> bool:
    """Whether something taken before `step` will still be in flight when these have landed."""
    if memory[AWAITED] and memory[AWAITED_STEP] < step:
        return True
    place = memory[CARRIED + FOLLOWING]
    while place != CARRIED:
        found = place - IN_CARRIED
        if memory[found + TAKEN_AT] < step and not _is_ahead(memory, found, first):
            return True
        place = memory[place + FOLLOWING]
    return False


def _in_flight(memory: Memory, first: int, step: int) -> int:
    """How many taken by `step` will still be in flight when these have landed."""
    count = 0
    place = memory[FLYING + FOLLOWING]
    while place != FLYING:
        count += memory[place - IN_FLYING + TAKEN_AT] <= step
        place = memory[place + FOLLOWING]
    place = memory[CARRIED + FOLLOWING]
    while place != CARRIED:
        found = place - IN_CARRIED
        count -= memory[found + TAKEN_AT] <= step and _is_ahead(memory, found, first)
        place = memory[place + FOLLOWING]
    return count


def catch_up(memory: Memory, job: int, now: int) -> bool:
    """Whether the corrections have to go on, with the steps that passed meanwhile and what landed meanwhile: from the
    earliest of those measurements if that is before the step they had reached."""
    aim, first, period = memory[job + AIM], memory[job + FIRST], memory[PERIOD]
    if (now - 1) // period <= aim:
        return False
    back = aim
    for entry in range(memory[job + SEEN], memory[LANDED]):
        if not _was_ahead(memory, memory[entry], job):
            back = min(back, memory[memory[entry] + AT])
    stream = memory[memory[first + OF] + STREAM]
    work = total(memory, memory[PREDICT], stream, now // period - back)
    if back < aim:  # from the prediction of that step
        work += _applied_after(memory, back - 1, stream)
        found = first
        while found:
            if memory[found + TAKEN_AT] >= back:
                work += total(memory, memory[memory[found + OF] + CORRECT], stream, 1)
            found = memory[found + NEXT]
    else:
        work += _applied_after(memory, back, stream)
        for entry in range(memory[job + SEEN], memory[LANDED]):
            applied = memory[entry]
            if memory[applied + AT] == back and not _was_ahead(memory, applied, job):
                work += total(memory, part_of(memory, applied), stream, 1)
    memory[job + AIM], memory[job + SEEN] = now // period, memory[LANDED]
    memory[job + REMAINING], memory[job + OVERHEAD] = work, 0
    ready(memory, job)
    return True


def _was_ahead(memory: Memory, applied: int, job: int) -> bool:
    """Whether it was clear, when the work was settled, that it would land before."""
    found = memory[applied + ABOUT]
    if applied != found + TO_STATE or memory[found + ORDER] >= memory[job + BEFORE]:
        return False
    return bool(memory[memory[found + OF] + LANE] < memory[job + JOB_LANE])
