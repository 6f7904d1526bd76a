"""Take a vector of measurements one by one, and still know the gain for all of them at once.

With R = C C^T the measurements C^-1 y = C^-1 H x + noise have uncorrelated noise of variance 1 (whitening). Their
scalar gains make up the gain G of the whitened vector, and K = G C^-1.
"""

from __future__ import annotations

from filters.arrays import FloatArray


def solve_lower(C: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = C^-1 B, for C (p, p) lower triangular, B (p, n), out (p, n); out may be B."""
    p, n = B.shape
    for i in range(p):
        for j in range(n):
            out[i, j] = B[i, j]
        for k in range(i):
            factor = C[i, k]
            for j in range(n):
                out[i, j] -= factor * out[k, j]
        scale = 1.0 / C[i, i]
        for j in range(n):
            out[i, j] *= scale


def solve_lower_transposed(C: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = C^-T B, for C (p, p) lower triangular, B (p, n), out (p, n); out may be B."""
    p, n = B.shape
    for i in range(p - 1, -1, -1):
        for j in range(n):
            out[i, j] = B[i, j]
        for k in range(i + 1, p):
            factor = C[k, i]
            for j in range(n):
                out[i, j] -= factor * out[k, j]
        scale = 1.0 / C[i, i]
        for j in range(n):
            out[i, j] *= scale


def join_gain(H: FloatArray, row: int, gains: FloatArray) -> None:
    """Let the gains of the measurements before this row know of it: G <- G - k (h G).

    H (p, n), gains G^T (p, n): the rows before this one are the joint gain of the measurements before this one, the row
    itself is the scalar gain k of this one, taken after them. The rows up to it are then their joint gain.
    """
    n = H.shape[1]
    for earlier in range(row):
        expected = H[row, 0] * gains[earlier, 0]
        for j in range(1, n):
            expected += H[row, j] * gains[earlier, j]
        for j in range(n):
            gains[earlier, j] -= gains[row, j] * expected
