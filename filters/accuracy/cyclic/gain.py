"""The gain that a filter settles to, by one cycle after the other: slow and plain."""

from __future__ import annotations

import numpy as np

from filters.accuracy.model import LinearModel
from filters.arrays import FloatArray

MOST_CYCLES = 200_000


def over_cycle(model: LinearModel, N: int) -> tuple[FloatArray, FloatArray]:
    """Phi (n, n) and Q (n, n) over N steps."""
    Phi, Q = np.eye(model.states), np.zeros((model.states, model.states))
    for _ in range(N):
        Phi, Q = model.Phi @ Phi, model.Phi @ Q @ model.Phi.T + model.Q
    return Phi, Q


def settled_gain(
    model: LinearModel, N: int, cycle_noise: FloatArray | None = None, R: FloatArray | None = None
) -> FloatArray:
    """K (n, p) of the filter that takes cycle_noise (n, n) for the noise of N steps and R (p, p) for that of a
    measurement, the model's own if not given.

    Raises ValueError where it does not settle in MOST_CYCLES cycles.
    """
    Phi, Q = over_cycle(model, N)
    Q = Q if cycle_noise is None else cycle_noise
    R = model.R if R is None else R
    H, identity, P = model.H, np.eye(model.states), Q + np.diag(np.diag(Q))
    smallest = np.inf
    for _ in range(MOST_CYCLES):
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        A = identity - K @ H
        before, P = P, Phi @ (A @ P @ A.T + K @ R @ K.T) @ Phi.T + Q
        P = 0.5 * (P + P.T)
        scale = np.sqrt(np.outer(np.diag(P), np.diag(P)))
        change = float((np.abs(P - before) / np.where(scale > 0.0, scale, 1.0)).max())
        if change <= 1e-15 or (change < 1e-13 and change >= smallest):  # or as near as rounding lets it come
            return np.asarray(np.linalg.solve(H @ P @ H.T + R, H @ P).T)
        smallest = change
    raise ValueError(f"the gain does not settle in {MOST_CYCLES} cycles with a measurement every N={N} steps")
