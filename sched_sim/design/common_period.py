"""After how many HR steps all whose phase is known is released as it was."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm


def common_period(N: int, periods: Sequence[Fraction]) -> int:
    """HR steps after which measurements and tasks of these periods are released together again as they were."""
    common = Fraction(N)
    for period in periods:
        common = Fraction(lcm(common.numerator, period.numerator), gcd(common.denominator, period.denominator))
    return common.numerator
