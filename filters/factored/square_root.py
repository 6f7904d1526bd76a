"""The covariance as P = S S^T with S upper triangular: Householder's time update, Carlson's measurement update."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.factored.form import FactoredForm
from filters.factored.workspace import FactoredWorkspace
from filters.kernels.dense import copy, transpose
from filters.kernels.sequential import join_gain, solve_lower, solve_lower_transposed
from filters.kernels.solve import cholesky
from filters.kernels.triangular import (
    append_root_product,
    carlson_update,
    householder,
    root,
    root_product,
)


def propagation(Phi: FloatArray, S: FloatArray, Q: FloatArray, out: FloatArray, work: FactoredWorkspace) -> None:
    """The root of Phi S S^T Phi^T + Q, Eq. (8), from [Q^1/2, Phi S]."""
    root(Q, work.V)
    append_root_product(Phi, S, work.V)
    householder(work.V, out)


def update(
    S: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, out: FloatArray, work: FactoredWorkspace
) -> None:
    """K and the root of [I - K H] P, Eqs. (9) and (11), one whitened measurement after the other."""
    cholesky(R, work.C)
    solve_lower(work.C, H, work.whitened_H)
    copy(S, out)
    for row in range(H.shape[0]):
        carlson_update(out, work.whitened_H, row, work.gains)
        join_gain(work.whitened_H, row, work.gains)
    solve_lower_transposed(work.C, work.gains, work.gains)
    transpose(work.gains, K)


FORM = FactoredForm(root, root_product, propagation, update)
