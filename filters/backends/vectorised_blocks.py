"""What replaces the kernels of `givens`, `elimination`, `inversion`, `place` and `schur` in NumPy's version."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.kernels import elimination, givens, inversion, place, schur
from filters.kernels.place import IntArray


def or_nan(function: Callable[..., FloatArray], *matrices: FloatArray) -> FloatArray | float:
    """What the function of NumPy's gives, or nan where it finds a matrix singular or not positive definite."""
    try:
        return function(*matrices)
    except np.linalg.LinAlgError:
        return np.nan


def _clear(T: FloatArray) -> None:
    T[:] = 0.0


def _place(block: FloatArray, row: int, column: int, T: FloatArray) -> None:
    T[row : row + block.shape[0], column : column + block.shape[1]] = block


def _place_both_ways(block: FloatArray, row: int, column: int, T: FloatArray) -> None:
    _place(block, row, column, T)
    _place(block.T, column, row, T)


def _triangularise(T: FloatArray) -> None:
    T[:] = np.linalg.qr(T, mode="r")


def _back_substitute(T: FloatArray, out: FloatArray) -> None:
    first, N = len(T) - len(out), len(T)
    out[:] = or_nan(np.linalg.solve, np.triu(T[first:, first:N]), T[first:, N:])


def _subtract(T: FloatArray, k: int) -> None:
    factors = T[k + 1 :, k] / T[k, k]
    T[k + 1 :, k] = 0.0
    T[k + 1 :, k + 1 :] -= np.outer(factors, T[k, k + 1 :])


def _eliminate(T: FloatArray) -> None:
    for k in range(len(T) - 1):
        rows = np.array([k, k + np.abs(T[k:, k]).argmax()])
        T[rows] = T[rows[::-1]]
        _subtract(T, k)


def _eliminate_unpivoted(T: FloatArray) -> None:
    for k in range(len(T) - 1):
        _subtract(T, k)


def _invert(A: FloatArray, _swaps: IntArray) -> None:
    A[:] = or_nan(np.linalg.inv, A)


def _invert_by_columns(A: FloatArray, _T: FloatArray, _column: FloatArray, out: FloatArray) -> None:
    for j, unit in enumerate(np.eye(len(A))):
        out[:, j] = or_nan(np.linalg.solve, A, unit)


def _add_outer(A: FloatArray, S: FloatArray, start: int, J: FloatArray, _AS: FloatArray) -> None:
    J[start : start + len(A), start : start + len(A)] += A @ S @ A.T


def _complement(count: int, J: FloatArray, values: FloatArray) -> None:
    for k in range(count):
        factors = J[k + 1 :, k] / J[k, k]
        values[k + 1 :] -= factors * values[k]
        J[k + 1 :, k + 1 :] -= np.outer(factors, J[k + 1 :, k])


BLOCK_VERSIONS: tuple[tuple[Callable[..., Any], Callable[..., Any]], ...] = (
    (place.clear, _clear),
    (place.place, _place),
    (place.place_both_ways, _place_both_ways),
    (givens.triangularise, _triangularise),
    (elimination.back_substitute, _back_substitute),
    (elimination.eliminate_dense, _eliminate),
    (elimination.eliminate_pivoted, _eliminate),
    (elimination.eliminate_unpivoted, _eliminate_unpivoted),
    (inversion.invert_dense, _invert),
    (inversion.invert_nonzero, _invert),
    (inversion.invert_by_columns, _invert_by_columns),
    (schur.add_outer, _add_outer),
    (schur.complement, _complement),
)
