"""What replaces the kernels of `triangular`, `u_d`, `sequential` and `definite` where NumPy is to do the work."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.vectorised_blocks import or_nan
from filters.kernels import definite, sequential, triangular, u_d


def _is_covariance(P: FloatArray, scratch: FloatArray) -> bool:
    if not (np.isfinite(P).all() and (np.abs(P - P.T) <= definite.SYMMETRIC * np.abs(P).max()).all()):
        return False
    root = or_nan(np.linalg.cholesky, P + definite.ROUNDING * np.diag(np.diag(P)))
    return bool(np.isfinite(root).all()) or definite.is_semidefinite(P, scratch)


def _first_indefinite(covariances: FloatArray, scratch: FloatArray) -> int:
    variances = np.diagonal(covariances, axis1=1, axis2=2)[..., np.newaxis] * np.eye(covariances.shape[1])
    roots = or_nan(np.linalg.cholesky, covariances + definite.ROUNDING * variances)
    return len(covariances) if np.isfinite(roots).all() else definite.first_indefinite(covariances, scratch)


def _unit_lower_factors(R: FloatArray, L: FloatArray, variances: FloatArray) -> None:
    C = np.broadcast_to(or_nan(np.linalg.cholesky, R), R.shape)
    L[:], variances[:] = C / np.diag(C), np.diag(C) ** 2


def _solve_unit_lower(L: FloatArray, B: FloatArray, out: FloatArray) -> None:
    out[:] = np.linalg.solve(_unit_lower(L), B)


def _solve_unit_lower_vector(L: FloatArray, b: FloatArray, out: FloatArray) -> None:
    out[:] = np.linalg.solve(_unit_lower(L), b)


def _solve_unit_lower_transposed(L: FloatArray, B: FloatArray, out: FloatArray) -> None:
    out[:] = np.linalg.solve(_unit_lower(L).T, B)


def _unit_lower(L: FloatArray) -> FloatArray:
    return np.tril(L, -1) + np.eye(len(L))


def _join_gain(H: FloatArray, row: int, gains: FloatArray) -> None:
    gains[:row] -= np.outer(gains[:row] @ H[row], gains[row])


def _u_d_factors(P: FloatArray, out: FloatArray) -> None:
    rest = P.copy()
    for i in range(len(P) - 1, -1, -1):
        pivot, column = rest[i, i], rest[i, :i]
        if -u_d.ROUNDED_BELOW * P[i, i] <= pivot <= u_d.ROUNDED * P[i, i]:
            out[: i + 1, i] = 0.0
        else:
            out[i, i], out[:i, i] = pivot, column / pivot
            rest[:i, :i] -= np.outer(out[:i, i], column)


def _u_d_product(factors: FloatArray, out: FloatArray) -> None:
    U = np.triu(factors, 1) + np.eye(len(factors))
    np.matmul(U * np.diag(factors), U.T, out=out)


def _append_unit_product(Phi: FloatArray, factors: FloatArray, V: FloatArray, weights: FloatArray) -> None:
    n = len(Phi)
    weights[:n], weights[n:] = np.diag(V), np.diag(factors)
    np.fill_diagonal(V[:, :n], 1.0)
    V[:, n:] = Phi + Phi @ np.triu(factors, 1)


def _gram_schmidt(V: FloatArray, weights: FloatArray, out: FloatArray, _weighted: FloatArray) -> None:
    for i in range(len(V) - 1, -1, -1):
        products = V[: i + 1, i:] @ (weights[i:] * V[i, i:])
        out[i, i] = products[i]
        out[:i, i] = products[:i] / products[i] if products[i] > u_d.UNDERFLOWN else 0.0
        V[:i, i:] -= np.outer(out[:i, i], V[i, i:])


def _bierman_update(factors: FloatArray, H: FloatArray, noise: FloatArray, row: int, gains: FloatArray) -> None:
    f = H[row] + H[row] @ np.triu(factors, 1)
    v = np.diag(factors) * f
    variances = np.cumsum(np.concatenate(([noise[row]], f * v)))
    np.fill_diagonal(factors, np.diag(factors) * (variances[:-1] / variances[1:]))
    gain = v.copy()
    for j in range(1, len(f)):
        column = factors[:j, j].copy()
        factors[:j, j] -= f[j] / variances[j] * gain[:j]
        gain[:j] += v[j] * column
    gains[row] = gain / variances[-1]


def _root(P: FloatArray, out: FloatArray) -> None:
    n = len(P)
    _u_d_factors(P, out)
    deviations = np.sqrt(np.diag(out))
    out[:, :n] = np.triu(out[:, :n]) * deviations
    np.fill_diagonal(out[:, :n], deviations)


def _root_product(S: FloatArray, out: FloatArray) -> None:
    np.matmul(np.triu(S), np.triu(S).T, out=out)


def _append_root_product(Phi: FloatArray, S: FloatArray, V: FloatArray) -> None:
    np.matmul(Phi, np.triu(S), out=V[:, len(S) :])


def _householder(V: FloatArray, out: FloatArray) -> None:
    R = np.asarray(np.linalg.qr(np.triu(V)[::-1].T, mode="r"))
    out[:] = R[::-1, ::-1].T


def _carlson_update(S: FloatArray, H: FloatArray, noise: FloatArray, row: int, gains: FloatArray) -> None:
    f = H[row] @ np.triu(S)
    variances = np.cumsum(np.concatenate(([noise[row]], f * f)))
    deviations = np.sqrt(variances)
    gain = np.zeros(len(f))
    for j in range(len(f)):
        column = S[: j + 1, j].copy()
        step = f[j] / (deviations[j] * deviations[j + 1])
        S[: j + 1, j] = deviations[j] / deviations[j + 1] * column - step * gain[: j + 1]
        gain[: j + 1] += f[j] * column
    gains[row] = gain / variances[-1]


FACTOR_VERSIONS: tuple[tuple[Callable[..., Any], Any], ...] = (
    (definite.is_covariance, _is_covariance),
    (definite.first_indefinite, _first_indefinite),
    (sequential.unit_lower_factors, _unit_lower_factors),
    (sequential.solve_unit_lower, _solve_unit_lower),
    (sequential.solve_unit_lower_vector, _solve_unit_lower_vector),
    (sequential.solve_unit_lower_transposed, _solve_unit_lower_transposed),
    (sequential.join_gain, _join_gain),
    (u_d.u_d_factors, _u_d_factors),
    (u_d.u_d_product, _u_d_product),
    (u_d.append_unit_product, _append_unit_product),
    (u_d.gram_schmidt, _gram_schmidt),
    (u_d.bierman_update, _bierman_update),
    (triangular.root, _root),
    (triangular.root_product, _root_product),
    (triangular.append_root_product, _append_root_product),
    (triangular.householder, _householder),
    (triangular.carlson_update, _carlson_update),
)
