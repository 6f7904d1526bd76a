"""In which steps measurements are taken whose interval is no whole number of steps: a pattern that repeats.

Measurement i is taken in the first step at i N or after it: with N = p / q, q of them in p steps, some of the intervals
the whole number of steps below N and the others the one above.
"""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from filters.accuracy.outcome import check_steps

Interval: TypeAlias = int | Fraction
"""Steps from one measurement to the next, whole or a quotient."""

MOST_MEASUREMENTS = 4_000
"""Of a repetition that is looked at measurement by measurement: a second."""


def taken(N: Interval) -> NDArray[np.int64]:
    """The steps (q + 1,) of the measurements of one repetition, and of the first of the next."""
    return np.array([ceil(number * N) for number in range(Fraction(N).denominator + 1)], dtype=np.int64)


def repeats_soon(N: Interval) -> bool:
    return Fraction(N).denominator <= MOST_MEASUREMENTS


def check_repeats(N: Interval) -> None:
    """Raises ValueError unless it `repeats_soon`."""
    if not repeats_soon(N):
        raise ValueError(
            f"measurements every {float(N):.9g} steps repeat their pattern after {Fraction(N).denominator:,} of them, "
            f"and a method that is not as good as the age of its measurements is looked at one by one, for at most "
            f"{MOST_MEASUREMENTS:,}; take an interval that repeats sooner"
        )


def check_interval(name: str, N: Interval) -> Interval:
    """A whole one as int. Raises ValueError, naming it, unless it is at least 1 step."""
    if not isinstance(N, Fraction):
        check_steps(name, N, 1)
        return int(N)
    if N < 1:
        raise ValueError(f"{name}={N} must be at least 1 step")
    return int(N) if N.denominator == 1 else N
