"""The covariance as P = U D U^T: Thornton's time update, Bierman's measurement update; no square root of a state's."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.factored.form import FactoredForm
from filters.factored.workspace import FactoredWorkspace
from filters.kernels.dense import copy, transpose
from filters.kernels.sequential import join_gain, solve_lower, solve_lower_transposed
from filters.kernels.solve import cholesky
from filters.kernels.u_d import append_unit_product, bierman_update, gram_schmidt, u_d_factors, u_d_product


def propagation(Phi: FloatArray, factors: FloatArray, Q: FloatArray, out: FloatArray, work: FactoredWorkspace) -> None:
    """U and D of Phi U D U^T Phi^T + Q, Eq. (8)."""
    u_d_factors(Q, work.V)
    append_unit_product(Phi, factors, work.V, work.weights)
    gram_schmidt(work.V, work.weights, out, work.weighted)


def update(
    factors: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, out: FloatArray, work: FactoredWorkspace
) -> None:
    """K and the U and D of [I - K H] P, Eqs. (9) and (11), one whitened measurement after the other."""
    cholesky(R, work.C)
    solve_lower(work.C, H, work.whitened_H)
    copy(factors, out)
    for row in range(H.shape[0]):
        bierman_update(out, work.whitened_H, row, work.gains)
        join_gain(work.whitened_H, row, work.gains)
    solve_lower_transposed(work.C, work.gains, work.gains)
    transpose(work.gains, K)


FORM = FactoredForm(u_d_factors, u_d_product, propagation, update)
