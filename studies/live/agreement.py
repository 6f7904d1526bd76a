"""Measured against predicted, in a word."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Literal, NamedTuple

Word = Literal["agrees", "disagrees", "inconclusive"]

ENOUGH = Fraction(80, 100)
"""Share of the cycles that must be undisturbed for a word about them."""
ALIKE = Fraction(99, 100)
"""Share of the undisturbed cycles that must land as predicted."""


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
    def word(self) -> Word:
        """Never "agrees" where too few cycles were undisturbed."""
        share = self.share_undisturbed
        if share is None or self.undisturbed < ENOUGH * self.cycles:
            return "inconclusive"
        return "agrees" if share >= ALIKE else "disagrees"


def agreement(predicted: int, achieved: Sequence[int | None], disturbed: Sequence[bool]) -> Agreement:
    """By cycle; at least one."""
    alike = [l == predicted for l in achieved]
    calm = [not spoilt for spoilt in disturbed]
    both = sum(one and other for one, other in zip(alike, calm, strict=True))
    return Agreement(len(alike), sum(alike), sum(calm), both)
