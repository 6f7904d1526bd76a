"""Random draws from streams in the memory: the numbers of NumPy's PCG64, and of its `Generator.integers`.

A stream is what `PCG64` has as its state, in parts of 32 bits, the lowest first: its number of 128 bits and what is
added to it in each step, whether half of the last result is left, and that half (M. E. O'Neill, PCG: a family of
simple fast space-efficient statistically good algorithms for random number generation, HMC-CS-2014-0905, 2014: XSL RR).
Products of two parts fill 64 bits, whatever their sign says.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sched_sim.scenario.engine.memory import Memory

STATE, ADDED, HAS_HALF, HALF, STREAM_SIZE = 0, 4, 8, 9, 10
PART = 0xFFFFFFFF
M0, M1, M2, M3 = 0x9FCCF645, 0x4385DF64, 0x1FC65DA4, 0x2360ED05
"""The multiplier 0x2360ED051FC65DA44385DF649FCCF645."""


def stream_of(state: Mapping[str, Any]) -> list[int]:
    """The stream in the state of a `PCG64`."""
    numbers = state["state"]
    parts = [numbers[name] >> shift & PART for name in ("state", "inc") for shift in (0, 32, 64, 96)]
    return [*parts, state["has_uint32"], state["uinteger"]]


def total(memory: Memory, part: int, stream: int, executions: int) -> int:
    """The time that so many executions of a part take, as `draws.total` has it. part: how many times there are, and
    they."""
    count = memory[part]
    if count == 1:
        return int(executions * memory[part + 1])
    work, rare, done = 0, (PART + 1) % count, 0
    while done < executions:
        scaled = word(memory, stream) * count
        if scaled & PART >= rare:
            work += memory[part + 1 + (scaled >> 32 & PART)]
            done += 1
    return work


def word(memory: Memory, stream: int) -> int:
    """32 random bits."""
    if memory[stream + HAS_HALF]:
        memory[stream + HAS_HALF] = 0
        return int(memory[stream + HALF])
    step(memory, stream)
    low = memory[stream] ^ memory[stream + 2]
    high = memory[stream + 1] ^ memory[stream + 3]
    turn = memory[stream + 3] >> 26
    if turn & 32:
        low, high = high, low
    turn &= 31
    memory[stream + HAS_HALF] = 1
    memory[stream + HALF] = high >> turn | low << (32 - turn) & PART
    return int(low >> turn | high << (32 - turn) & PART)


def step(memory: Memory, stream: int) -> None:
    """The number of 128 bits times the multiplier, and what is added."""
    s0, s1, s2, s3 = memory[stream], memory[stream + 1], memory[stream + 2], memory[stream + 3]
    p00, p01, p10 = s0 * M0, s0 * M1, s1 * M0
    p02, p11, p20 = s0 * M2, s1 * M1, s2 * M0
    sum0 = (p00 & PART) + memory[stream + ADDED]
    sum1 = (p00 >> 32 & PART) + (p01 & PART) + (p10 & PART) + memory[stream + ADDED + 1] + (sum0 >> 32)
    sum2 = (p01 >> 32 & PART) + (p10 >> 32 & PART) + (p02 & PART) + (p11 & PART) + (p20 & PART)
    sum2 += memory[stream + ADDED + 2] + (sum1 >> 32)
    sum3 = (p02 >> 32 & PART) + (p11 >> 32 & PART) + (p20 >> 32 & PART)
    sum3 += (s0 * M3 & PART) + (s1 * M2 & PART) + (s2 * M1 & PART) + (s3 * M0 & PART)
    sum3 += memory[stream + ADDED + 3] + (sum2 >> 32)
    memory[stream] = sum0 & PART
    memory[stream + 1] = sum1 & PART
    memory[stream + 2] = sum2 & PART
    memory[stream + 3] = sum3 & PART
