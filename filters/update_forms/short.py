"""The least work: H P is formed once and serves as (P H^T)^T too, S is factored, and Eq. (11) needs one thin product.

Products and solves run along the rows of (p, n) matrices, which are longer than those of (n, p) ones.
"""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.kernels.dense import (
    add,
    matmul,
    matmul_transposed_narrow,
    subtract_product_of_transposed,
    transpose,
)
from filters.kernels.solve import cholesky, solve_cholesky
from filters.records import Workspace
from filters.update_forms.form import UpdateForm


def gain(P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K^T = S^-1 (H P), Eq. (9) for symmetric P, from the Cholesky factor of S. Leaves H P and, in pn1, K^T."""
    matmul(H, P, work.HP)
    matmul_transposed_narrow(work.HP, H, work.S)
    add(work.S, R, work.S)  # innovation covariance
    cholesky(work.S, work.pp1)
    solve_cholesky(work.pp1, work.HP, work.pn1)
    transpose(work.pn1, K)


def covariance(P: FloatArray, _H: FloatArray, _R: FloatArray, _K: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P_{k^+} = P - (H P)^T K^T, equal to Eq. (11)."""
    subtract_product_of_transposed(P, work.HP, work.pn1, out)


def delayed_covariance(
    Phi: FloatArray,
    _P: FloatArray,
    _H: FloatArray,
    _R: FloatArray,
    _K: FloatArray,
    P_m: FloatArray,
    out: FloatArray,
    work: Workspace,
) -> None:
    """P_{m^+} = P_{m^-} - (H P Phi^T)^T (K^T Phi^T), equal to Eq. (21)."""
    transpose(Phi, work.nn1)
    matmul(work.HP, work.nn1, work.pn2)
    matmul(work.pn1, work.nn1, work.HP)
    subtract_product_of_transposed(P_m, work.pn2, work.HP, out)


FORM = UpdateForm(gain, covariance, delayed_covariance)
