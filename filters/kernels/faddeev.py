"""Faddeev's algorithm: D + C A^-1 b by elimination alone, without an inverse and without back-substitution."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.kernels.elimination import pivot_row, subtract_nonzero, swap_rows


def faddeev(T: FloatArray, C: FloatArray, D: FloatArray) -> None:
    """D (n, r) becomes D + C A^-1 b, for T = [A b] (N, N + r); C has N columns, and its first n rows are used.

    The rows of [A b] and below them those of [-C D] are eliminated together; when -C has vanished, the result stands
    in D's place. Pivots are the largest of A's rows. T and C are destroyed; what of them is zero costs nothing.
    """
    N = len(T)
    for k in range(N):
        swap_rows(T, pivot_row(T, k), k)
        for i in range(k + 1, N):
            subtract_nonzero(T, k, i)
        for i in range(len(D)):
            if C[i, k] != 0.0:
                factor = C[i, k] / T[k, k]
                for j in range(k + 1, N):
                    if T[k, j] != 0.0:
                        C[i, j] -= factor * T[k, j]
                for j in range(D.shape[1]):
                    if T[k, N + j] != 0.0:
                        D[i, j] += factor * T[k, N + j]
