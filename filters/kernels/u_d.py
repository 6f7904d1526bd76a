"""A covariance P = U D U^T in one array: U unit upper triangular, and D on its diagonal in place of the ones.

What such an array holds below its diagonal means nothing. G. J. Bierman, Factorization Methods for Discrete Sequential
Estimation, 1977. Loops that go through two rows at a time do so for speed: the sums of both are then under way at once.
"""

from __future__ import annotations

from filters.arrays import FloatArray

ROUNDED = 1e-14  # a pivot so small beside its diagonal entry is what rounding has left of zero,
ROUNDED_BELOW = 1e-8  # and so is one below zero, for there is no other reason why it should be there
UNDERFLOWN = 1e-290  # a sum of squares so small has lost digits


def u_d_factors(P: FloatArray, out: FloatArray) -> None:
    """out = U and D of P (n, n), symmetric positive semidefinite, of which the lower triangle is read (Bierman).

    out (n, n) or wider, then only its first n columns are written. A singular P has zeros in D, and above them in U;
    a P that is not semidefinite has negative entries in D.
    """
    n = P.shape[0]
    for i in range(n):
        for j in range(i + 1):
            out[i, j] = P[i, j]
    for i in range(n - 1, -1, -1):
        if -ROUNDED_BELOW * P[i, i] <= out[i, i] <= ROUNDED * P[i, i]:
            out[i, i] = scale = 0.0
        else:
            scale = 1.0 / out[i, i]
        for j in range(i - 1, -1, -1):
            factor = out[i, j] * scale
            out[j, i] = factor
            for k in range(j + 1):
                out[j, k] -= factor * out[i, k]


def u_d_product(factors: FloatArray, out: FloatArray) -> None:
    """out = U D U^T, for factors (n, n), out (n, n)."""
    n = factors.shape[0]
    for i in range(n):
        for j in range(i, n):
            total = factors[j, j] if i == j else factors[i, j] * factors[j, j]
            for k in range(j + 1, n):
                total += factors[i, k] * factors[k, k] * factors[j, k]
            out[i, j] = out[j, i] = total


def append_unit_product(Phi: FloatArray, factors: FloatArray, V: FloatArray, weights: FloatArray) -> None:
    """V = [U', Phi U] and weights = [D', D], for U' and D' given in the first n columns of V (n, 2n), weights (2n,).

    V diag(weights) V^T is then Phi U D U^T Phi^T + U' D' U'^T, for Phi (n, n) and factors U, D (n, n).
    """
    n = Phi.shape[0]
    for j in range(n):
        weights[j] = V[j, j]
        weights[n + j] = factors[j, j]
        V[j, j] = 1.0
        for i in range(n):
            total = Phi[i, j]
            for k in range(j):
                total += Phi[i, k] * factors[k, j]
            V[i, n + j] = total


def gram_schmidt(V: FloatArray, weights: FloatArray, out: FloatArray, weighted: FloatArray) -> None:
    """out = U and D of V diag(weights) V^T, by Thornton's modified weighted Gram-Schmidt method (Bierman).

    V (n, 2n): upper triangular in its first n columns, which stay so and are not read below the diagonal; overwritten.
    weights (2n,): not negative. out (n, n). weighted (2n,): scratch memory.
    """
    n, length = V.shape
    for i in range(n - 1, -1, -1):
        total = 0.0
        for c in range(i, length):
            weighted[c] = weights[c] * V[i, c]
            total += weighted[c] * V[i, c]
        out[i, i] = total
        scale = 1.0 / total if total > UNDERFLOWN else 0.0
        for j in range(i - 1, 0, -2):
            _project_two(V, i, j, j - 1, weighted, scale, out)
        if i % 2 == 1:
            _project(V, i, 0, weighted, scale, out)


def _project(V: FloatArray, i: int, j: int, weighted: FloatArray, scale: float, out: FloatArray) -> None:
    """Take from row j of V what it has of row i, and note how much that was."""
    length = V.shape[1]
    total = V[j, i] * weighted[i]
    for c in range(i + 1, length):
        total += V[j, c] * weighted[c]
    factor = total * scale
    for c in range(i, length):
        V[j, c] -= factor * V[i, c]
    out[j, i] = factor


def _project_two(V: FloatArray, i: int, j: int, k: int, weighted: FloatArray, scale: float, out: FloatArray) -> None:
    """`_project` for the rows j and k."""
    length = V.shape[1]
    total_j = V[j, i] * weighted[i]
    total_k = V[k, i] * weighted[i]
    for c in range(i + 1, length):
        total_j += V[j, c] * weighted[c]
        total_k += V[k, c] * weighted[c]
    factor_j = total_j * scale
    factor_k = total_k * scale
    for c in range(i, length):
        V[j, c] -= factor_j * V[i, c]
        V[k, c] -= factor_k * V[i, c]
    out[j, i] = factor_j
    out[k, i] = factor_k


def bierman_update(factors: FloatArray, H: FloatArray, variances: FloatArray, row: int, gains: FloatArray) -> None:
    """The factors after one scalar measurement, in place, and its gain (Bierman).

    factors (n, n): U and D before, then after. H (p, n), variances (p,): the row of this number is the measurement's,
    and the variance of its noise. gains (p, n): the gain is written into the same row.
    """
    n = factors.shape[0]
    variance = variances[row]  # of the innovation, as far as the states up to j contribute to it
    precision = 0.0  # of the states before j; there are none before the first
    for j in range(n):
        f = H[row, j]
        for i in range(j):
            f += factors[i, j] * H[row, i]
        v = factors[j, j] * f
        step = -f * precision
        before = variance
        variance += f * v
        precision = 1.0 / variance
        factors[j, j] *= before * precision
        gains[row, j] = v
        for i in range(j):
            u = factors[i, j]
            factors[i, j] = u + step * gains[row, i]
            gains[row, i] += v * u
    for i in range(n):
        gains[row, i] *= precision
