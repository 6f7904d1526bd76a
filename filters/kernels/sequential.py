"""Take a vector of measurements one by one, and still know the gain for all of them at once.

With R = L D L^T the measurements L^-1 y = L^-1 H x + noise have uncorrelated noise of variances D. Their scalar gains
make up the gain G of the decorrelated vector, and K = G L^-1.
"""

from __future__ import annotations

from filters.arrays import FloatArray


def unit_lower_factors(R: FloatArray, L: FloatArray, variances: FloatArray) -> None:
    """L and D of R = L D L^T, for R (p, p) symmetric positive definite, whose lower triangle is read.

    L (p, p): unit lower triangular; its diagonal and what is above are left as they were. variances (p,): D.
    """
    for i in range(R.shape[0]):
        for j in range(i):
            total = R[i, j]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            L[i, j] = total  # L D so far
        pivot = R[i, i]
        for j in range(i):
            scaled = L[i, j] / variances[j]
            pivot -= scaled * L[i, j]
            L[i, j] = scaled
        variances[i] = pivot


def solve_unit_lower(L: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = L^-1 B, for L (p, p) unit lower triangular, B (p, n), out (p, n); out may be B."""
    p, n = B.shape
    for i in range(p):
        for j in range(n):
            out[i, j] = B[i, j]
        for k in range(i):
            factor = L[i, k]
            for j in range(n):
                out[i, j] -= factor * out[k, j]


def solve_unit_lower_vector(L: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """out = L^-1 b, for L (p, p) unit lower triangular, b (p,), out (p,); out may be b."""
    for i in range(b.shape[0]):
        total = b[i]
        for k in range(i):
            total -= L[i, k] * out[k]
        out[i] = total


def solve_unit_lower_transposed(L: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = L^-T B, for L (p, p) unit lower triangular, B (p, n), out (p, n); out may be B."""
    p, n = B.shape
    for i in range(p - 1, -1, -1):
        for j in range(n):
            out[i, j] = B[i, j]
        for k in range(i + 1, p):
            factor = L[k, i]
            for j in range(n):
                out[i, j] -= factor * out[k, j]


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
