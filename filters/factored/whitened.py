"""The measurement update of a factored covariance, one whitened measurement after the other."""

from __future__ import annotations

from collections.abc import Callable

from filters.arrays import FloatArray
from filters.factored.form import Update
from filters.factored.workspace import FactoredWorkspace
from filters.kernels.dense import copy, transpose
from filters.kernels.sequential import join_gain, solve_lower, solve_lower_transposed
from filters.kernels.solve import cholesky


def whitened(scalar_update: Callable[[FloatArray, FloatArray, int, FloatArray], None]) -> Update:
    """An update made of a scalar one, scalar_update(factors, H, row, gains), for noise of variance 1."""

    def update(
        factors: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, out: FloatArray, work: FactoredWorkspace
    ) -> None:
        """K and the factors of [I - K H] P, Eqs. (9) and (11)."""
        cholesky(R, work.C)
        solve_lower(work.C, H, work.whitened_H)
        copy(factors, out)
        for row in range(H.shape[0]):
            scalar_update(out, work.whitened_H, row, work.gains)
            join_gain(work.whitened_H, row, work.gains)
        solve_lower_transposed(work.C, work.gains, work.gains)
        transpose(work.gains, K)

    return update
