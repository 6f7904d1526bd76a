"""Which of several designs no other one beats, by power and accuracy."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby

ROUNDING = 1e-9
"""Standard deviations that differ by less, of themselves, are one."""


def unbeaten(designs: Sequence[tuple[float | Fraction, float]]) -> list[bool]:
    """Of each (least speed, standard deviation), whether no other design is as accurate with less, or more accurate
    with as much."""
    best, found = float("inf"), [True] * len(designs)
    in_order = sorted(range(len(designs)), key=lambda at: designs[at][0])
    for _, group in groupby(in_order, key=lambda at: designs[at][0]):
        alike = list(group)
        here = min(designs[at][1] for at in alike)
        for at in alike:
            std = designs[at][1]
            found[at] = best > std * (1 + ROUNDING) and here >= std * (1 - ROUNDING)
        best = min(best, here)
    return found
