"""What the covariance of a periodic filter settles to, by doubling: 2^i cycles in i iterations, for many N at once."""

from __future__ import annotations

import numpy as np

from filters.arrays import Flags, FloatArray

MOST_DOUBLINGS = 64
SETTLED = 1e-13
"""So little, of itself, a variance changes by in as many cycles as went before."""
LOST = 1e-6
"""By more, of itself, a cycle changes a settled variance only where the digits of numbers do not suffice."""


def steady_prior(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    """P^- (..., n, n) just before a measurement, once it no longer changes: the filter's own, with the best gain.

    Phi, Q (..., n, n): over a cycle; H (p, n), R (p, p): of the measurement that ends it. nan where it
    does not settle, or is lost in rounding.

    The structure-preserving doubling algorithm of E. K.-W. Chu, H.-Y. Fan, W.-W. Lin and C.-S. Wang,
    Structure-preserving algorithms for periodic discrete-time algebraic Riccati equations, International Journal of
    Control 77, 2004.
    States are scaled by their noise, for units may span twenty decades.
    """
    try:
        return _doubled(Phi, Q, H, R)
    except np.linalg.LinAlgError:  # of one of them, lost in rounding
        if Q.ndim == 2:
            return np.full_like(Q, np.nan)
        return np.array([steady_prior(transition, noise, H, R) for transition, noise in zip(Phi, Q, strict=True)])


def _doubled(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    n = Phi.shape[-1]
    scale = noise_scale(Q)
    A = np.swapaxes(Phi * scale / scale[:, None], -1, -2)
    P = Q / np.outer(scale, scale)
    Hs = H * scale
    G = np.broadcast_to(Hs.T @ np.linalg.solve(R, Hs), P.shape)
    identity = np.eye(n)
    settled: Flags = np.zeros(P.shape[:-2], dtype=bool)
    with np.errstate(all="ignore"):
        for _ in range(MOST_DOUBLINGS):
            inverse = np.linalg.inv(identity + G @ P)
            left = A @ inverse
            At = np.swapaxes(A, -1, -2)
            step = At @ P @ inverse @ A
            G = _symmetric(G + left @ G @ At)
            A = left @ A
            P = _symmetric(P + step)
            variances, change = _diagonal(P), _diagonal(step)
            settled = np.asarray((np.abs(change) <= SETTLED * np.abs(variances)).all(axis=-1))
            if (settled | ~np.isfinite(variances).all(axis=-1)).all():
                break
        F, noise = Phi * scale / scale[:, None], Q / np.outer(scale, scale)
        P = _refined(P, F, noise, Hs, R)
        settled = np.asarray(settled & holds(P, P, F, noise, Hs, R) & _calms(P, F, Hs, R))
    P = np.where(settled[..., None, None], P, np.nan)
    return np.asarray(P * np.outer(scale, scale))


def holds(P: FloatArray, then: FloatArray, Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> Flags:
    """Whether a cycle (...,) leads from P (..., n, n) to `then`, but for rounding."""
    made = Phi @ posterior(P, H, R)[1] @ np.swapaxes(Phi, -1, -2) + Q
    return np.asarray((np.abs(_diagonal(made - then)) <= LOST * np.abs(_diagonal(then))).all(axis=-1))


def _calms(P: FloatArray, Phi: FloatArray, H: FloatArray, R: FloatArray) -> Flags:
    """Whether no error grows that the measurements correct: it does with no noise in a mode that grows, of which P = 0
    is no more than a balance."""
    error = Phi - Phi @ gain(P, H, R) @ H
    finite = np.asarray(np.isfinite(error).all(axis=(-2, -1)))
    radius = np.abs(np.linalg.eigvals(np.where(finite[..., None, None], error, 0.0))).max(axis=-1, initial=0.0)
    return np.asarray(finite & (radius <= 1.0 + LOST))


def _refined(P: FloatArray, Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    """One step of Newton's method (G. Hewer, 1971): what doubling has lost in rounding, near rho = 1, comes back."""
    K = gain(P, H, R)
    A, driven = Phi - Phi @ K @ H, Phi @ K
    return _summed(A, driven @ R @ np.swapaxes(driven, -1, -2) + Q)


def posterior(P: FloatArray, H: FloatArray, R: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The best gain (..., n, p) and P^+ (..., n, n) after a measurement, Eq. (9) and Joseph's form of Eq. (11)."""
    K = gain(P, H, R)
    return K, updated(P, K, H, R)


def gain(P: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    """Eq. (9)."""
    PHt = P @ H.T
    return np.swapaxes(np.linalg.solve(H @ PHt + R, np.swapaxes(PHt, -1, -2)), -1, -2)


def updated(P: FloatArray, K: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    """What any gain makes of P: (I - K H) P (I - K H)^T + K R K^T."""
    A = np.eye(P.shape[-1]) - K @ H
    return _symmetric(A @ P @ np.swapaxes(A, -1, -2) + K @ R @ np.swapaxes(K, -1, -2))


def below_one(radius: float) -> bool:
    """Whether a spectral radius is, beyond rounding, so that something settles."""
    return radius < 1.0 - 1e-9


def steady_state(A: FloatArray, W: FloatArray) -> FloatArray:
    """X (n, n) of X = A X A^T + W, by doubling. nan where rho(A) is not `below_one`."""
    if not below_one(float(np.abs(np.linalg.eigvals(A)).max(initial=0.0))):
        return np.full_like(W, np.nan)
    return _summed(A, W)


def _summed(A: FloatArray, W: FloatArray) -> FloatArray:
    """The sum of A^i W (A^i)^T over all i (..., n, n)."""
    X = W
    for _ in range(MOST_DOUBLINGS):
        step = A @ X @ np.swapaxes(A, -1, -2)
        X = _symmetric(X + step)
        A = A @ A
        if not (np.abs(_diagonal(step)) > 1e-17 * np.abs(_diagonal(X))).any():  # nor where it is nan
            break
    return X


def noise_scale(Q: FloatArray) -> FloatArray:
    """One of each state (n,): the largest deviation that noise gives it in a cycle, 1 where there is none."""
    variances = _diagonal(Q).reshape(-1, Q.shape[-1]).max(axis=0)
    return np.asarray(np.where(variances > 0.0, np.sqrt(variances), 1.0))


def _diagonal(matrices: FloatArray) -> FloatArray:
    return np.diagonal(matrices, axis1=-2, axis2=-1)


def _symmetric(matrices: FloatArray) -> FloatArray:
    return np.asarray(0.5 * (matrices + np.swapaxes(matrices, -1, -2)))
