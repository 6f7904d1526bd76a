"""Kernels for the last n unknowns of the block system: work.T = [A b] gives work.last, as `block_step` needs it."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.kernels.elimination import back_substitute, eliminate_dense, eliminate_pivoted, eliminate_unpivoted
from filters.kernels.faddeev import faddeev
from filters.kernels.givens import triangularise
from filters.kernels.householder import triangularise_by_reflections
from filters.kernels.inversion import invert_by_columns, invert_dense, invert_nonzero
from filters.robust.block_step import BlockWorkspace


def by_givens(work: BlockWorkspace) -> None:
    """Q^T [A b], then back-substitution of the last unknowns."""
    triangularise(work.T)
    back_substitute(work.T, work.last)


def by_givens_per_column(work: BlockWorkspace) -> None:
    """`by_givens` for each column of b anew, as the paper describes it."""
    N = len(work.T)
    for column in range(work.last.shape[1]):
        for i in range(N):
            for j in range(N):
                work.single[i, j] = work.T[i, j]
            work.single[i, N] = work.T[i, N + column]
        triangularise(work.single)
        back_substitute(work.single, work.last_column)
        for i in range(len(work.last)):
            work.last[i, column] = work.last_column[i, 0]


def by_householder(work: BlockWorkspace) -> None:
    """`by_givens` with one reflection for each column instead of its rotations."""
    triangularise_by_reflections(work.T)
    back_substitute(work.T, work.last)


def by_faddeev(work: BlockWorkspace) -> None:
    """0 + C A^-1 b by Faddeev's algorithm, with the rows of C that pick the last unknowns."""
    n = len(work.last)
    first = len(work.T) - n
    for i in range(n):
        for j in range(len(work.T)):
            work.square[i, j] = 0.0
        work.square[i, first + i] = 1.0
        for column in range(work.last.shape[1]):
            work.last[i, column] = 0.0
    faddeev(work.T, work.square, work.last)


def by_lu(work: BlockWorkspace) -> None:
    """LU with partial pivoting, without touching what is zero."""
    eliminate_pivoted(work.T)
    back_substitute(work.T, work.last)


def by_dense_lu(work: BlockWorkspace) -> None:
    """LU with partial pivoting of all entries."""
    eliminate_dense(work.T)
    back_substitute(work.T, work.last)


def by_unpivoted_lu(work: BlockWorkspace) -> None:
    """LU without pivoting, which has no pivot where mu is infinite and hardly one where it is large."""
    eliminate_unpivoted(work.T)
    back_substitute(work.T, work.last)


def by_inverse(work: BlockWorkspace) -> None:
    """A^-1 by Gauss-Jordan elimination with partial pivoting, and its last rows times b; all dense."""
    _copy_matrix(work.T, work.square)
    invert_dense(work.square, work.swaps)
    _multiply_last_rows(work.square, work.T, work.last)


def by_nonzero_inverse(work: BlockWorkspace) -> None:
    """`by_inverse` without touching what is zero."""
    _copy_matrix(work.T, work.square)
    invert_nonzero(work.square, work.swaps)
    _multiply_last_rows(work.square, work.T, work.last)


def by_repeated_elimination(work: BlockWorkspace) -> None:
    """A^-1 by one elimination per column, as the paper counts it, and its last rows times b; all dense."""
    _copy_matrix(work.T, work.square)
    invert_by_columns(work.square, work.single, work.column, work.result)
    _multiply_last_rows(work.result, work.T, work.last)


def _copy_matrix(T: FloatArray, out: FloatArray) -> None:
    """A of T = [A b]."""
    for i in range(len(T)):
        for j in range(len(T)):
            out[i, j] = T[i, j]


def _multiply_last_rows(inverse: FloatArray, T: FloatArray, out: FloatArray) -> None:
    """The last n rows of A^-1 times b of T = [A b], for out (n, r)."""
    N = len(T)
    first = N - len(out)
    for i in range(len(out)):
        for column in range(out.shape[1]):
            out[i, column] = inverse[first + i, 0] * T[0, N + column]
        for k in range(1, N):
            factor = inverse[first + i, k]
            for column in range(out.shape[1]):
                out[i, column] += factor * T[k, N + column]
