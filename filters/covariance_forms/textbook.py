"""The equations as they are printed, from left to right; each factor is formed where it is written."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import dense_form
from filters.kernels.dense import (
    add,
    add_vectors,
    matmul,
    matmul_narrow,
    matmul_transposed,
    matmul_transposed_narrow,
    matvec,
    mirror,
    subtract,
)
from filters.kernels.solve import inverse
from filters.records import Estimate, Workspace


def propagation(Phi: FloatArray, P: FloatArray, Q: FloatArray, out: FloatArray, work: Workspace) -> None:
    """Phi P Phi^T + Q, Eqs. (8), (14) and (18)."""
    matmul(Phi, P, work.nn1)
    matmul_transposed(work.nn1, Phi, out, work.nn2)
    add(out, Q, out)
    mirror(out)


def gain(P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K = P H^T [H P H^T + R]^-1, Eq. (9)."""
    matmul_transposed_narrow(P, H, work.PHt)
    matmul(H, P, work.HP)
    matmul_transposed_narrow(work.HP, H, work.S)
    add(work.S, R, work.S)  # innovation covariance
    inverse(work.S, work.S_inverse, work.pp1)
    matmul_narrow(work.PHt, work.S_inverse, K)


def covariance(P: FloatArray, H: FloatArray, _R: FloatArray, K: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P_{k^+} = [I - K H] P, Eq. (11)."""
    matmul(K, H, work.nn1)
    subtract(work.I, work.nn1, work.nn1)
    matmul(work.nn1, P, out)
    mirror(out)


def delayed_covariance(
    Phi: FloatArray,
    P: FloatArray,
    H: FloatArray,
    _R: FloatArray,
    K: FloatArray,
    P_m: FloatArray,
    out: FloatArray,
    work: Workspace,
) -> None:
    """P_{m^+} = P_{m^-} - Phi K H P Phi^T, Eq. (21)."""
    matmul_narrow(Phi, K, work.np1)
    matmul(work.np1, H, work.nn1)
    matmul(work.nn1, P, work.nn2)
    matmul_transposed(work.nn2, Phi, work.nn1, work.nn3)
    subtract(P_m, work.nn1, out)
    mirror(out)


def cross(P: FloatArray, H: FloatArray, W: FloatArray, _work: Workspace) -> None:
    """P H^T."""
    matmul_transposed_narrow(P, H, W)


def factor(S: FloatArray, out: FloatArray, work: Workspace) -> None:
    """S^-1."""
    inverse(S, out, work.pp1)


def cross_share(C: FloatArray, S_inverse: FloatArray, G: FloatArray, _work: Workspace) -> None:
    """C S^-1."""
    matmul_narrow(C, S_inverse, G)


def cross_gain(W: FloatArray, S: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K = W S^-1."""
    inverse(S, work.S_inverse, work.pp1)
    matmul_narrow(W, work.S_inverse, K)


def cross_update(
    before: Estimate,
    W: FloatArray,
    _S: FloatArray,
    S_inverse: FloatArray,
    z: FloatArray,
    after: Estimate,
    work: Workspace,
) -> None:
    """x + K z and P - K W^T with K = W S^-1."""
    matmul_narrow(W, S_inverse, work.np1)
    matvec(work.np1, z, work.n1)
    add_vectors(before.x, work.n1, after.x)
    matmul_transposed(work.np1, W, work.nn1, work.pn1)
    subtract(before.P, work.nn1, after.P)
    mirror(after.P)


FORM = dense_form(
    matmul, propagation, gain, covariance, delayed_covariance, cross, factor, cross_share, cross_gain, cross_update
)
