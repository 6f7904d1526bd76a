"""The measurement update of the error state, at the step in which the measurement was taken."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import CovarianceForm
from filters.kernels.dense import matvec, subtract_vectors
from filters.records import Correction, Estimate, Workspace
from filters.system import System


def update_covariance(
    system: System,
    form: CovarianceForm,
    k: int,
    reference: Estimate,
    K: FloatArray,
    P_posterior: FloatArray,
    work: Workspace,
) -> None:
    """H, R, the gain K (Eq. 9) and P_{k^+} (Eq. 11): all that can be done before the measurement is available."""
    H = system.H(k, reference.x, system.parameters)
    R = system.R(k, system.parameters)
    form.gain(reference.P, H, R, K, work)
    form.covariance(reference.P, H, R, K, P_posterior, work)


def update_error(system: System, k: int, y: FloatArray, x_reference: FloatArray, correction: Correction) -> None:
    """delta_x_{k^+} = K z with the innovation z = y - h(x_{k^-}), from a gain that correction already holds.

    Eqs. (5) and (10) for delta_x_{k^-} = 0, to which every reset brings it.
    """
    system.h(k, x_reference, system.parameters, correction.z)
    subtract_vectors(y, correction.z, correction.z)
    matvec(correction.K, correction.z, correction.delta_x)
