"""Root mean squares over independent runs, and how far the runs let them be trusted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray


class Rms(NamedTuple):
    """Root mean squares over all runs, and their standard errors, from the differences between the runs."""

    rms: FloatArray
    standard_error: FloatArray


def rms(by_run: Sequence[Sequence[FloatArray]]) -> Rms:
    """For each quantity, of values of runs, each as many as it has. A ratio of sums, so that runs may have none.

    Its standard error is that of the mean square, by the runs' deviations from it, over twice the root;
    nan of one run.
    """
    squares = np.array([[np.sum(run**2) for run in quantity] for quantity in by_run])
    counts = np.array([[len(run) for run in quantity] for quantity in by_run])
    runs, total = counts.shape[1], counts.sum(axis=1)
    mean_square = squares.sum(axis=1) / total
    spread = np.sum((squares - mean_square[:, np.newaxis] * counts) ** 2, axis=1)
    deviation = np.sqrt(spread * runs / (runs - 1)) / total if runs > 1 else np.full(len(total), np.nan)
    root = np.sqrt(mean_square)
    return Rms(root, deviation / (2 * root))
