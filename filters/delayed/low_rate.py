"""Jobs of the low-rate task of the dual rate filter: the error state and the covariances, at measurement times only."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.update import update_covariance, update_error
from filters.records import Correction, Estimate, Transition, Workspace
from filters.system import System


def lr_propagate(
    form: CovarianceForm, P: FloatArray, transition: Transition, P_next: FloatArray, work: Workspace
) -> None:
    """Job: P_{(k-N)^+} becomes P_{k^-}, Eq. (14)."""
    form.cycle(transition.Phi, P, transition.Q, P_next, work)


def lr_update(
    system: System,
    form: CovarianceForm,
    k: int,
    y: FloatArray,
    reference: Estimate,
    P_posterior: FloatArray,
    correction: Correction,
    work: Workspace,
) -> None:
    """Job: from x_{k^-}, P_{k^-} and the measurement y of step k, delta_x_{k^+} and P_{k^+}, Eqs. (9) to (11)."""
    lr_gain(system, form, k, reference, P_posterior, correction, work)
    lr_correct(system, k, y, reference, correction)


def lr_gain(
    system: System,
    form: CovarianceForm,
    k: int,
    reference: Estimate,
    P_posterior: FloatArray,
    correction: Correction,
    work: Workspace,
) -> None:
    """Job: the part of `lr_update` that needs no measurement (Sec. III.D): H, R, the gain K and P_{k^+}."""
    update_covariance(system, form, k, reference, correction.K, P_posterior, work)


def lr_correct(system: System, k: int, y: FloatArray, reference: Estimate, correction: Correction) -> None:
    """Job: the part of `lr_update` that needs the measurement: innovation and error estimate, Eqs. (5) and (10)."""
    update_error(system, k, y, reference.x, correction)
