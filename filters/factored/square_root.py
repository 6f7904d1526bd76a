"""The covariance as P = S S^T with S upper triangular: Householder's time update, Carlson's measurement update."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.factored.form import FactoredForm
from filters.factored.one_by_one import one_by_one
from filters.factored.workspace import FactoredWorkspace
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


FORM = FactoredForm(root, root_product, propagation, one_by_one(carlson_update))
