"""The covariance as it is: what the factors are measured against."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS, CovarianceFormName
from filters.covariance_forms.form import CovarianceForm
from filters.factored.form import FactoredForm
from filters.factored.workspace import FactoredWorkspace
from filters.kernels.dense import copy


def conventional(form: CovarianceForm) -> FactoredForm:
    """The covariance itself, propagated and updated as a covariance form does it."""
    form_propagation, form_gain, form_covariance = form.propagation, form.gain, form.covariance

    def propagation(Phi: FloatArray, P: FloatArray, Q: FloatArray, out: FloatArray, work: FactoredWorkspace) -> None:
        """Phi P Phi^T + Q, Eq. (8)."""
        form_propagation(Phi, P, Q, out, work.dense)

    def update(
        P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, out: FloatArray, work: FactoredWorkspace
    ) -> None:
        """K and [I - K H] P, Eqs. (9) and (11)."""
        form_gain(P, H, R, K, work.dense)
        form_covariance(P, H, R, K, out, work.dense)

    return FactoredForm(copy, copy, propagation, update)


FORMS: dict[CovarianceFormName, FactoredForm] = {name: conventional(form) for name, form in COVARIANCE_FORMS.items()}
