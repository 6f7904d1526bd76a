"""The accuracy of very many designs (N, L) at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.periodic import Steady, mean, steady, worst
from filters.arrays import FloatArray


class Deviations(NamedTuple):
    """worst, rms: as in `Accuracy`, an array of each."""

    worst: FloatArray
    rms: FloatArray


def lossless_designs(model: LinearModel, outputs: ArrayLike, N: ArrayLike, L: ArrayLike) -> Deviations:
    """`lossless` of arrays of N and L, of one shape or broadcast to it: a million of them in a second.

    Other arguments and errors as there.
    """
    periods, landings = np.broadcast_arrays(_steps("N", N, 1), _steps("L", L, 0))
    if not periods.size:
        return Deviations(np.empty(periods.shape), np.empty(periods.shape))
    most = int(landings.max())
    different, of = np.unique(periods, return_inverse=True)
    regimes = steady(model, output_rows(outputs, model.states), different, int(different.max()) + most)
    by_N = _by_landing(regimes, most)
    chosen = of.reshape(periods.shape), landings
    return Deviations(by_N.worst[chosen], by_N.rms[chosen])


def _by_landing(regimes: Steady, most: int) -> Deviations:
    """(designs, most + 1): for each N, of each L."""
    landings = np.arange(most + 1)
    table = Deviations(np.empty((len(regimes.N), most + 1)), np.empty((len(regimes.N), most + 1)))
    for row, N in enumerate(regimes.N):
        table.worst[row] = np.sqrt(worst(regimes.variances[row], int(N), landings))
        table.rms[row] = np.sqrt(mean(regimes.variances[row], int(N), landings))
    return table


def _steps(name: str, value: ArrayLike, least: int) -> NDArray[np.int64]:
    array = np.asarray(value)
    if array.size and (array.dtype.kind not in "iu" or array.min() < least):
        raise ValueError(f"{name} must be whole numbers of steps, at least {least}; it holds others")
    return array.astype(np.int64)
