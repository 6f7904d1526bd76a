"""Exact time: costs and speeds are fractions, the schedule runs on whole ticks.

One tick of work takes one tick of time, so a faster processor is a longer high-rate period in ticks.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from math import lcm
from typing import TypeAlias

from sched_sim.bounds import check_digits, check_size, short
from sched_sim.errors import InputError

Number: TypeAlias = int | float | str | Decimal | Fraction
"""A number as people write it: 0.78 means 78/100, "77/100" itself."""


def exact(value: Number, what: str) -> Fraction:
    """The exact fraction that `value` writes: "0.78" is 78/100, "77/100" too; a float stands for its
    shortest decimal. A Decimal comes from a file, where a quotient has quotes.

    Raises InputError, naming `what`, for text that is no number, for NaN and infinities, and for a number that is out
    of bounds (`sched_sim.bounds`).
    """
    if isinstance(value, Fraction):
        return value
    try:
        number = Fraction(_written(value, what))
    except InputError:
        raise
    except (ArithmeticError, ValueError):
        if isinstance(value, Decimal):
            raise InputError(f'{what} is {value}: give a finite number such as 0.78 or "77/100"') from None
        if hasattr(value, what):
            raise InputError(f"{what} is {short(value)}: give its .{what}") from None
        remedy = _without_unit(str(value), what) or "give a finite number such as 0.78 or 77/100"
        raise InputError(f"{what} is {short(value)!r}: {remedy}") from None
    check_size(number, what, value)
    return number


UNITS = {"hz": "Hz", "ms": "ms", "us": "us", "s": "s", "mhz": "MHz"}
"""By the last word of an argument's name, what it is in."""

_WITH_UNIT = re.compile(r"([+-]?[\d.]+(?:e[+-]?\d+)?)\s*([a-z]+)", re.IGNORECASE)


def _without_unit(text: str, what: str) -> str:
    """What to say of a number with a unit behind it; empty for anything else."""
    found = _WITH_UNIT.fullmatch(text.strip())
    if found is None:
        return ""
    number, unit = found[1], found[2].lower()
    word = re.split(r"[^A-Za-z]", what)[-1]
    if wanted := UNITS.get(word):
        return f"give it in {wanted}, without the unit{f': {number}' if unit == wanted.lower() else ''}"
    if word == "switch":
        return "give it in units of the cost table, which are seconds on a processor, without the unit"
    return ""


def _written(value: int | str | float | Decimal, what: str) -> int | str | Decimal:
    """`value` as `Fraction` reads it exactly; raises InputError where that would take long."""
    if isinstance(value, int):
        check_digits(value, what)
        return value
    text = str(value).strip()
    for part in text.split("/"):
        check_digits(part, what)
    if "/" in text:
        return text
    number = Decimal(text)
    check_size(number, what, value)
    return number


def positive(value: Number, what: str) -> Fraction:
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
    ticks, rest = divmod(value.numerator * resolution, value.denominator)
    if rest:
        raise ValueError(f"{value} is no whole number of ticks at {resolution} ticks per unit")
    return ticks
