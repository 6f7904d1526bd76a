"""Covariances that are singular, or nearly: whether one is a covariance, and its root."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.solve import cholesky

ROUNDING = 1e-8
"""An eigenvalue so little below zero, where the diagonal is scaled to one, may be what rounding has left of zero."""

SINGULAR = 1e-14
"""A variance so small, as a share of that before the others were known, is what rounding has made of zero."""


SYMMETRIC = 1e-9
"""By so much of the largest entry may two differ, of which one is the other's mirror image."""


def is_covariance(P: FloatArray, scratch: FloatArray) -> bool:
    """Whether P (n, n) is finite, symmetric and has no negative eigenvalue, up to rounding; scratch is (n, n)."""
    largest = 0.0
    for i in range(P.shape[0]):
        for j in range(P.shape[0]):
            largest = max(largest, abs(P[i, j]))
    for i in range(P.shape[0]):
        for j in range(i):
            if not abs(P[i, j] - P[j, i]) <= SYMMETRIC * largest < np.inf:
                return False
    return is_semidefinite(P, scratch)


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


def first_indefinite(covariances: FloatArray, scratch: FloatArray) -> int:
    """The index of the first of them (any, n, n) that is none, or their number; scratch is (n, n)."""
    for c in range(len(covariances)):
        if not is_semidefinite(covariances[c], scratch):
            return c
    return len(covariances)


def covariance_root(P: FloatArray, out: FloatArray) -> None:
    """out = C, lower triangular, of a covariance P = C C^T (n, n), of which the lower triangle is read.

    Cholesky's factor, if P is not singular; else where no variance is left but what rounding makes of none, a column
    is zero. What is above the diagonal of out is left as it was.
    """
    cholesky(P, out)
    for i in range(P.shape[0]):
        if not out[i, i] > 0.0:
            _singular_root(P, out)
            return


def _singular_root(P: FloatArray, out: FloatArray) -> None:
    for i in range(P.shape[0]):
        for j in range(i + 1):
            total = P[i, j]
            for k in range(j):
                total -= out[i, k] * out[j, k]
            if i > j:
                out[i, j] = total / out[j, j] if out[j, j] > 0.0 else 0.0
            else:
                out[i, i] = np.sqrt(total) if total > SINGULAR * P[i, i] else 0.0
