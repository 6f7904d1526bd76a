"""Products, sums and copies of dense matrices and vectors.

A dot product of length n is n multiplies and n - 1 adds: the first term is assigned, the others are added to it.
"""

from __future__ import annotations

from filters.arrays import FloatArray


def matmul(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B, for A (n, m), B (m, p), out (n, p).

    The innermost loop runs along a row of B and of out, which a compiler turns into vector instructions.
    """
    for i in range(A.shape[0]):
        for j in range(B.shape[1]):
            out[i, j] = A[i, 0] * B[0, j]
        for k in range(1, A.shape[1]):
            for j in range(B.shape[1]):
                out[i, j] += A[i, k] * B[k, j]


def matmul_transposed(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B^T, for A (n, m), B (p, m), out (n, p)."""
    for i in range(A.shape[0]):
        for j in range(B.shape[0]):
            total = A[i, 0] * B[j, 0]
            for k in range(1, A.shape[1]):
                total += A[i, k] * B[j, k]
            out[i, j] = total


def matvec(A: FloatArray, x: FloatArray, out: FloatArray) -> None:
    """out = A x, for A (n, m), x (m,), out (n,)."""
    for i in range(A.shape[0]):
        total = A[i, 0] * x[0]
        for k in range(1, A.shape[1]):
            total += A[i, k] * x[k]
        out[i] = total


def add_matvec(A: FloatArray, x: FloatArray, out: FloatArray) -> None:
    """out += A x, for A (n, m), x (m,), out (n,)."""
    for i in range(A.shape[0]):
        for k in range(A.shape[1]):
            out[i] += A[i, k] * x[k]


def add(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A + B, for matrices (n, m); out may be A or B."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = A[i, j] + B[i, j]


def subtract(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A - B, for matrices (n, m); out may be A or B."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = A[i, j] - B[i, j]


def add_vectors(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """out = a + b, for vectors (n,); out may be a or b."""
    for i in range(a.shape[0]):
        out[i] = a[i] + b[i]


def subtract_vectors(a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """out = a - b, for vectors (n,); out may be a or b."""
    for i in range(a.shape[0]):
        out[i] = a[i] - b[i]


def identity_minus(A: FloatArray, out: FloatArray) -> None:
    """out = I - A, for A (n, n), out (n, n); out may be A. All n * n entries are subtracted, as Eq. (11) is written."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = (1.0 if i == j else 0.0) - A[i, j]


def subtract_symmetric_product(P: FloatArray, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = P - A B^T, for symmetric P (n, n) and A, B (n, m) whose product A B^T is symmetric; out (n, n), not P.

    Only the lower triangle is computed; it is mirrored, so that out is symmetric to the last bit.
    """
    for i in range(P.shape[0]):
        for j in range(i + 1):
            total = P[i, j] - A[i, 0] * B[j, 0]
            for k in range(1, A.shape[1]):
                total -= A[i, k] * B[j, k]
            out[i, j] = total
            out[j, i] = total
