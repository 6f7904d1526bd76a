"""Queues, first in, first out, and rings that are kept sorted, of things in the memory."""

from __future__ import annotations

from sched_sim.scenario.engine.memory import FOLLOWING, HEAD, NEXT, PREVIOUS, TAIL, Memory


def push(memory: Memory, queue: int, thing: int) -> None:
    memory[thing + NEXT] = 0
    if memory[queue + HEAD]:
        memory[memory[queue + TAIL] + NEXT] = thing
    else:
        memory[queue + HEAD] = thing
    memory[queue + TAIL] = thing


def push_first(memory: Memory, queue: int, thing: int) -> None:
    memory[thing + NEXT] = memory[queue + HEAD]
    if not memory[queue + HEAD]:
        memory[queue + TAIL] = thing
    memory[queue + HEAD] = thing


def pop(memory: Memory, queue: int) -> int:
    """The first, 0 if there is none."""
    thing: int = memory[queue + HEAD]
    if thing:
        memory[queue + HEAD] = memory[thing + NEXT]
    return thing


def insert(memory: Memory, place: int, previous: int) -> None:
    """In a ring, behind `previous`."""
    following = memory[previous + FOLLOWING]
    memory[place + PREVIOUS], memory[place + FOLLOWING] = previous, following
    memory[previous + FOLLOWING] = memory[following + PREVIOUS] = place


def remove(memory: Memory, place: int) -> None:
    """Out of the ring it is in; `is_in` knows."""
    previous, following = memory[place + PREVIOUS], memory[place + FOLLOWING]
    memory[previous + FOLLOWING], memory[following + PREVIOUS] = following, previous
    memory[place + FOLLOWING] = 0


def is_in(memory: Memory, place: int) -> bool:
    """Whether it is in a ring."""
    return bool(memory[place + FOLLOWING])
