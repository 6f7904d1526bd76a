"""Joseph's form: the covariance stays symmetric and positive definite for any gain, at twice the cost."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import dense_form
from filters.covariance_forms.textbook import cross, cross_gain, cross_share, factor, gain, propagation
from filters.kernels.dense import (
    add,
    add_vectors,
    matmul,
    matmul_narrow,
    matmul_transposed,
    matvec,
    mirror,
    subtract,
)
from filters.records import Estimate, Workspace


def covariance(P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P_{k^+} = [I - K H] P [I - K H]^T + K R K^T, equal to Eq. (11) for the optimal K."""
    matmul(K, H, work.nn1)
    subtract(work.I, work.nn1, work.nn1)
    matmul(work.nn1, P, work.nn2)
    matmul_transposed(work.nn2, work.nn1, out, work.nn3)
    matmul_narrow(K, R, work.np1)
    matmul_transposed(work.np1, K, work.nn2, work.pn1)
    add(out, work.nn2, out)
    mirror(out)


def delayed_covariance(
    Phi: FloatArray,
    P: FloatArray,
    H: FloatArray,
    R: FloatArray,
    K: FloatArray,
    P_m: FloatArray,
    out: FloatArray,
    work: Workspace,
) -> None:
    """P_{m^+} = P_{m^-} - Phi (P_{k^-} - P_{k^+}) Phi^T, equal to Eq. (21), with P_{k^+} in Joseph's form."""
    covariance(P, H, R, K, out, work)
    subtract(P, out, work.nn1)
    matmul(Phi, work.nn1, work.nn2)
    matmul_transposed(work.nn2, Phi, work.nn1, work.nn3)
    subtract(P_m, work.nn1, out)
    mirror(out)


def cross_update(
    before: Estimate,
    W: FloatArray,
    S: FloatArray,
    S_inverse: FloatArray,
    z: FloatArray,
    after: Estimate,
    work: Workspace,
) -> None:
    """x + K z and [I, -K] C [I, -K]^T with K = W S^-1 and C = [[P, W], [W^T, S]], that of state and innovation.

    The latter is P - K W^T - (W - K S) K^T: the last term is zero but for rounding of K.
    """
    matmul_narrow(W, S_inverse, work.np1)
    matvec(work.np1, z, work.n1)
    add_vectors(before.x, work.n1, after.x)
    matmul_narrow(work.np1, S, work.PHt)
    subtract(W, work.PHt, work.PHt)
    matmul_transposed(work.np1, W, work.nn1, work.pn1)
    matmul_transposed(work.PHt, work.np1, work.nn2, work.pn1)
    add(work.nn1, work.nn2, work.nn1)
    subtract(before.P, work.nn1, after.P)
    mirror(after.P)


FORM = dense_form(
    matmul, propagation, gain, covariance, delayed_covariance, cross, factor, cross_share, cross_gain, cross_update
)
