"""How the covariance is corrected: in the shortest form, or in Joseph's; for factors of it see `u_d`.

Each writes P' (n, n), which is symmetric to the last digit, once `correctors.estimate_error` has left the gain K^T.
view: the corrector's, see `correctors.Corrector`. Bucy and Joseph, Filtering for stochastic processes with applications
to guidance, 1968.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeAlias

from filters.arrays import FloatArray
from filters.kernels.dense import add_matmul_blocked, matmul_blocked, mirror, transpose
from filters.kernels.place import clear
from filters.modular.predictors import Kind
from filters.modular.sigma_points import add_covariance
from filters.modular.workspace import Workspace

UpdateName: TypeAlias = Literal["short", "joseph", "u-d"]
UPDATES: tuple[UpdateName, ...] = ("short", "joseph", "u-d")
Covariance: TypeAlias = Callable[[Any, FloatArray, FloatArray, Workspace], None]


def short(_view: Any, P: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P' = P - K cross, where cross = H P: the least work."""
    for e in range(P.shape[0]):
        for r in range(work.gain.shape[0]):
            work.K[e, r] = -work.gain[r, e]
    add_matmul_blocked(P, work.K, work.cross, out)
    mirror(out)


def joseph(view: Any, P: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P' = (I - K H) P (I - K H)^T + K R K^T: positive definite whatever rounding has made of K."""
    for e in range(P.shape[0]):
        for r in range(work.gain.shape[0]):
            work.K[e, r] = -work.gain[r, e]
        for column in range(P.shape[0]):
            work.nn1[e, column] = 1.0 if e == column else 0.0
    add_matmul_blocked(work.nn1, work.K, work.H, work.nn1)
    matmul_blocked(work.nn1, P, work.nn2)
    transpose(work.nn1, work.nn3)
    matmul_blocked(work.nn2, work.nn3, out)
    _add_noise(view.R, out, work)
    mirror(out)


def joseph_of_points(view: Any, _P: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P' = sum w (e - K s) (e - K s)^T + K R K^T over the sigma points' errors e and those s of what they see.

    The same with the covariances of the points in place of P and H: positive definite if no weight w is negative.
    """
    for i in range(work.errors.shape[0]):
        for e in range(work.errors.shape[1]):
            total = work.errors[i, e]
            for r in range(work.gain.shape[0]):
                total -= work.gain[r, e] * work.seen_errors[i, r]
            work.moved_errors[i, e] = total
    clear(out)
    _add_noise(view.R, out, work)
    add_covariance(work.moved_errors, work.moved_errors, view.weighing, out)
    mirror(out)


def _add_noise(R: FloatArray, out: FloatArray, work: Workspace) -> None:
    """out += K R K^T."""
    matmul_blocked(R, work.gain, work.cross)
    transpose(work.gain, work.K)
    add_matmul_blocked(out, work.K, work.cross, out)


def covariance_of(update: UpdateName, kind: Kind) -> Covariance:
    """How the covariance, not factors of it, is corrected by a corrector of this kind."""
    if update == "short":
        return short
    return joseph_of_points if kind == "unscented" else joseph
