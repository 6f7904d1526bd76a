"""Lower triangles of symmetric matrices: sums of A S A^T, and the Schur complement of their first rows and columns."""

from __future__ import annotations

from filters.arrays import FloatArray

ROUNDING = 1e-15
"""What is left of a variance, relatively, that is nothing but rounding."""


def add_diagonal(value: float, start: int, stop: int, J: FloatArray) -> None:
    """J_ii += value for start <= i < stop, for J (l, l)."""
    for i in range(start, stop):
        J[i, i] += value


def add_outer(A: FloatArray, S: FloatArray, start: int, J: FloatArray, AS: FloatArray) -> None:
    """A S A^T is added to the lower triangle of J, from row and column `start` on; what of A is zero costs nothing.

    A (a, n), S (n, n) symmetric, J (l, l) with start + a <= l. AS (a, n) is scratch memory.
    """
    n = S.shape[0]
    for i in range(A.shape[0]):
        for k in range(n):
            AS[i, k] = 0.0
        for j in range(n):
            factor = A[i, j]
            if factor != 0.0:
                for k in range(n):
                    AS[i, k] += factor * S[j, k]
    for j in range(A.shape[0]):
        for k in range(n):
            factor = A[j, k]
            if factor != 0.0:
                for i in range(j, A.shape[0]):
                    J[start + i, start + j] += AS[i, k] * factor


def complement(count: int, J: FloatArray, values: FloatArray) -> None:
    """The first `count` unknowns of the symmetric system [J, values] are eliminated, without pivoting.

    J (l, l), of which the lower triangle is read, and values (l,): from index `count` on they become
    J_22 - J_21 J_11^-1 J_12 and v_2 - J_21 J_11^-1 v_1. What is zero costs nothing.
    """
    for k in range(count):
        scale = 1.0 / J[k, k]
        for i in range(k + 1, J.shape[0]):
            if J[i, k] != 0.0:
                factor = J[i, k] * scale
                values[i] -= factor * values[k]
                for j in range(k + 1, i + 1):
                    J[i, j] -= factor * J[j, k]


def decorrelate(count: int, J: FloatArray, rows: FloatArray, values: FloatArray, variances: FloatArray) -> None:
    """The first `count` of equations whose noise has the covariance J come to share no noise with the others.

    J (l, l), lower triangle, rows (l, n) and values (l,) are all transformed by the same unit lower triangular matrix.
    An equation whose noise follows from that of others has none of its own then. variances (l,) is scratch memory.
    """
    for k in range(count):
        variances[k] = J[k, k]
    for k in range(count):
        if J[k, k] <= ROUNDING * variances[k]:
            J[k, k] = 0.0
        else:
            scale = 1.0 / J[k, k]
            for i in range(k + 1, J.shape[0]):
                if J[i, k] != 0.0:
                    factor = J[i, k] * scale
                    values[i] -= factor * values[k]
                    for j in range(rows.shape[1]):
                        rows[i, j] -= factor * rows[k, j]
                    for j in range(k + 1, i + 1):
                        J[i, j] -= factor * J[j, k]
            for i in range(k + 1, J.shape[0]):
                J[i, k] = 0.0
