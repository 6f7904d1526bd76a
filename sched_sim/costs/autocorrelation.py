"""Whether an execution tells of the next one: the rank autocorrelation of execution times in the order in which they
were measured. Samples that are drawn one by one are independent, and a run of slow executions is not in them."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

DOUBTFUL = 0.05
"""Above this rank autocorrelation, either way, independence is."""


def rank_autocorrelation(times: ArrayLike) -> float:
    """Spearman's rank correlation of each of `times` (n,) with the next one, from -1 to 1; equal ones share the mean of
    their ranks. 0 where all but the first, or all but the last, are equal, or there are fewer than three: then nothing
    tells of the next.

    Ranks, for a single execution that takes a hundred times as long would decide the correlation of the times.
    """
    ordered = np.asarray(times)
    before, after = _ranks(ordered[:-1]), _ranks(ordered[1:])
    scale = np.sqrt(before @ before) * np.sqrt(after @ after)
    return float(before @ after / scale) if scale else 0.0


def doubtful(correlation: float) -> bool:
    """Whether executions with this rank autocorrelation may not be independent."""
    return abs(correlation) > DOUBTFUL


def by_chance(n: int) -> float:
    """What the rank autocorrelation of n independent executions exceeds, either way, once in 20 times."""
    return 1.96 / sqrt(n)


def _ranks(times: NDArray[Any]) -> NDArray[np.float64]:
    """From their mean on."""
    _, places, counts = np.unique(times, return_inverse=True, return_counts=True)
    of_values = np.cumsum(counts) - (counts - 1) / 2
    return np.asarray(of_values[places] - (len(times) + 1) / 2)
