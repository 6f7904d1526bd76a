"""Gaussian elimination of T = [A b], for T (N, N + r): with partial pivoting or without, of all entries or the nonzero.

The kernels that leave out what is zero do the same as the others on a matrix without zeros.
"""

from __future__ import annotations

from collections.abc import Callable

from filters.arrays import FloatArray


def back_substitute(T: FloatArray, out: FloatArray) -> None:
    """The last n unknowns of T = [A b] whose A is upper triangular, for out (n, r)."""
    n, N = len(out), len(T)
    first = N - n
    for i in range(n - 1, -1, -1):
        for column in range(out.shape[1]):
            total = T[first + i, N + column]
            for k in range(i + 1, n):
                total -= T[first + i, first + k] * out[k, column]
            out[i, column] = total / T[first + i, first + i]


def pivot_row(T: FloatArray, k: int) -> int:
    """The row, of those from k on, in which column k of T is largest."""
    best = k
    for i in range(k + 1, T.shape[0]):
        if abs(T[i, k]) > abs(T[best, k]):
            best = i
    return best


def diagonal_row(_T: FloatArray, k: int) -> int:
    """Row k itself: no pivoting."""
    return k


def swap_rows(T: FloatArray, i: int, k: int) -> None:
    """Rows i and k of T change places."""
    if i != k:
        for j in range(T.shape[1]):
            kept = T[i, j]
            T[i, j] = T[k, j]
            T[k, j] = kept


def subtract_row(T: FloatArray, k: int, i: int) -> None:
    """A multiple of row k is subtracted from row i so that column k vanishes there."""
    factor = T[i, k] / T[k, k]
    T[i, k] = 0.0
    for j in range(k + 1, T.shape[1]):
        T[i, j] -= factor * T[k, j]


def subtract_nonzero(T: FloatArray, k: int, i: int) -> None:
    """`subtract_row`, but what is zero costs nothing."""
    if T[i, k] != 0.0:
        factor = T[i, k] / T[k, k]
        T[i, k] = 0.0
        for j in range(k + 1, T.shape[1]):
            if T[k, j] != 0.0:
                T[i, j] -= factor * T[k, j]


def elimination(
    pivot: Callable[[FloatArray, int], int], subtract: Callable[[FloatArray, int, int], None]
) -> Callable[[FloatArray], None]:
    """A kernel that makes A of T = [A b] upper triangular; the pivot of column k is in row pivot(T, k)."""

    def eliminate(T: FloatArray) -> None:
        """A of T = [A b] becomes upper triangular. A zero pivot gives inf or nan."""
        for k in range(len(T) - 1):
            swap_rows(T, pivot(T, k), k)
            for i in range(k + 1, len(T)):
                subtract(T, k, i)

    return eliminate


eliminate_dense = elimination(pivot_row, subtract_row)
eliminate_pivoted = elimination(pivot_row, subtract_nonzero)
eliminate_unpivoted = elimination(diagonal_row, subtract_nonzero)
