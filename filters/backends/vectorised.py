"""Run the same jobs with each kernel replaced by NumPy calls: what a filter written with NumPy would cost."""

from __future__ import annotations

from types import FunctionType
from typing import Any, cast

import numpy as np

from filters.arrays import FloatArray
from filters.backends.rebind import Versions
from filters.backends.vectorised_blocks import BLOCK_VERSIONS, or_nan
from filters.backends.vectorised_factors import FACTOR_VERSIONS
from filters.kernels import dense, solve


def vectorised(function: FunctionType) -> Any:
    """A clone of a plain function that calls NumPy where the original calls a kernel that fills arrays."""
    return _VECTORISED.of(function)


def _matmul(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    np.matmul(A, B, out=out)


def _matmul_transposed(A: FloatArray, B: FloatArray, out: FloatArray, _scratch: FloatArray) -> None:
    np.matmul(A, B.T, out=out)


def _matmul_transposed_narrow(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    np.matmul(A, B.T, out=out)


def _add_matvec(A: FloatArray, x: FloatArray, out: FloatArray) -> None:
    out += A @ x


def _add(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    np.add(A, B, out=out)


def _subtract(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    np.subtract(A, B, out=out)


def _add_matmul(P: FloatArray, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    np.add(P, A @ B, out=out)


def _negate(A: FloatArray, out: FloatArray) -> None:
    np.negative(A, out=out)


def _transpose(A: FloatArray, out: FloatArray) -> None:
    out[:] = A.T


def _mirror(P: FloatArray) -> None:
    np.copyto(P, P.T, where=~np.tri(len(P), dtype=bool))


def _inverse(S: FloatArray, out: FloatArray, _scratch: FloatArray) -> None:
    out[:] = or_nan(np.linalg.inv, S)


def _cholesky(S: FloatArray, out: FloatArray) -> None:
    out[:] = or_nan(np.linalg.cholesky, S)


def _subtract_lower_product(P: FloatArray, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    np.subtract(P, A.T @ B, out=out)


def _divide_rows(B: FloatArray, D: FloatArray, out: FloatArray) -> None:
    np.divide(B, np.diag(D)[:, np.newaxis], out=out)


def _place_diagonal(d: FloatArray, out: FloatArray) -> None:
    np.fill_diagonal(out, d)


def _solve_cholesky(C: FloatArray, B: FloatArray, out: FloatArray) -> None:
    out[:] = or_nan(np.linalg.solve, np.tril(C) @ np.tril(C).T, B)


_VERSIONS: dict[FunctionType, Any] = {
    cast(FunctionType, kernel): by_numpy
    for kernel, by_numpy in (
        (dense.matmul, _matmul),
        (dense.matmul_narrow, _matmul),
        (dense.matmul_blocked, _matmul),
        (dense.matmul_transposed, _matmul_transposed),
        (dense.matmul_transposed_narrow, _matmul_transposed_narrow),
        (dense.matvec, _matmul),
        (dense.add_matvec, _add_matvec),
        (dense.add, _add),
        (dense.subtract, _subtract),
        (dense.add_vectors, _add),
        (dense.subtract_vectors, _subtract),
        (dense.add_matmul_blocked, _add_matmul),
        (dense.negate, _negate),
        (dense.subtract_lower_product, _subtract_lower_product),
        (dense.divide_rows, _divide_rows),
        (dense.place_diagonal, _place_diagonal),
        (dense.transpose, _transpose),
        (dense.mirror, _mirror),
        (solve.inverse, _inverse),
        (solve.cholesky, _cholesky),
        (solve.solve_cholesky, _solve_cholesky),
        *FACTOR_VERSIONS,
        *BLOCK_VERSIONS,
    )
}

_VECTORISED = Versions(lambda clone, _original, _known: clone, given=_VERSIONS)
