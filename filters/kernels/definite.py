"""Whether a covariance is one."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray

ROUNDING = 1e-8
"""An eigenvalue so little below zero, where the diagonal is scaled to one, may be what rounding has left of zero."""


def is_semidefinite(P: FloatArray, scratch: FloatArray) -> bool:
    """Whether P (n, n), symmetric, is finite and has no negative eigenvalue, up to rounding; scratch is (n, n).

    By Cholesky's factor of P + ROUNDING diag(P); the lower triangle is read.
    """
    for i in range(P.shape[0]):
        for j in range(i):
            total = P[i, j]
            for k in range(j):
                total -= scratch[i, k] * scratch[j, k]
            scratch[i, j] = total / scratch[j, j]
        pivot = P[i, i] + ROUNDING * P[i, i]
        for k in range(i):
            pivot -= scratch[i, k] * scratch[i, k]
        if pivot == 0.0 and P[i, i] == 0.0:  # known exactly, so it goes with no other
            pivot = 1.0
            for e in range(P.shape[0]):
                if P[max(i, e), min(i, e)] != 0.0:
                    return False
        if not 0.0 < pivot < np.inf:
            return False
        scratch[i, i] = np.sqrt(pivot)
    return True
