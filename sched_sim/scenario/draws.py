"""Random draws of a scenario: a stream of its own for each purpose, so that what one draws changes no other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import TypeVar

import numpy as np

Drawn = TypeVar("Drawn")

BLOCK = 4096
"""So many words are drawn at a time."""
WORD = 1 << 32


def stream(seed: int, purpose: str) -> np.random.Generator:
    """The random numbers for one purpose, such as "gps delay"; seed: 0 or more."""
    return np.random.Generator(np.random.PCG64([seed, *purpose.encode()]))


def words(seed: int, purpose: str) -> Iterator[int]:
    """Random whole numbers of 32 bits for one purpose, without end."""
    generator = stream(seed, purpose)
    while True:
        yield from generator.integers(WORD, size=BLOCK, dtype=np.uint32).tolist()


def total(samples: Sequence[int], drawn: Iterator[int], executions: int = 1) -> int:
    """The time that so many executions take together, each drawn from `samples` with equal probability.

    drawn: `words`. What is drawn from them is what `Generator.integers` draws, number for number: of a word times the
    count of samples what is above 32 bits, unless the rest says that this one would come too often (D. Lemire, Fast
    random integer generation in an interval, ACM TOMACS 29(1), 2019, algorithm 5).
    """
    count = len(samples)
    if count == 1:
        return executions * samples[0]
    work, rare = 0, WORD % count
    for word in islice(drawn, executions):
        scaled = word * count
        while scaled % WORD < rare:
            scaled = next(drawn) * count
        work += samples[scaled // WORD]
    return work


def lost_and_drawn(delays: int, dropout: float, count: int, seed: int, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Of each of a sensor's measurements whether it never arrives, and the number of its delay, of so many."""
    lost = stream(seed, f"{name} dropout").random(count) < dropout
    return lost, stream(seed, f"{name} delay").integers(delays, size=count)


def fates(delays: Sequence[Drawn], dropout: float, count: int, seed: int, name: str) -> list[Drawn | None]:
    """For each of a sensor's measurements the delay until it arrives, or None if it never does.

    delays: drawn from with equal probability; dropout: the probability of None. A measurement that is lost has used up
    its delay, so that another dropout leaves the delays of those that arrive as they are.
    """
    lost, drawn = lost_and_drawn(len(delays), dropout, count, seed, name)
    return [None if gone else delays[number] for gone, number in zip(lost.tolist(), drawn.tolist(), strict=True)]
