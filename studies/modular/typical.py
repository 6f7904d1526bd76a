"""What a typical run gives, and an unlucky one: quantiles with the interval that the order of the runs gives them.

A mean of values with a heavy tail is decided by the few largest, and its standard error with it. The interval of a
quantile holds whatever the distribution: of n independent values the number below the quantile is binomial, so that it
lies between two of the ordered ones with at least the confidence asked for. David and Nagaraja, Order statistics, 2003,
section 7.1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray

CONFIDENCE = 0.95
HALF, UNLUCKY = 0.5, 0.95
"""The quantiles of a typical run, and of the best of the worst twentieth."""


class Quantile(NamedTuple):
    """value, and its interval; infinite where there are too few values for a limit."""

    value: float
    low: float
    high: float


def quantile(values: FloatArray, share: float = HALF, confidence: float = CONFIDENCE) -> Quantile:
    """A quantile of independent values (runs,), in any order; those that are nan do not count.

    Raises ValueError if no value is left.
    """
    from scipy.stats import binom  # takes half a second to import, and only this needs it

    ordered = np.sort(values[~np.isnan(values)])
    if not len(ordered):
        raise ValueError("quantile: all values are nan")
    tail = (1 - confidence) / 2
    low, high = (int(binom.ppf(level, len(ordered), share)) for level in (tail, 1 - tail))
    at = np.concatenate([[-np.inf], ordered, [np.inf]])
    return Quantile(float(np.quantile(ordered, share)), float(at[low]), float(at[high + 1]))
