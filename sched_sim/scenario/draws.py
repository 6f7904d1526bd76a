"""Random draws of a scenario: a stream of its own for each purpose, so that what one draws changes no other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

Drawn = TypeVar("Drawn")


def stream(seed: int, purpose: str) -> np.random.Generator:
    """The random numbers for one purpose, such as "gps delay"; seed: 0 or more."""
    return np.random.default_rng([seed, *purpose.encode()])


def total(samples: Sequence[int], generator: np.random.Generator, executions: int = 1) -> int:
    """The time that so many executions take together, each drawn from `samples` with equal probability."""
    if len(samples) == 1:
        return executions * samples[0]
    return sum(samples[number] for number in generator.integers(len(samples), size=executions).tolist())


def fates(delays: Sequence[Drawn], dropout: float, count: int, seed: int, name: str) -> list[Drawn | None]:
    """For each of a sensor's measurements the delay until it arrives, or None if it never does.

    delays: drawn from with equal probability; dropout: the probability of None. A measurement that is lost has used up
    its delay, so that another dropout leaves the delays of those that arrive as they are.
    """
    lost = stream(seed, f"{name} dropout").random(count) < dropout
    drawn = stream(seed, f"{name} delay").integers(len(delays), size=count).tolist()
    return [None if gone else delays[number] for gone, number in zip(lost.tolist(), drawn, strict=True)]
