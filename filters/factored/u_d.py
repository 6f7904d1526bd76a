"""The covariance as P = U D U^T: Thornton's time update, Bierman's measurement update; no square root of a state's."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.factored.form import FactoredForm
from filters.factored.one_by_one import one_by_one
from filters.factored.workspace import FactoredWorkspace
from filters.kernels.u_d import append_unit_product, bierman_update, gram_schmidt, u_d_factors, u_d_product


def propagation(Phi: FloatArray, factors: FloatArray, Q: FloatArray, out: FloatArray, work: FactoredWorkspace) -> None:
    """U and D of Phi U D U^T Phi^T + Q, Eq. (8)."""
    u_d_factors(Q, work.V)
    append_unit_product(Phi, factors, work.V, work.weights)
    gram_schmidt(work.V, work.weights, out, work.weighted)


FORM = FactoredForm(u_d_factors, u_d_product, propagation, one_by_one(bierman_update))
