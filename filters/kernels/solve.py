"""Inverse and factor of a small symmetric positive definite matrix, such as the innovation covariance S of Eq. (9)."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray


def inverse(S: FloatArray, out: FloatArray, scratch: FloatArray) -> None:
    """out = S^-1 by Gauss-Jordan elimination, for S (p, p) symmetric positive definite; scratch is (p, p).

    No pivoting: the pivots of a positive definite matrix are positive. S that is singular gives inf or nan.
    """
    p = S.shape[0]
    for i in range(p):
        for j in range(p):
            scratch[i, j] = S[i, j]
            out[i, j] = 0.0
        out[i, i] = 1.0
    for i in range(p):
        scale = 1.0 / scratch[i, i]
        for j in range(p):
            scratch[i, j] *= scale
            out[i, j] *= scale
        for row in range(p):
            if row != i:
                factor = scratch[row, i]
                for j in range(p):
                    scratch[row, j] -= factor * scratch[i, j]
                    out[row, j] -= factor * out[i, j]


def cholesky(S: FloatArray, out: FloatArray) -> None:
    """out = C, the lower triangular factor of S = C C^T, for S (p, p) symmetric positive definite, out (p, p).

    The part of out above its diagonal is left as it was. S that is not positive definite gives nan.
    """
    for i in range(S.shape[0]):
        for j in range(i + 1):
            total = S[i, j]
            for k in range(j):
                total -= out[i, k] * out[j, k]
            if i == j:
                out[i, i] = np.sqrt(total)
            else:
                out[i, j] = total / out[j, j]


def solve_cholesky(C: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = S^-1 B where S = C C^T is given by its Cholesky factor C (p, p), for B (p, n), out (p, n); out may be B.

    Solved forward with C, then backward with C^T, along whole rows. Each pivot is inverted once, for n divides cost
    more than n multiplies.
    """
    p, n = B.shape
    for i in range(p):
        for j in range(n):
            out[i, j] = B[i, j]
        for k in range(i):
            factor = C[i, k]
            for j in range(n):
                out[i, j] -= factor * out[k, j]
        scale = 1.0 / C[i, i]
        for j in range(n):
            out[i, j] *= scale
    for i in range(p - 1, -1, -1):
        for k in range(i + 1, p):
            factor = C[k, i]
            for j in range(n):
                out[i, j] -= factor * out[k, j]
        scale = 1.0 / C[i, i]
        for j in range(n):
            out[i, j] *= scale
