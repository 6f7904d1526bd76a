"""The measurement update of a factored covariance, one decorrelated measurement after the other."""

from __future__ import annotations

from collections.abc import Callable

from filters.arrays import FloatArray
from filters.factored.form import Update
from filters.factored.workspace import FactoredWorkspace
from filters.kernels.dense import copy, transpose
from filters.kernels.sequential import (
    join_gain,
    solve_unit_lower,
    solve_unit_lower_transposed,
    unit_lower_factors,
)


def one_by_one(scalar_update: Callable[[FloatArray, FloatArray, FloatArray, int, FloatArray], None]) -> Update:
    """An update made of a scalar one, scalar_update(factors, H, variances, row, gains)."""

    def update(
        factors: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, out: FloatArray, work: FactoredWorkspace
    ) -> None:
        """K and the factors of [I - K H] P, Eqs. (9) and (11)."""
        unit_lower_factors(R, work.L, work.variances)
        solve_unit_lower(work.L, H, work.decorrelated_H)
        copy(factors, out)
        for row in range(H.shape[0]):
            scalar_update(out, work.decorrelated_H, work.variances, row, work.gains)
            join_gain(work.decorrelated_H, row, work.gains)
        solve_unit_lower_transposed(work.L, work.gains, work.gains)
        transpose(work.gains, K)

    return update
