"""The accuracy of a constant model's output by the age of what is in it: of many N at once, and of every L.

After a measurement every N steps for a long time, an output whose newest measurement was taken a steps ago has the
covariance V_N(a) = C (Phi_a P^+_N Phi_a^T + Q_a) C^T, whatever lossless method brought it there: a filter's accuracy
depends on N and on the age alone. Corrections that land L steps after their measurement was taken make outputs of the
ages L .. N + L - 1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.model import LinearModel
from filters.accuracy.pattern import Interval
from filters.accuracy.prefix import Prefix, prefix
from filters.accuracy.riccati import posterior, steady_prior
from filters.accuracy.unseen import check_seen
from filters.accuracy.visible import visible
from filters.arrays import FloatArray

MOST_GROWTH = 1e6
"""From one measurement to the next; squares of it beside 1 leave few of a number's sixteen digits."""


class Steady(NamedTuple):
    """A filter in its periodic regime, for each of several N.

    N (designs,); before, after (designs, n, n): P^-_N, P^+_N; variances (designs, ages): tr V_N(a) for a = 0, 1, ...;
    jumps (designs, ages): variance of how far the output moves when a correction of that age lands.
    """

    N: np.ndarray[tuple[int], np.dtype[np.int64]]
    before: FloatArray
    after: FloatArray
    variances: FloatArray
    jumps: FloatArray


def steady(model: LinearModel, outputs: FloatArray, N: ArrayLike, oldest: int) -> Steady:
    """outputs (o, n): C, the rows whose accuracy is asked for; oldest: the greatest age.

    Raises ValueError where the outputs depend on what no measurement ever says (`visible`), or for some N on what none
    in those steps says (`unseen`), and where the covariance is not found.
    """
    several = np.atleast_1d(np.asarray(N, dtype=np.int64))
    whole, (model, C) = model, visible(model, outputs)
    for each in several:
        check_seen(whole, outputs, int(each))
    with np.errstate(over="ignore", invalid="ignore"):
        over = prefix(model, max(int(several.max()), oldest))
        before = steady_prior(over.Phi[several], over.Q[several], model.H, model.R)
        if not np.isfinite(before).all():
            first = several[~np.isfinite(before).all(axis=(1, 2))][0]
            raise ValueError(not_found(int(first), over.Phi[first]))
        _, after = posterior(before, model.H, model.R)
        return Steady(
            several,
            before,
            after,
            or_infinite(by_age(over, C, after, oldest) + noise_by_age(over, C, oldest)),
            or_infinite(by_age(over, C, before - after, oldest)),
        )


def not_found(N: Interval, over: FloatArray) -> str:
    """Why there is no covariance. over (n, n): the transition from a measurement to the next."""
    growth = float(np.abs(np.linalg.eigvals(over)).max()) if np.isfinite(over).all() else np.inf
    if growth < MOST_GROWTH:
        return (
            f"the covariance does not settle with a measurement every N={N} steps: a mode of the model is hardly seen "
            f"at that interval, or no noise stirs it; take another N, or give each mode a noise in Q"
        )
    return (
        f"the covariance with a measurement every N={N} steps is lost in rounding: from one to the next a mode of the "
        f"model grows by a factor of {growth:.2g}, and the others beside it are beyond the digits of a number; take a "
        f"smaller N"
    )


def or_infinite(variances: FloatArray) -> FloatArray:
    """What is too large for a number is infinite, not undefined."""
    return np.where(np.isnan(variances), np.inf, variances)


def by_age(over: Prefix, C: FloatArray, P: FloatArray, oldest: int) -> FloatArray:
    """tr C Phi_a P Phi_a^T C^T (designs, oldest + 1), one product for all: the sum of (Phi_a^T C^T C Phi_a) * P."""
    rows = C @ over.Phi[: oldest + 1]
    weights = np.swapaxes(rows, -1, -2) @ rows
    return np.asarray(P.reshape(len(P), -1) @ weights.reshape(oldest + 1, -1).T)


def noise_by_age(over: Prefix, C: FloatArray, oldest: int) -> FloatArray:
    """tr C Q_a C^T (oldest + 1,)."""
    return np.asarray(np.einsum("oi,aij,oj->a", C, over.Q[: oldest + 1], C))


def worst(variances: FloatArray, N: int, L: ArrayLike) -> FloatArray:
    """The greatest of the ages L .. N + L - 1, for each L; variances (ages,) of one N. They need not grow with age."""
    first = np.asarray(L)
    longest = int(first.max()) + N
    blocks = -(-longest // N)
    padded = np.full(blocks * N, -np.inf)
    padded[:longest] = variances[:longest]
    by_block = padded.reshape(blocks, N)
    so_far = np.maximum.accumulate(by_block, axis=1).ravel()
    to_come = np.maximum.accumulate(by_block[:, ::-1], axis=1)[:, ::-1].ravel()
    return np.asarray(np.maximum(to_come[first], so_far[first + N - 1]))


def mean(variances: FloatArray, N: int, L: ArrayLike) -> FloatArray:
    """The mean over the ages L .. N + L - 1, for each L."""
    first = np.asarray(L)
    sums = np.concatenate([[0.0], np.cumsum(variances)])
    return np.asarray((sums[first + N] - sums[first]) / N)
