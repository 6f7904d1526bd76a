"""Whether rounding has left a run its variances and gains, by the same covariances from square roots.

Where a measurement is far more precise than the estimate, or two measurements are nearly the same, what is left of P is
a difference of numbers that are nearly equal. P may still be a covariance and yet say far too little, and a gain may be
far from the best one. Square roots keep twice as many digits: for such a run, and no other, the covariances are
computed again as P = C C^T, by orthogonal transformations (Kaminski, Bryson and Schmidt, IEEE Transactions on
Automatic Control 16, 1971).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.kernels.dense import copy, matmul_transposed_narrow
from filters.kernels.solve import cholesky
from filters.records import Estimate, Workspace, new_workspace
from filters.system import System
from filters.systems.linear import is_linear

SHARP = 1e-9
"""So small a share of its variance is noise, in some combination of measurements, where rounding may matter."""

TOLERANCE = 4.0
"""A variance, or what a gain adds to one, may be wrong by this factor: a standard deviation by two."""

NOTHING = 1e-28
"""A share of a variance that is zero but for rounding of its root."""

ROUNDED = 1e-14
"""A share of a variance that is zero but for rounding."""


def check_rounding(
    system: System,
    x: FloatArray,
    reference: Estimate,
    gains: FloatArray,
    inputs: FloatArray,
    every: int,
    stride: int,
    remedy: str,
    backend: BackendName,
) -> None:
    """Raises ValueError, naming the step k, where P_{k^-} or the gain is no better than rounding.

    That is: a variance of P_{k^-} is less than a quarter or more than four times what it should be, or the gain makes
    one of P_{k^+} more than five times what the best gain leaves. (Of systems that are not linear P_{k^-} is looked at
    from one k to the next only, so that what is wrong between variances goes unseen.)

    x (steps + 1, n): at the end of every step. reference: x_{k^-} (cycles, n) and P_{k^-} (cycles, n, n) of every so
    many steps. gains (updates, n, p): those of k. stride: steps over which F and Q of the system reach.
    """
    functions = (arguments_for(backend, part) for part in (system.H, system.R, system.parameters))
    if not function_for(backend, is_sharp)(*functions, every, reference, len(gains), new_workspace(system)):
        return
    k = _first_outgrown(system, x, reference, gains, inputs, every, stride)
    if k is not None:
        raise ValueError(
            f"step {k}: rounding errors have made the covariance wrong, or the gain far from the best one, for a "
            f"measurement, or the difference of two, is too precise for the digits of P; {remedy}"
        )


def _first_outgrown(
    system: System, x: FloatArray, reference: Estimate, gains: FloatArray, inputs: FloatArray, every: int, stride: int
) -> int | None:
    n, p = system.states, system.measurements
    linear = is_linear(system)
    C = _root(reference.P[0])
    before = np.zeros(n)
    for c, P in enumerate(reference.P):
        k = c * every
        variances, claimed = _variances(C), np.diag(P)
        too_small = variances > TOLERANCE * (claimed + NOTHING * before)
        too_large = claimed > TOLERANCE * (variances + ROUNDED * before)
        if (too_small | too_large).any():
            return k
        if not linear:  # F at an estimate that a later correction has moved is not quite the one that was used
            C = _root(P)
        if c < len(gains):
            H, R = system.H(k, reference.x[c], system.parameters), system.R(k, system.parameters)
            both = _triangular(np.block([[_root(R), H @ C], [np.zeros((n, p)), C]]))
            excess = gains[c] @ both[:p, :p] - both[p:, :p]
            C = both[p:, p:]
            if (_variances(excess) > TOLERANCE * (_variances(C) + NOTHING * variances)).any():
                return k
        before = variances
        for j in range(k, min(k + every, len(x) - 1), stride):
            F, Q = system.F(j, x[j], inputs[j], system.parameters), system.Q(j, system.parameters)
            C = _triangular(np.hstack([F @ C, _root(Q)]))
    return None


def is_sharp(
    H_at: Callable[..., FloatArray],
    R_at: Callable[..., FloatArray],
    parameters: Any,
    every: int,
    reference: Estimate,
    updates: int,
    work: Workspace,
) -> bool:
    """Whether the noise of some combination of measurements is next to nothing beside what was expected of it.

    That is where R - SHARP diag(H P H^T + R) is not positive definite. Shapes as in `check_rounding`.
    """
    for c in range(updates):
        k = c * every
        H, R = H_at(k, reference.x[c], parameters), R_at(k, parameters)
        matmul_transposed_narrow(reference.P[c], H, work.PHt)
        copy(R, work.S)
        for i in range(H.shape[0]):
            expected = R[i, i]
            for e in range(H.shape[1]):
                expected += H[i, e] * work.PHt[e, i]
            work.S[i, i] -= SHARP * expected
        cholesky(work.S, work.S_inverse)
        for i in range(H.shape[0]):
            if not work.S_inverse[i, i] > 0.0:
                return True
    return False


def _root(P: FloatArray) -> FloatArray:
    """C of P = C C^T; variances are scaled to one before, so that small ones keep their digits."""
    deviations = np.sqrt(np.maximum(np.diag(P), np.finfo(np.float64).tiny))
    values, vectors = np.linalg.eigh(P / np.outer(deviations, deviations))
    root: FloatArray = deviations[:, np.newaxis] * vectors * np.sqrt(np.maximum(values, 0.0))
    return root


def _triangular(A: FloatArray) -> FloatArray:
    """C lower triangular with C C^T = A A^T."""
    upper: FloatArray = np.asarray(np.linalg.qr(A.T, mode="r"))
    return upper.T


def _variances(C: FloatArray) -> FloatArray:
    """The diagonal of C C^T."""
    diagonal: FloatArray = (C**2).sum(axis=1)
    return diagonal
