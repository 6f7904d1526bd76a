"""What covariances settle to where the intervals between measurements repeat, for all measurements of a repetition at
once: by doubling, 2^i cycles before each in i iterations.

Everything has one of each for the q cycles of a repetition; cycle i begins with measurement i and ends before the next.
"""

from __future__ import annotations

import numpy as np

from filters.accuracy.compose import Cycles, composed
from filters.accuracy.riccati import LOST, MOST_DOUBLINGS, SETTLED, below_one, gain, holds, noise_scale
from filters.arrays import FloatArray


def repeating_priors(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    """P^- (q, n, n) before each measurement, with the best gain. nan where it does not settle.

    Phi, Q (q, n, n): over each cycle; H (p, n), R (p, p): of the measurement that begins it. The doubling of
    `riccati.steady_prior`, for each measurement over the cycles before it.
    """
    try:
        return _doubled(Phi, Q, H, R)
    except np.linalg.LinAlgError:  # lost in rounding
        return np.full_like(Q, np.nan)


def _doubled(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    scale = noise_scale(Q)
    units = np.outer(scale, scale)
    F, noise, Hs = Phi * scale / scale[:, None], Q / units, H * scale
    so_far = Cycles(F, np.broadcast_to(Hs.T @ np.linalg.solve(R, Hs), F.shape), noise)
    span, settled = 1, False
    with np.errstate(all="ignore"):
        for _ in range(MOST_DOUBLINGS):
            then = Cycles(*(_after(each, span) for each in so_far))
            both = composed(so_far, then)
            variances = np.diagonal(both.Q, axis1=-2, axis2=-1)
            if not np.isfinite(variances).all():
                break
            change = variances - np.diagonal(then.Q, axis1=-2, axis2=-1)
            so_far, span = both, 2 * span
            settled = bool((np.abs(change) <= SETTLED * np.abs(variances)).all())
            if settled:
                break
        if not settled:
            return np.full_like(Q, np.nan)
        before = _after(so_far.Q, -span)
        K = gain(before, Hs, R)
        A, driven = F - F @ K @ Hs, F @ K
        # one step of Newton's method, as in `riccati`
        before = _summed(A, driven @ R @ np.swapaxes(driven, -1, -2) + noise)
        if radius_of_repetition(A) > 1.0 + LOST or not holds(before, _after(before, 1), F, noise, Hs, R).all():
            return np.full_like(Q, np.nan)
    return np.asarray(before * units)


def repeating_covariances(A: FloatArray, W: FloatArray) -> FloatArray:
    """X (q, n, n) before each measurement, of X_{i+1} = A_i X_i A_i^T + W_i. nan where it does not settle."""
    if not below_one(radius_of_repetition(A)):
        return np.full_like(W, np.nan)
    return _summed(A, W)


def _summed(A: FloatArray, W: FloatArray) -> FloatArray:
    over, X, span = A, W, 1
    for _ in range(MOST_DOUBLINGS):
        later = _after(over, span)
        step = later @ X @ np.swapaxes(later, -1, -2)
        X = _after(X, span) + step
        X = 0.5 * (X + np.swapaxes(X, -1, -2))
        over, span = later @ over, 2 * span
        diagonal = np.diagonal(X, axis1=-2, axis2=-1)
        if not (np.abs(np.diagonal(step, axis1=-2, axis2=-1)) > 1e-17 * np.abs(diagonal)).any():
            break
    return _after(X, -span)


def radius_of_repetition(A: FloatArray) -> float:
    """Spectral radius of the product of all q."""
    product = np.eye(A.shape[-1])
    for each in A:
        product = each @ product
    return float(np.abs(np.linalg.eigvals(product)).max(initial=0.0)) if np.isfinite(product).all() else float("inf")


def _after(of_each: FloatArray, cycles: int) -> FloatArray:
    """For each cycle what is of the one so many later."""
    return np.roll(of_each, -cycles % len(of_each), axis=0)
