"""Numbers in the user's TOML files: exact decimals, or quotients in quotes, "77/100"."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Annotated, Any

from pydantic import BeforeValidator

from sched_sim.ticks import exact


def whole(value: Any) -> int:
    """Raises ValueError for what is no whole number in the file, such as `true` or `"5"`."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError("must be a whole number")
    return value


def number(value: Any) -> Fraction:
    """Raises ValueError for what is no number in the file, such as `true` or `"1.5"`, and for one out of bounds."""
    is_quotient = isinstance(value, str) and "/" in value
    if isinstance(value, bool) or not (is_quotient or isinstance(value, int | Decimal)):
        raise ValueError("must be a number")
    return exact(value, "the number")


def above_zero(value: Any) -> Fraction:
    fraction = number(value)
    if fraction <= 0:
        raise ValueError("must be greater than 0")
    return fraction


Whole = Annotated[int, BeforeValidator(whole)]
Number = Annotated[Fraction, BeforeValidator(number)]
Positive = Annotated[Fraction, BeforeValidator(above_zero)]
