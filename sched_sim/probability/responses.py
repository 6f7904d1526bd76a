"""Response times by the probability with which they are exceeded."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from sched_sim.probability.outcome import Tail

LEVELS = (1e-3, 1e-6, 1e-9, 1e-12)


FAST_HZ = 10_000
"""From this rate on an HR period is read in microseconds."""


def period_in(rate: Fraction | None) -> tuple[float, str]:
    """An HR period in the unit in which people read times, and that unit. rate: of the HR loop, in Hz."""
    if rate is None:
        return 1.0, "HR periods"
    return (float(10**6 / rate), "us") if rate >= FAST_HZ else (float(1000 / rate), "ms")


def exceeded_at_most(tail: Tail, level: float, ticks: int) -> Fraction | None:
    """The least response time, in HR periods of so many ticks, that is exceeded with a probability of at most `level`
    by the upper bound; None where all that is known are exceeded more often."""
    enough = np.flatnonzero(tail.upper <= level)
    return Fraction(int(enough[0]), ticks) if len(enough) else None
