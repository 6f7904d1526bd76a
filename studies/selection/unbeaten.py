"""Which of several designs no other one beats, by power and accuracy."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

ROUNDING = 1e-9
"""Standard deviations that differ by less, of themselves, are one."""


def unbeaten(designs: Sequence[tuple[float | Fraction, float]]) -> list[bool]:
    """Of each (least speed, standard deviation), whether no other design is as accurate with less, or more accurate
    with as much."""
    return [not any(_beats(other, design) for other in designs) for design in designs]


def _beats(other: tuple[float | Fraction, float], design: tuple[float | Fraction, float]) -> bool:
    (others_speed, others_std), (speed, std) = other, design
    as_good = others_speed <= speed and others_std <= std * (1 + ROUNDING)
    return as_good and (others_speed < speed or others_std < std * (1 - ROUNDING))
