"""The equations as they are printed, from left to right; each factor is formed where it is written."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.kernels.dense import add, identity_minus, matmul, matmul_transposed, subtract
from filters.kernels.solve import inverse
from filters.records import Workspace
from filters.update_forms.form import UpdateForm


def gain(P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K = P H^T [H P H^T + R]^-1, Eq. (9)."""
    matmul_transposed(P, H, work.PHt)
    matmul(H, P, work.HP)
    matmul_transposed(work.HP, H, work.S)
    add(work.S, R, work.S)  # innovation covariance
    inverse(work.S, work.S_inverse, work.pp1)
    matmul(work.PHt, work.S_inverse, K)


def covariance(
    P: FloatArray, H: FloatArray, _R: FloatArray, K: FloatArray, out: FloatArray, work: Workspace
) -> None:
    """P_{k^+} = [I - K H] P, Eq. (11)."""
    matmul(K, H, work.nn1)
    identity_minus(work.nn1, work.nn1)
    matmul(work.nn1, P, out)


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
    matmul(Phi, K, work.np1)
    matmul(work.np1, H, work.nn1)
    matmul(work.nn1, P, work.nn2)
    matmul_transposed(work.nn2, Phi, work.nn1)
    subtract(P_m, work.nn1, out)


FORM = UpdateForm(gain, covariance, delayed_covariance)
