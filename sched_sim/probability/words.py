"""Probabilities as people read them, so that nobody is misled: never a bare 0, never more than is known."""

from __future__ import annotations

from decimal import ROUND_CEILING, ROUND_FLOOR, ROUND_HALF_EVEN, Decimal

from sched_sim.costs.autocorrelation import DOUBTFUL, by_chance, doubtful
from sched_sim.probability.outcome import Bounds

DIGITS, FEWER = 3, 2
"""Of what is left to 0 or 1, whichever is nearer; of bounds that differ, rounded outwards, fewer."""
NOISE = Decimal("1e-14")
"""So near to 1 is 1: what sums of floating-point numbers tell."""
LEAST = 1e-30
"""What is less is not told apart: masses below 1e-32 are not followed."""
NOT_RESOLVED, IMPOSSIBLE, VANISHES = "not resolved", "impossible", "vanishes"
FEWEST = 4
"""Of fewer executions chance makes any correlation."""
PLAIN = Decimal("0.001")
"""What is less has an exponent."""


def chance(bounds: Bounds, floor: float = 0.0) -> str:
    """floor: below it nothing is known (`studies.probability.unseen.Resolution`)."""
    lower, upper = bounds
    if upper < floor:
        return f"{NOT_RESOLVED} below {at_most(floor)}"
    if not upper:
        return IMPOSSIBLE
    if upper < LEAST:
        return f"at most {at_most(upper)}"
    if floor and lower > 1 - floor:
        if lower <= floor:
            return f"{NOT_RESOLVED} below {at_most(floor)}"
        return f"at least {_text(_rounded(max(lower - floor, 0.0), FEWER, ROUND_FLOOR))}"
    if _rounded(lower, DIGITS, ROUND_HALF_EVEN) == _rounded(upper, DIGITS, ROUND_HALF_EVEN):
        return _text(_rounded(upper, DIGITS, ROUND_HALF_EVEN))
    if lower <= floor:
        return f"at most {at_most(min(upper + floor, 1.0))}"
    return f"{_text(_rounded(lower, FEWER, ROUND_FLOOR))} to {at_most(upper)}"


def at_most(share: float) -> str:
    """Rounded up."""
    if not share:
        return IMPOSSIBLE
    return _text(_rounded(max(share, LEAST), FEWER, ROUND_CEILING))


def clause_of(said: str) -> str:
    """What a table says of a probability, within a sentence."""
    if said == VANISHES:
        return said
    return f"is {said}" if said.startswith((IMPOSSIBLE, NOT_RESOLVED)) else f"with {said}"


def dependence(kind: str, correlation: float, n: int) -> str:
    """What the rank autocorrelation of a sample of n says of the independence of its executions."""
    if n < FEWEST:
        return f"Rank autocorrelation of {kind}: not known, n = {n}"
    said = f"Rank autocorrelation {correlation:.2f} ({kind}, n = {n:,})"
    if doubtful(correlation):
        also = f"; chance alone makes up to {by_chance(n):.2f}" if abs(correlation) <= by_chance(n) else ""
        return f"{said}: independence doubtful{also}"
    if by_chance(n) > DOUBTFUL:
        return f"{said}: too few to tell, chance alone makes up to {by_chance(n):.2f}"
    return f"{said}: nothing against independence from one execution to the next"


def _rounded(share: float, digits: int, rounding: str) -> Decimal:
    value = Decimal(repr(share))
    left = min(value, 1 - value)
    if left < NOISE and value > left:
        return Decimal(1)
    return value.quantize(Decimal(1).scaleb(left.adjusted() - digits + 1), rounding) if left else value


def _text(value: Decimal) -> str:
    value = value.normalize()
    if not value or value >= PLAIN:
        return f"{value:f}"
    digits = "".join(map(str, value.as_tuple().digits))
    return f"{digits[0]}{'.' if digits[1:] else ''}{digits[1:]}e{value.adjusted()}"
