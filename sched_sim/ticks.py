"""Exact time: costs and speeds are fractions, the schedule runs on whole ticks.

One tick of work takes one tick of time, so a faster processor is a longer high-rate period in ticks.
"""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from math import lcm

from sched_sim.errors import InputError

LARGEST_EXPONENT = 18
"""Costs and speeds of any unit lie well within; what does not is a slip of the keyboard."""


def exact(value: int | str | float | Decimal | Fraction, what: str) -> Fraction:
    """The exact fraction that `value` writes: "0.78" is 78/100, "77/100" too; a float stands for its
    shortest decimal.

    Raises InputError, naming `what`, for text that is no number, for NaN and for infinities.
    """
    if isinstance(value, Fraction | int):
        return Fraction(value)
    text = str(value).strip()
    try:
        number = Decimal(1) if "/" in text else Decimal(text)
        if number and not -LARGEST_EXPONENT <= number.adjusted() <= LARGEST_EXPONENT:
            raise InputError(f"{what} is {text}: give a number between 1e-{LARGEST_EXPONENT} and 1e{LARGEST_EXPONENT}")
        return Fraction(text) if "/" in text else Fraction(number)
    except InputError:
        raise
    except (InvalidOperation, ValueError, OverflowError, ZeroDivisionError):
        raise InputError(f"{what} is {text!r}: give a finite number such as 0.78 or 77/100") from None


def positive(value: int | str | float | Decimal | Fraction, what: str) -> Fraction:
    """`exact`, and greater than zero."""
    number = exact(value, what)
    if number <= 0:
        raise InputError(f"{what} is {value}: it must be greater than 0")
    return number


def ticks_per_unit(values: Iterable[Fraction]) -> int:
    """The fewest ticks per unit in which each of `values` is a whole number of ticks."""
    return lcm(*(value.denominator for value in values))


def to_ticks(value: Fraction, resolution: int) -> int:
    """`value` units in ticks; it must come out whole (see `ticks_per_unit`)."""
    ticks = value * resolution
    if ticks.denominator != 1:
        raise ValueError(f"{value} is no whole number of ticks at {resolution} ticks per unit")
    return ticks.numerator
