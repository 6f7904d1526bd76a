"""The covariance that the error of a linear filter really has, for whatever gains it used; no simulation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.covariances import check_covariance
from filters.noises import check_noises
from filters.problem import check_system
from filters.running import running
from filters.system import System
from filters.systems.shaped import shaped


class TrueCovariance(NamedTuple):
    """The estimation error's in every step.

    before (..., steps + 1, n, n): before its measurement is used; after (..., steps + 1, n, n): after that.
    """

    before: FloatArray
    after: FloatArray


@running("system")
def true_covariance(system: System, P0: FloatArray, gains: FloatArray) -> TrueCovariance:
    """The covariance of x - x_true where step j used y_j with the gain K_j, x = x^- + K_j (y_j - H_j x^-).

    system: linear, for its Phi and H are taken at the state zero; its noises are the true ones. P0 (n, n): covariance
    of the first estimate's error. gains (..., steps + 1, n, p): leading axes are filters computed side by side.

    Joseph's form, P+ = (I - K H) P- (I - K H)^T + K R K^T, holds for any K; Gelb, Applied Optimal Estimation, 1974.

    Raises:
        ValueError: a shape is wrong, P0, the gains or what the system gives are not finite, or P0, Q or R of some step
            is no covariance.
    """
    check_system("system", system)
    n, m, p = system.states, system.inputs, system.measurements
    if np.shape(P0) != (n, n) or gains.ndim < 3 or gains.shape[-2:] != (n, p):
        raise ValueError(
            f"true_covariance: P0 has shape {np.shape(P0)}, needed is ({n}, {n}); "
            f"gains {gains.shape}, needed is (..., steps + 1, {n}, {p})"
        )
    check_covariance("true_covariance: P0", P0)
    if not np.isfinite(gains).all():
        raise ValueError("true_covariance: gains holds a value that is not finite")
    steps, system = gains.shape[-3] - 1, shaped(system)
    check_noises(system, range(steps), range(steps + 1))
    x, u = np.zeros(n), np.zeros(m)
    before, after = np.empty((*gains.shape[:-1], n)), np.empty((*gains.shape[:-1], n))
    for j in range(steps + 1):
        if j == 0:
            before[..., 0, :, :] = P0
        else:
            Phi = system.F(j - 1, x, u, system.parameters)
            Q = system.Q(j - 1, system.parameters)
            before[..., j, :, :] = _symmetric(Phi @ after[..., j - 1, :, :] @ Phi.T + Q)
        H, R = system.H(j, x, system.parameters), system.R(j, system.parameters)
        K = gains[..., j, :, :]
        A = np.eye(n) - K @ H
        after[..., j, :, :] = _symmetric(A @ before[..., j, :, :] @ _transposed(A) + K @ R @ _transposed(K))
        if not np.isfinite(after[..., j, :, :]).all():
            raise ValueError(
                f"true_covariance, step {j}: the covariance is no longer finite; look at F, Q, H, R of the system at "
                f"the state zero, and whether these gains hold the error of an unstable system"
            )
    return TrueCovariance(before, after)


def _transposed(matrices: FloatArray) -> FloatArray:
    return np.swapaxes(matrices, -1, -2)


def _symmetric(matrices: FloatArray) -> FloatArray:
    return 0.5 * (matrices + _transposed(matrices))
