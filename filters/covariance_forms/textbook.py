"""The equations as they are printed, from left to right; each factor is formed where it is written."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import CovarianceForm
from filters.kernels.dense import (
    add,
    matmul,
    matmul_narrow,
    matmul_transposed,
    matmul_transposed_narrow,
    mirror,
    subtract,
)
from filters.kernels.solve import inverse
from filters.records import Workspace


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


FORM = CovarianceForm(matmul, propagation, gain, covariance, delayed_covariance)
