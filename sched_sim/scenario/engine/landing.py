"""Measurements that have arrived and not landed, and what has been applied to the state, as the rules ask for them."""

from __future__ import annotations

from sched_sim.scenario.engine.links import insert, is_in, remove
from sched_sim.scenario.engine.memory import (
    ABOUT,
    APPLIED,
    ARRIVES,
    AT,
    CORRECT,
    DELAYED,
    FLYING_COUNT,
    FOLLOWING,
    IN_CARRIED,
    IN_FLYING,
    IN_PENDING,
    LAND,
    LANDED,
    NEXT,
    OF,
    ONE,
    PENDING,
    PERIOD,
    PREVIOUS,
    RULE,
    SEVERAL,
    TAKEN_AT,
    TO_STATE,
    Memory,
)


def is_late(memory: Memory, found: int) -> bool:
    """Whether it arrives in a later step than that in which it is taken."""
    return bool(memory[found + ARRIVES] != memory[found + TAKEN_AT])


def is_carried(memory: Memory, found: int) -> bool:
    """Whether it is carried to the step in which it lands, instead of being replayed from its own."""
    if memory[RULE] == SEVERAL:
        return is_late(memory, found)
    return bool(memory[RULE] == ONE and memory[memory[found + OF] + DELAYED])


def part_of(memory: Memory, applied: int) -> int:
    """That of which it costs the work to apply it once more."""
    found = memory[applied + ABOUT]
    carried = applied == found + TO_STATE and is_carried(memory, found)
    return int(memory[memory[found + OF] + (LAND if carried else CORRECT)])


def put_in_order(memory: Memory, found: int) -> None:
    """Among those that have arrived."""
    previous = memory[PENDING + PREVIOUS]
    while previous > found:
        previous = memory[previous + PREVIOUS]
    insert(memory, found + IN_PENDING, previous)


def apply(memory: Memory, applied: int, step: int) -> None:
    """To the state of this step."""
    previous = memory[APPLIED + PREVIOUS]
    while memory[previous + AT] > step:
        previous = memory[previous + PREVIOUS]
    insert(memory, applied, previous)
    memory[applied + AT] = step
    memory[memory[LANDED]] = applied
    memory[LANDED] += 1


def first_after(memory: Memory, step: int) -> int:
    """The first that has been applied to a later step, else APPLIED."""
    place = memory[APPLIED + PREVIOUS]
    while memory[place + AT] > step:
        place = memory[place + PREVIOUS]
    return int(memory[place + FOLLOWING])


def leave(memory: Memory, found: int) -> None:
    """It is no longer in flight."""
    if is_in(memory, found + IN_FLYING):
        remove(memory, found + IN_FLYING)
        memory[FLYING_COUNT] -= 1


def land(memory: Memory, first: int, now: int) -> None:
    """Those that go together are in the state."""
    found = first
    while found:
        remove(memory, found + IN_PENDING)
        if is_in(memory, found + IN_CARRIED):
            remove(memory, found + IN_CARRIED)
        leave(memory, found)
        step = (now - 1) // memory[PERIOD] if is_carried(memory, found) else memory[found + TAKEN_AT]
        apply(memory, found + TO_STATE, step)
        found = memory[found + NEXT]
