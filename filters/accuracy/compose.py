"""Covariances over many cycles without a periodic regime: cycles compose, and composition is associative.

A cycle takes P^- before its measurement to that before the next one, P -> Phi (P^-1 + G)^-1 Phi^T + Q with G = H^T R^-1
H; so does any number of them. A measurement that is missing has G = 0. Where variances grow without bound, this says
what they are at a stated time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from filters.accuracy.model import LinearModel
from filters.accuracy.prefix import prefix
from filters.arrays import FloatArray


class Cycles(NamedTuple):
    """F, G, Q (..., n, n): P becomes F P (I + G P)^-1 F^T + Q."""

    F: FloatArray
    G: FloatArray
    Q: FloatArray


def one_cycle(model: LinearModel, N: int, *, measured: bool = True) -> Cycles:
    """A measurement, if it is not missing, then N steps."""
    over = prefix(model, N)
    information = model.H.T @ np.linalg.solve(model.R, model.H)
    return Cycles(over.Phi[N], information if measured else np.zeros_like(information), over.Q[N])


def composed(first: Cycles, then: Cycles) -> Cycles:
    """Both, in this order."""
    identity = np.eye(first.F.shape[-1])
    # F_2 (I + Q_1 G_2)^-1 and (I + G_2 Q_1)^-1 G_2
    by_noise = _transposed(np.linalg.solve(_transposed(identity + first.Q @ then.G), _transposed(then.F)))
    seen = np.linalg.solve(identity + then.G @ first.Q, then.G)
    return Cycles(
        by_noise @ first.F,
        _symmetric(first.G + _transposed(first.F) @ seen @ first.F),
        _symmetric(then.Q + by_noise @ first.Q @ _transposed(then.F)),
    )


def repeated(cycles: Cycles, times: int) -> Cycles:
    """So many of them, 0, 1, ..., in as many compositions as the number has binary digits, or twice that."""
    if isinstance(times, bool) or not isinstance(times, int | np.integer) or times < 0:
        raise ValueError(f"times={times!r} must be a whole number, at least 0")
    n = len(cycles.F)
    result, power = Cycles(np.eye(n), np.zeros((n, n)), np.zeros((n, n))), cycles
    while times:
        if times % 2:
            result = composed(result, power)
        times //= 2
        if times:
            power = composed(power, power)
    return result


def applied(cycles: Cycles, P: FloatArray) -> FloatArray:
    """What they make of P^- (n, n), which may be singular."""
    n = len(P)
    return _symmetric(cycles.F @ P @ np.linalg.solve(np.eye(n) + cycles.G @ P, cycles.F.T) + cycles.Q)


def _symmetric(matrix: FloatArray) -> FloatArray:
    return np.asarray(0.5 * (matrix + _transposed(matrix)))


def _transposed(matrix: NDArray[np.floating]) -> FloatArray:
    return np.asarray(np.swapaxes(matrix, -1, -2))
