"""Lower triangles of symmetric matrices: sums of A S A^T, and the Schur complement of their first rows and columns."""

from __future__ import annotations

from filters.arrays import FloatArray


def stack(A: FloatArray, start: int, out: FloatArray) -> None:
    """Rows start, start + 1, ... of out become those of A (a, n), for out (any, n)."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[start + i, j] = A[i, j]


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


def eliminate(count: int, J: FloatArray, values: FloatArray) -> None:
    """The first `count` unknowns of the symmetric system [J, values] are eliminated, without pivoting.

    J (l, l), of which the lower triangle is read, and values (l,): from index `count` on they become
    J_22 - J_21 J_11^-1 J_12 and v_2 - J_21 J_11^-1 v_1.
    """
    for k in range(count):
        scale = 1.0 / J[k, k]
        for i in range(k + 1, J.shape[0]):
            if J[i, k] != 0.0:
                factor = J[i, k] * scale
                values[i] -= factor * values[k]
                for j in range(k + 1, i + 1):
                    J[i, j] -= factor * J[j, k]
