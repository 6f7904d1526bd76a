"""Products, sums and copies of dense matrices and vectors.

A dot product of length n is n multiplies and n - 1 adds: the first term is assigned, the others are added to it.
"""

from __future__ import annotations

from filters.arrays import FloatArray


def matmul(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B, for A (n, m), B (m, p), out (n, p).

    A sum of outer products: the innermost loop runs along a row of B and of out, which a compiler turns into vector
    instructions.
    """
    for i in range(A.shape[0]):
        for j in range(B.shape[1]):
            out[i, j] = A[i, 0] * B[0, j]
    for k in range(1, A.shape[1]):
        for i in range(A.shape[0]):
            factor = A[i, k]
            for j in range(B.shape[1]):
                out[i, j] += factor * B[k, j]


def matmul_narrow(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B as in `matmul`, the same operations in another order: by dot products.

    Twice as fast where B has so few columns that vector instructions are of no use.
    """
    for i in range(A.shape[0]):
        for j in range(B.shape[1]):
            total = A[i, 0] * B[0, j]
            for k in range(1, A.shape[1]):
                total += A[i, k] * B[k, j]
            out[i, j] = total


def matmul_transposed(A: FloatArray, B: FloatArray, out: FloatArray, B_transposed: FloatArray) -> None:
    """out = A B^T, for A (n, m), B (p, m), out (n, p); B_transposed (m, p) is scratch memory.

    The copy is worth its time: the product then runs along rows as `matmul` does.
    """
    transpose(B, B_transposed)
    matmul(A, B_transposed, out)


def matmul_transposed_narrow(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B^T as in `matmul_transposed`, the same operations in another order: by dot products.

    As fast without a copy where B has few rows.
    """
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


def subtract_product_of_transposed(P: FloatArray, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = P - A^T B, for P (n, n), A (m, n), B (m, n), out (n, n); out may be P."""
    for i in range(P.shape[0]):
        factor = A[0, i]
        for j in range(P.shape[1]):
            out[i, j] = P[i, j] - factor * B[0, j]
    for k in range(1, A.shape[0]):
        for i in range(P.shape[0]):
            factor = A[k, i]
            for j in range(P.shape[1]):
                out[i, j] -= factor * B[k, j]


def transpose(A: FloatArray, out: FloatArray) -> None:
    """out = A^T, for A (n, m), out (m, n)."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[j, i] = A[i, j]


def copy(A: FloatArray, out: FloatArray) -> None:
    """out = A, for matrices (n, m)."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = A[i, j]


def copy_vector(a: FloatArray, out: FloatArray) -> None:
    """out = a, for vectors (n,)."""
    for i in range(a.shape[0]):
        out[i] = a[i]


def store(A: FloatArray, stack: FloatArray, index: int) -> None:
    """stack[index] = A, for A (n, m), stack (any, n, m)."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            stack[index, i, j] = A[i, j]


def store_vector(a: FloatArray, stack: FloatArray, index: int) -> None:
    """stack[index] = a, for a (n,), stack (any, n)."""
    for i in range(a.shape[0]):
        stack[index, i] = a[i]
