"""The inverse of a general square matrix."""

from __future__ import annotations

from collections.abc import Callable

from filters.arrays import FloatArray
from filters.kernels.elimination import back_substitute, eliminate_dense, pivot_row, swap_rows
from filters.kernels.place import IntArray


def sweep_row(A: FloatArray, k: int, i: int) -> None:
    """Row i of A less A_ik times row k; what was in column k makes room for the inverse."""
    factor = A[i, k]
    A[i, k] = 0.0
    for j in range(A.shape[1]):
        A[i, j] -= factor * A[k, j]


def sweep_nonzero(A: FloatArray, k: int, i: int) -> None:
    """`sweep_row`, but what is zero costs nothing."""
    factor = A[i, k]
    if factor != 0.0:
        A[i, k] = 0.0
        for j in range(A.shape[1]):
            if A[k, j] != 0.0:
                A[i, j] -= factor * A[k, j]


def scale_row(A: FloatArray, k: int, factor: float) -> None:
    """Row k of A times this factor."""
    for j in range(A.shape[1]):
        A[k, j] *= factor


def scale_nonzero(A: FloatArray, k: int, factor: float) -> None:
    """`scale_row`, but what is zero costs nothing."""
    for j in range(A.shape[1]):
        if A[k, j] != 0.0:
            A[k, j] *= factor


def gauss_jordan(
    scale: Callable[[FloatArray, int, float], None], sweep: Callable[[FloatArray, int, int], None]
) -> Callable[[FloatArray, IntArray], None]:
    """A kernel that inverts a matrix in its own memory by Gauss-Jordan elimination with partial pivoting."""

    def invert(A: FloatArray, swaps: IntArray) -> None:
        """A (N, N) becomes its inverse; swaps (N,) is scratch memory. Singular A gives inf or nan."""
        N = len(A)
        for k in range(N):
            row = pivot_row(A, k)
            swaps[k] = row
            swap_rows(A, row, k)
            pivot = A[k, k]
            A[k, k] = 1.0
            scale(A, k, 1.0 / pivot)
            for i in range(N):
                if i != k:
                    sweep(A, k, i)
        for k in range(N - 1, -1, -1):
            column = swaps[k]
            if column != k:
                for i in range(N):
                    kept = A[i, k]
                    A[i, k] = A[i, column]
                    A[i, column] = kept

    return invert


invert_dense = gauss_jordan(scale_row, sweep_row)
invert_nonzero = gauss_jordan(scale_nonzero, sweep_nonzero)


def invert_by_columns(A: FloatArray, T: FloatArray, column: FloatArray, out: FloatArray) -> None:
    """out = A^-1, column by column: the elimination of A is repeated for each unit vector.

    A (N, N), out (N, N); T (N, N + 1) and column (N, 1) are scratch memory.
    """
    N = len(A)
    for j in range(N):
        for i in range(N):
            for k in range(N):
                T[i, k] = A[i, k]
            T[i, N] = 0.0
        T[j, N] = 1.0
        eliminate_dense(T)
        back_substitute(T, column)
        for i in range(N):
            out[i, j] = column[i, 0]
