"""Upper triangular square roots S of a covariance P = S S^T.

What such an array holds below its diagonal means nothing. Loops that go through two rows at a time do so for speed: the
sums of both are then under way at once.
"""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.u_d import UNDERFLOWN, u_d_factors


def root(P: FloatArray, out: FloatArray) -> None:
    """out = S of P (n, n), symmetric positive semidefinite, of which the lower triangle is read.

    out (n, n) or wider, then only its first n columns are written. A singular P has zero columns in S; a P that is not
    semidefinite gives nan. By way of U D U^T, whose pivots do not wait for square roots.
    """
    n = P.shape[0]
    u_d_factors(P, out)
    for j in range(n):
        out[j, j] = np.sqrt(out[j, j])
    for i in range(n):
        for j in range(i + 1, n):
            out[i, j] *= out[j, j]


def root_product(S: FloatArray, out: FloatArray) -> None:
    """out = S S^T, for S (n, n), out (n, n)."""
    n = S.shape[0]
    for i in range(n):
        for j in range(i, n):
            total = S[i, j] * S[j, j]
            for k in range(j + 1, n):
                total += S[i, k] * S[j, k]
            out[i, j] = out[j, i] = total


def append_root_product(Phi: FloatArray, S: FloatArray, V: FloatArray) -> None:
    """V = [S', Phi S], for S' given in the first n columns of V (n, 2n), Phi (n, n), S (n, n)."""
    n = Phi.shape[0]
    for j in range(n):
        for i in range(n):
            total = Phi[i, 0] * S[0, j]
            for k in range(1, j + 1):
                total += Phi[i, k] * S[k, j]
            V[i, n + j] = total


def householder(V: FloatArray, out: FloatArray) -> None:
    """out = S of V V^T, by reflections of the rows of V (Bierman).

    V (n, 2n): upper triangular in its first n columns, which are not read below the diagonal; overwritten. out (n, n).
    The reflection that leaves of row i only its element n + i concerns n + 1 columns: it starts from column i, before
    which the triangle is zero, and ends there, for the columns behind have been dealt with.
    """
    n = V.shape[0]
    for i in range(n - 1, -1, -1):
        end = n + i
        pivot = V[i, end]
        total = pivot * pivot
        for c in range(i, end):
            total += V[i, c] * V[i, c]
        if total > UNDERFLOWN:
            length = np.sqrt(total)
            if pivot < 0.0:
                length = -length
            scale = -1.0 / length
            reflect = 1.0 / (pivot + length)
            out[i, i] = -length
            for j in range(i - 1, 0, -2):
                _reflect_two(V, i, j, j - 1, scale, reflect, out)
            if i % 2 == 1:
                _reflect(V, i, 0, scale, reflect, out)
        else:
            for j in range(i + 1):
                out[j, i] = V[j, end]


def _reflect(V: FloatArray, i: int, j: int, scale: float, reflect: float, out: FloatArray) -> None:
    """Reflect row j of V as row i is reflected; keep its element n + i, which is not touched again."""
    end = V.shape[0] + i
    total = V[i, end] * V[j, end]
    for c in range(i, end):
        total += V[i, c] * V[j, c]
    kept = total * scale
    factor = (V[j, end] - kept) * reflect
    for c in range(i, end):
        V[j, c] -= factor * V[i, c]
    out[j, i] = kept


def _reflect_two(V: FloatArray, i: int, j: int, k: int, scale: float, reflect: float, out: FloatArray) -> None:
    """`_reflect` for the rows j and k."""
    end = V.shape[0] + i
    total_j = V[i, end] * V[j, end]
    total_k = V[i, end] * V[k, end]
    for c in range(i, end):
        total_j += V[i, c] * V[j, c]
        total_k += V[i, c] * V[k, c]
    kept_j = total_j * scale
    kept_k = total_k * scale
    factor_j = (V[j, end] - kept_j) * reflect
    factor_k = (V[k, end] - kept_k) * reflect
    for c in range(i, end):
        V[j, c] -= factor_j * V[i, c]
        V[k, c] -= factor_k * V[i, c]
    out[j, i] = kept_j
    out[k, i] = kept_k


def carlson_update(S: FloatArray, H: FloatArray, variances: FloatArray, row: int, gains: FloatArray) -> None:
    """The root after one scalar measurement, in place, and its gain.

    S (n, n): the root before, then after. H (p, n), variances (p,): the row of this number is the measurement's, and
    the variance of its noise. gains (p, n): the gain is written into the same row. N. A. Carlson, Fast triangular
    formulation of the square root filter, AIAA Journal 11 (1973), 1259-1265.
    """
    n = S.shape[0]
    variance = variances[row]  # of the innovation, as far as the states up to j contribute to it
    deviation = np.sqrt(variance)
    for j in range(n):
        f = S[0, j] * H[row, 0]
        for i in range(1, j + 1):
            f += S[i, j] * H[row, i]
        before = variance
        deviation_before = deviation
        variance += f * f
        deviation = np.sqrt(variance)
        scale = 1.0 / (deviation_before * deviation)
        shrink = before * scale
        step = f * scale
        for i in range(j):
            s = S[i, j]
            S[i, j] = shrink * s - step * gains[row, i]
            gains[row, i] += f * s
        gains[row, j] = f * S[j, j]
        S[j, j] *= shrink
    scale = 1.0 / variance
    for i in range(n):
        gains[row, i] *= scale
