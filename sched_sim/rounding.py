"""Needs and limits in digits: a need never looks smaller than it is, nor a limit larger."""

from __future__ import annotations

from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import TypeAlias

Figure: TypeAlias = Fraction | float
"""A float stands for the shortest decimal that it is the nearest to."""


def no_less(value: Fraction, digits: int) -> str:
    """Rounded up to so many digits, without zeros behind them; very large and very small numbers with an exponent."""
    return f"{float(up(value, digits)):.{max(digits, 15)}g}"


def percent_up(share: Figure) -> str:
    """A share that is needed, in percent, to three digits: what is more than all never looks like all. Five digits and
    more have commas."""
    number = Decimal(up(100 * written(share), 3))
    return f"{number:{',' if number >= 10_000 else ''}f} %"


def up(value: Figure, digits: int) -> str:
    """To so many digits, whole numbers in full."""
    return _rounded(value, digits, ROUND_CEILING)


def down(value: Figure, digits: int) -> str:
    """To so many digits, whole numbers in full."""
    return _rounded(value, digits, ROUND_FLOOR)


def written(value: Figure) -> Fraction:
    """The number that it stands for."""
    return Fraction(repr(value)) if isinstance(value, float) else value


def _rounded(value: Figure, digits: int, way: str) -> str:
    """Once, of the exact number."""
    exact = written(value)
    most = max(digits, len(str(abs(int(exact)))))
    context = Context(prec=most, rounding=way)
    number = context.divide(Decimal(exact.numerator), Decimal(exact.denominator))
    places = max(digits - 1 - number.adjusted(), 0)
    return f"{number.quantize(Decimal(1).scaleb(-places), context=Context(prec=most + 1)):f}"
