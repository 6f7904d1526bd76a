"""Laws over whole ticks: arrays of masses, number i that of i ticks.

All is sums and products of non-negative numbers, so that a mass of 1e-21 is as accurate as one near 1; a convolution by
FFT would leave rounding errors of the largest mass everywhere.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from functools import cached_property
from typing import TypeVar

import numpy as np

from sched_sim.probability.outcome import Floats

FEW, DENSE = 24, 1 / 8
"""A law of so few values, or of so few of those from its least to its largest, is added value by value, which is faster
than to convolve."""

NOTHING = 1e-32
"""A mass that is not followed; what is left out is counted."""

Key = TypeVar("Key", bound=Hashable)


class Law:
    """Of the time that an execution takes; its masses sum to 1."""

    def __init__(self, mass: Floats) -> None:
        self.mass = mass
        self.values = np.flatnonzero(mass)
        self._powers = {1: self}

    @property
    def worst(self) -> int:
        return int(self.values[-1])

    @cached_property
    def mean(self) -> float:
        return float(self.mass @ np.arange(len(self.mass)))

    def added_to(self, mass: Floats) -> Floats:
        """The law of a sum, of a work and one execution."""
        first, *others = self.values
        if len(self.values) > max(FEW, DENSE * (self.worst - first)):
            nothing = int(np.argmax(mass > 0))
            return np.concatenate([np.zeros(nothing + first), np.convolve(mass[nothing:], self.mass[first:])])
        total = np.empty(len(mass) + self.worst)
        total[:first] = total[first + len(mass) :] = 0.0
        np.multiply(self.mass[first], mass, out=total[first : first + len(mass)])
        for value in others:
            total[value : value + len(mass)] += self.mass[value] * mass
        return total

    def and_then(self, other: Law) -> Law:
        return Law(other.added_to(self.mass))

    def times(self, count: int) -> Law:
        """So many executions."""
        if count not in self._powers:
            self._powers[count] = self.times(count - 1).and_then(self) if count else Law(np.ones(1))
        return self._powers[count]


def sum_of(*masses: Floats) -> Floats:
    """Of laws that exclude one another."""
    longest, *others = sorted(masses, key=len, reverse=True)
    total = longest.copy()
    for mass in others:
        total[: len(mass)] += mass
    return total


def add(parts: dict[Key, Floats], more: Iterable[tuple[Key, Floats]]) -> None:
    """To laws that exclude one another, by what is known of each."""
    for key, mass in more:
        parts[key] = sum_of(parts[key], mass) if key in parts else mass


def served(mass: Floats, ticks: int) -> Floats:
    """What is left of a work after so many ticks."""
    left = mass[ticks:].copy()
    if not len(left):
        return np.array([mass.sum()])
    left[0] = mass[: ticks + 1].sum()
    return left


def later_of(one: Floats, other: Floats) -> Floats:
    """The law of the later of two independent instants."""
    length = max(len(one), len(other))
    one, other = (np.pad(mass, (0, length - len(mass))) for mass in (one, other))
    earlier = np.concatenate([[0.0], np.cumsum(one)[:-1]])
    both: Floats = one * np.cumsum(other) + other * earlier
    return both


def cut(mass: Floats, most: int) -> tuple[Floats, float]:
    """Without what is more than so many ticks or not worth following, and the mass of that."""
    length = min(len(mass), most + 1)
    if mass[length - 1] <= NOTHING:
        worth = np.flatnonzero(mass[:length] > NOTHING)
        length = int(worth[-1]) + 1 if len(worth) else 1
    return mass[:length], float(mass[length:].sum())


def exceedance(mass: Floats) -> Floats:
    """P(more than i), summed from the smallest."""
    above = np.cumsum(mass[::-1])[::-1]
    return np.append(above[1:], 0.0)
