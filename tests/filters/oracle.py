"""The Kalman filter of the textbooks, in one line of NumPy per equation; not the error-state form."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from tests.strategies import Problem


def textbook_kalman_filter(data: Problem, present: NDArray[np.bool_] | None = None) -> tuple[FloatArray, FloatArray]:
    """x after every step and P before every update.

    present (cycles, p): which numbers of each measurement came, and with them which rows of H and R; all if not given.
    """
    system, N, _, _, x, P, inputs, measurements = data
    matrices = system.parameters
    came = np.ones(measurements.shape, dtype=np.bool_) if present is None else present
    states, references = [], []
    for j in range(len(inputs) + 1):
        if j > 0:
            Phi, B, Q = (matrix[(j - 1) % len(matrix)] for matrix in (matrices.Phi, matrices.B, matrices.Q))
            x, P = Phi @ x + B @ inputs[j - 1], Phi @ P @ Phi.T + Q
        if j % N == 0:
            references.append(P)
            rows = came[j // N]
            H, R = matrices.H[j % len(matrices.H)][rows], matrices.R[j % len(matrices.R)][np.ix_(rows, rows)]
            K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
            x, P = x + K @ (measurements[j // N][rows] - H @ x), P - K @ H @ P
        states.append(x)
    return np.array(states), np.array(references)
