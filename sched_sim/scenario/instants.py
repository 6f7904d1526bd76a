"""When a sensor measures, and which HR steps that is: exact instants and the one rule of rounding. A measurement is
taken in the first step that starts at its instant or after it, and used in the first at its arrival or after it.

Instants, `every`, `offset` and delays are in HR steps, whole or quotients: "40/3" is a 30 Hz sensor at 400 Hz.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, lcm
from typing import TypeAlias, overload

Steps: TypeAlias = int | Fraction
"""So many HR steps; whole ones are an int."""


def taken(every: Steps, offset: Steps, steps: int) -> Sequence[int]:
    """The steps, of so many, in which measurements are taken: the first at offset + i `every`, or after it."""
    scale = lcm(Fraction(every).denominator, Fraction(offset).denominator)
    instants = range(int(offset * scale), (steps - 1) * scale + 1, int(every * scale))
    return instants if scale == 1 else [-(-instant // scale) for instant in instants]


def lag(instant: Steps, delay: Steps) -> int:
    """From the step in which a measurement of this instant is taken to that in which it arrives."""
    return ceil(instant + delay) - ceil(instant)


def roundings(every: Steps, offset: Steps) -> tuple[Fraction, Fraction]:
    """The least and the longest time from an instant to the step in which its measurement is taken.

    The instants of `every` = p / q are q different parts of a step from a step's start, evenly.
    """
    parts = Fraction(every).denominator
    least = -Fraction(offset) % Fraction(1, parts)
    return least, least + Fraction(parts - 1, parts)


@dataclass(frozen=True, slots=True)
class Spread(Sequence[Fraction]):
    """Delays evenly from the least to the greatest, without a list of them: numerators over one denominator."""

    numerators: range
    denominator: int

    @overload
    def __getitem__(self, index: int) -> Fraction: ...
    @overload
    def __getitem__(self, index: slice) -> Spread: ...
    def __getitem__(self, index: int | slice) -> Fraction | Spread:
        if isinstance(index, slice):
            return Spread(self.numerators[index], self.denominator)
        return Fraction(self.numerators[index], self.denominator)

    def __len__(self) -> int:
        return len(self.numerators)


def spread(least: Fraction, most: Fraction) -> range | Spread:
    """Delays from `least` to `most`, both among them, evenly: whole ones are each step. As many as there are steps in
    which a measurement may arrive that is taken at a step's start, so that each of these is equally likely."""
    gaps = max(ceil(most) - ceil(least), int(least < most))
    apart = (most - least) / max(gaps, 1)
    scale = lcm(least.denominator, most.denominator, apart.denominator)
    numerators = range(int(least * scale), int(most * scale) + 1, max(int(apart * scale), 1))
    return numerators if scale == 1 else Spread(numerators, scale)
