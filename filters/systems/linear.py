"""The general linear system of Eqs. (1) and (2), constant or time-varying."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray, as_array
from filters.covariances import check_covariance
from filters.kernels.dense import add_matvec, matvec
from filters.system import System


class LinearParameters(NamedTuple):
    """The matrices of a linear system, first index the step, taken modulo its length."""

    Phi: FloatArray
    B: FloatArray
    H: FloatArray
    Q: FloatArray
    R: FloatArray


def linear_system(Phi: ArrayLike, B: ArrayLike, H: ArrayLike, Q: ArrayLike, R: ArrayLike) -> System:
    """x_{j+1} = Phi_j x_j + B_j u_j + w_j, y_k = H_k x_k + nu_k (Eqs. 1, 2).

    Each matrix is constant (2-D) or one per step (3-D, first index the step; step j uses matrix j modulo their
    number): Phi (n, n), B (n, m), H (p, n), Q (n, n), R (p, p). n comes from Phi, m from B, p from H. A system without
    inputs has a B of no columns, (n, 0).

    Raises:
        ValueError: a matrix is neither 2-D nor 3-D, has the wrong shape, or holds a number that is not finite; or a Q
            or R is no covariance.
    """
    matrices = LinearParameters(
        *(_by_step(name, value) for name, value in zip(LinearParameters._fields, (Phi, B, H, Q, R), strict=True))
    )
    n, m, p = matrices.Phi.shape[1], matrices.B.shape[2], matrices.H.shape[1]
    _check_shape("Phi", matrices.Phi, (n, n))
    _check_shape("B", matrices.B, (n, m))
    _check_shape("H", matrices.H, (p, n))
    _check_shape("Q", matrices.Q, (n, n))
    _check_shape("R", matrices.R, (p, p))
    for name in ("Q", "R"):
        by_step = getattr(matrices, name)
        for j, matrix in enumerate(by_step):
            check_covariance(f"linear_system: {name}{f' of step {j}' if len(by_step) > 1 else ''}", matrix)
    return System(n, m, p, _f, _F, _Q, _h, _H, _R, matrices)


def is_linear(system: System) -> bool:
    """Whether it is as `linear_system` makes them: its functions, and matrices whose shapes fit it."""
    n, m, p, *functions, matrices, _structure = system
    return (
        functions == [_f, _F, _Q, _h, _H, _R]
        and isinstance(matrices, LinearParameters)
        and [np.shape(matrix)[1:] for matrix in matrices] == [(n, n), (n, m), (p, n), (n, n), (p, p)]
    )


def _row(j: int, steps: int) -> int:
    """Which matrix step j uses. Constant matrices are spared the division, for it takes longer than a small product."""
    return j % steps if steps > 1 else 0


def _f(j: int, x: FloatArray, u: FloatArray, matrices: LinearParameters, out: FloatArray) -> None:
    matvec(matrices.Phi[_row(j, len(matrices.Phi))], x, out)
    add_matvec(matrices.B[_row(j, len(matrices.B))], u, out)


def _F(j: int, _x: FloatArray, _u: FloatArray, matrices: LinearParameters) -> FloatArray:
    Phi: FloatArray = matrices.Phi[_row(j, len(matrices.Phi))]
    return Phi


def _Q(j: int, matrices: LinearParameters) -> FloatArray:
    Q: FloatArray = matrices.Q[_row(j, len(matrices.Q))]
    return Q


def _h(k: int, x: FloatArray, matrices: LinearParameters, out: FloatArray) -> None:
    matvec(matrices.H[_row(k, len(matrices.H))], x, out)


def _H(k: int, _x: FloatArray, matrices: LinearParameters) -> FloatArray:
    H: FloatArray = matrices.H[_row(k, len(matrices.H))]
    return H


def _R(k: int, matrices: LinearParameters) -> FloatArray:
    R: FloatArray = matrices.R[_row(k, len(matrices.R))]
    return R


def _by_step(name: str, value: ArrayLike) -> FloatArray:
    """A contiguous copy with the step as first index."""
    matrix = as_array(f"linear_system: {name}", value)
    if matrix.ndim == 2:
        matrix = matrix[np.newaxis]
    if matrix.ndim != 3 or 0 in (matrix.shape if name != "B" else matrix.shape[:2]):
        raise ValueError(
            f"linear_system: {name} has shape {np.shape(value)}; needed is a matrix (2-D), or one per step (3-D)"
        )
    if not np.isfinite(matrix).all():
        raise ValueError(f"linear_system: {name} holds a value that is not finite")
    return matrix


def _check_shape(name: str, matrix: FloatArray, needed: tuple[int, int]) -> None:
    if matrix.shape[1:] != needed:
        raise ValueError(
            f"linear_system: {name} has shape {matrix.shape[1:]}, needed is {needed}; "
            f"Phi gives the number of states, B that of inputs, H that of measurements"
        )
