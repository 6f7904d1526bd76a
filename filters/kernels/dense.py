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


def matmul_blocked(A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = A B as in `matmul`, the same operations in another order: three outer products at a time.

    `out` is then read and written a third as often. Two thirds of the time for 9 x 9.
    """
    if A.shape[1] < 3:
        matmul(A, B, out)
        return
    for i in range(A.shape[0]):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        for j in range(B.shape[1]):
            out[i, j] = a * B[0, j] + b * B[1, j] + c * B[2, j]
    _add_terms_from(3, A, B, out)


def add_matmul_blocked(P: FloatArray, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = P + A B, for P (n, p), A (n, m), B (m, p), out (n, p); out may be P. Otherwise as `matmul_blocked`."""
    if A.shape[1] < 3:
        copy(P, out)
        _add_terms_from(0, A, B, out)
        return
    for i in range(A.shape[0]):
        a, b, c = A[i, 0], A[i, 1], A[i, 2]
        for j in range(B.shape[1]):
            out[i, j] = P[i, j] + (a * B[0, j] + b * B[1, j] + c * B[2, j])
    _add_terms_from(3, A, B, out)


def _add_terms_from(start: int, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out += A B without the first terms of each dot product."""
    m = A.shape[1]
    single = m - (m - start) % 3
    for k in range(start, single, 3):
        for i in range(A.shape[0]):
            a, b, c = A[i, k], A[i, k + 1], A[i, k + 2]
            for j in range(B.shape[1]):
                out[i, j] += a * B[k, j] + b * B[k + 1, j] + c * B[k + 2, j]
    for k in range(single, m):
        for i in range(A.shape[0]):
            factor = A[i, k]
            for j in range(B.shape[1]):
                out[i, j] += factor * B[k, j]


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


def subtract_lower_product(P: FloatArray, A: FloatArray, B: FloatArray, out: FloatArray) -> None:
    """out = P - A^T B on and below the diagonal, for P (n, n), A and B (m, n), out (n, n); out may be P."""
    for i in range(P.shape[0]):
        for j in range(i + 1):
            out[i, j] = P[i, j]
    for k in range(A.shape[0]):
        for i in range(A.shape[1]):
            factor = A[k, i]
            for j in range(i + 1):
                out[i, j] -= factor * B[k, j]


def divide_rows(B: FloatArray, D: FloatArray, out: FloatArray) -> None:
    """out = B with each row divided by its entry on the diagonal of D (p, p), for B (p, n), out (p, n)."""
    for i in range(B.shape[0]):
        scale = 1.0 / D[i, i]
        for j in range(B.shape[1]):
            out[i, j] = B[i, j] * scale


def place_diagonal(d: FloatArray, out: FloatArray) -> None:
    """The diagonal of out (n, n) = d (n,)."""
    for i in range(d.shape[0]):
        out[i, i] = d[i]


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


def negate(A: FloatArray, out: FloatArray) -> None:
    """out = -A, for matrices (n, m); out may be A."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = -A[i, j]


def transpose(A: FloatArray, out: FloatArray) -> None:
    """out = A^T, for A (n, m), out (m, n)."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[j, i] = A[i, j]


def mirror(P: FloatArray) -> None:
    """P (n, n) becomes symmetric: what is above its diagonal is taken from below."""
    for i in range(P.shape[0]):
        for j in range(i):
            P[j, i] = P[i, j]


def are_equal(A: FloatArray, B: FloatArray) -> bool:
    """Whether matrices (n, m) have the same numbers; nan is equal to none."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            if A[i, j] != B[i, j]:
                return False
    return True


def copy(A: FloatArray, out: FloatArray) -> None:
    """out = A, for matrices (n, m)."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = A[i, j]


def copy_diagonal(A: FloatArray, out: FloatArray) -> None:
    """out (n,) = the diagonal of A (n, n)."""
    for i in range(A.shape[0]):
        out[i] = A[i, i]


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
