"""The least work: P H^T is formed once, S is factored, and symmetry halves the last product."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.kernels.dense import add, matmul, matmul_transposed, subtract_symmetric_product
from filters.kernels.solve import cholesky, solve_right
from filters.records import Workspace
from filters.update_forms.form import UpdateForm


def gain(P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K = P H^T S^-1 from the Cholesky factor of S = H (P H^T) + R, Eq. (9)."""
    matmul_transposed(P, H, work.PHt)
    matmul(H, work.PHt, work.S)
    add(work.S, R, work.S)  # innovation covariance
    cholesky(work.S, work.pp1)
    solve_right(work.pp1, work.PHt, K)


def covariance(
    P: FloatArray, _H: FloatArray, _R: FloatArray, K: FloatArray, out: FloatArray, work: Workspace
) -> None:
    """P_{k^+} = P - K (P H^T)^T, equal to Eq. (11)."""
    subtract_symmetric_product(P, K, work.PHt, out)


def delayed_covariance(
    Phi: FloatArray,
    _P: FloatArray,
    _H: FloatArray,
    _R: FloatArray,
    K: FloatArray,
    P_m: FloatArray,
    out: FloatArray,
    work: Workspace,
) -> None:
    """P_{m^+} = P_{m^-} - (Phi K) (Phi P H^T)^T, equal to Eq. (21)."""
    matmul(Phi, K, work.np1)
    matmul(Phi, work.PHt, work.np2)
    subtract_symmetric_product(P_m, work.np1, work.np2, out)


FORM = UpdateForm(gain, covariance, delayed_covariance)
