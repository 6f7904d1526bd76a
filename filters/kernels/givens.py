"""Triangularisation by Givens rotations, without touching what is zero."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray


def rotation(a: float, b: float) -> tuple[float, float, float]:
    """c, s and r with c a + s b = r and c b - s a = 0, for b that is not zero; nothing overflows on the way."""
    if abs(b) > abs(a):
        tau = a / b
        s = 1.0 / np.sqrt(1.0 + tau * tau)
        return s * tau, s, b / s
    tau = b / a
    c = 1.0 / np.sqrt(1.0 + tau * tau)
    return c, c * tau, a / c


def triangularise(T: FloatArray) -> None:
    """The first N columns of T (N, N + r) become upper triangular by rotations of two rows; T = [A b] gives Q^T [A b].

    Column by column, each row with an entry to annihilate is rotated with the diagonal one. Rotations of what is zero
    already are left out, and so are columns in which both rows are zero.
    """
    N, width = T.shape
    for j in range(N - 1):
        for i in range(j + 1, N):
            if T[i, j] != 0.0:
                c, s, r = rotation(T[j, j], T[i, j])
                T[j, j] = r
                T[i, j] = 0.0
                for k in range(j + 1, width):
                    a = T[j, k]
                    b = T[i, k]
                    if a != 0.0 or b != 0.0:
                        T[j, k] = c * a + s * b
                        T[i, k] = c * b - s * a
