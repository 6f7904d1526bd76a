"""Measured against predicted, in a word."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import exp, lgamma, log, log1p
from typing import Literal, NamedTuple

Word = Literal["agrees", "disagrees", "inconclusive"]

ENOUGH = Fraction(80, 100)
"""Share of the cycles that must be undisturbed for a word about them."""
ALIKE = Fraction(99, 100)
"""Share of the undisturbed cycles that must land as predicted."""
CONFIDENCE = Fraction(95, 100)
"""With which either is said of all such cycles, of those that were run."""


class Agreement(NamedTuple):
    """How many of how many cycles landed where it was predicted."""

    cycles: int
    agreeing: int
    undisturbed: int
    agreeing_undisturbed: int

    @property
    def share(self) -> Fraction:
        """Of all cycles."""
        return Fraction(self.agreeing, self.cycles)

    @property
    def share_undisturbed(self) -> Fraction | None:
        """Of the undisturbed cycles; None if there are none."""
        return Fraction(self.agreeing_undisturbed, self.undisturbed) if self.undisturbed else None

    @property
    def elsewhere(self) -> int:
        """Undisturbed cycles that did not land as predicted."""
        return self.undisturbed - self.agreeing_undisturbed

    @property
    def too_disturbed(self) -> bool:
        """Whether so much was taken that nothing is said, however many cycles there are."""
        return self.undisturbed == 0 or self.undisturbed < ENOUGH * self.cycles

    @property
    def word(self) -> Word:
        """ "agrees" where the undisturbed cycles are so many that at least `ALIKE` of all such land as predicted, with
        `CONFIDENCE`; "disagrees" where fewer do, with the same."""
        if self.too_disturbed:
            return "inconclusive"
        error = 1 - CONFIDENCE
        if _at_most(self.elsewhere, self.undisturbed) <= error:
            return "agrees"
        at_least = 1 - _at_most(self.elsewhere - 1, self.undisturbed)
        return "disagrees" if at_least <= error else "inconclusive"


def would_do(elsewhere: int) -> int:
    """The fewest undisturbed cycles that agree though so many of them landed elsewhere: 299 where none did."""
    numbers = range(elsewhere + 1, 400 * (elsewhere + 1))
    return numbers[bisect_left(numbers, True, key=lambda number: _at_most(elsewhere, number) <= 1 - CONFIDENCE)]


def together(agreements: Iterable[Agreement]) -> Agreement:
    """Of all cycles of several runs; at least one."""
    return Agreement(*map(sum, zip(*agreements, strict=True)))


def agreement(predicted: int, achieved: Sequence[int | None], disturbed: Sequence[bool]) -> Agreement:
    """By cycle; at least one."""
    alike = [l == predicted for l in achieved]
    calm = [not spoilt for spoilt in disturbed]
    both = sum(one and other for one, other in zip(alike, calm, strict=True))
    return Agreement(len(alike), sum(alike), sum(calm), both)


def _at_most(elsewhere: int, number: int) -> float:
    """The probability that of a number of cycles so many at the most land elsewhere, if each does with 1 - `ALIKE`: by
    the binomial distribution (Clopper and Pearson 1934)."""
    wrong = float(1 - ALIKE)
    logs = (
        lgamma(number + 1) - lgamma(i + 1) - lgamma(number - i + 1) + i * log(wrong) + (number - i) * log1p(-wrong)
        for i in range(elsewhere + 1)
    )
    return sum(map(exp, logs))
