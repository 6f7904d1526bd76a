"""Probabilities and shares as text: 0 only for never, 1 only for always, and an interval that holds all it held."""

from __future__ import annotations

from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Decimal

PROBABILITY_DIGITS, INTERVAL_DIGITS = 3, 2
"""Digits of what is left to 0 or 1, whichever is nearer. An interval has fewer: it holds its rounded estimate."""


def probability(value: float) -> str:
    return _text(_rounded(value, PROBABILITY_DIGITS, ROUND_HALF_EVEN))


def interval(least: float, most: float) -> str:
    """Rounded outwards."""
    low, high = _rounded(least, INTERVAL_DIGITS, ROUND_FLOOR), _rounded(most, INTERVAL_DIGITS, ROUND_CEILING)
    return f"{_text(low)} to {_text(high)}"


def at_most(value: float) -> str:
    """Rounded up."""
    return _text(_rounded(value, INTERVAL_DIGITS, ROUND_CEILING))


def percent(share: float) -> str:
    """One decimal; more where that would be 0.0% or 100.0% and the share is neither."""
    value = Decimal(repr(share))
    left = min(value, 1 - value)
    decimals = max(1, -left.adjusted() - 2) if left else 1
    return f"{100 * value:.{decimals}f}%"


def _rounded(share: float, digits: int, rounding: str) -> Decimal:
    value = Decimal(repr(share))
    left = min(value, 1 - value)
    return value.quantize(Decimal(1).scaleb(left.adjusted() - digits + 1), rounding) if left else value


def _text(value: Decimal) -> str:
    return f"{float(value):.15g}"
