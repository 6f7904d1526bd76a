"""Jobs of the high-rate task of the dual rate filter: the whole state, and what the low-rate task will need."""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import CovarianceForm
from filters.kernels.dense import add_vectors
from filters.records import Transition, Workspace
from filters.system import System


def hr_restart(system: System, j: int, x: FloatArray, u: FloatArray, x_next: FloatArray) -> Transition:
    """Job of step k + 1, with j = k: the state is propagated (Eq. 6); Phi and Q start anew (Eqs. 15, 17).

    They are Phi_k and Q_k themselves: nothing is copied.
    """
    system.f(j, x, u, system.parameters, x_next)  # (6)
    return Transition(system.F(j, x, u, system.parameters), system.Q(j, system.parameters))


def hr_propagate(
    system: System,
    form: CovarianceForm,
    j: int,
    x: FloatArray,
    transition: Transition,
    u: FloatArray,
    x_next: FloatArray,
    following: Transition,
    work: Workspace,
) -> Transition:
    """Job of any other step: the state from j to j + 1 (Eq. 6), Phi and Q from k -> j to k -> j + 1 (Eqs. 16, 18).

    following: memory for the result, which is returned; not that of `transition`, so two are used in turn.
    """
    system.f(j, x, u, system.parameters, x_next)  # (6)
    Phi = system.F(j, x, u, system.parameters)
    form.accumulation(Phi, transition.Phi, following.Phi)  # (16)
    form.noise(Phi, transition.Q, system.Q(j, system.parameters), following.Q, work)  # (18)
    return following


def hr_update(
    form: CovarianceForm,
    x: FloatArray,
    Phi_from_k: FloatArray,
    delta_x: FloatArray,
    x_corrected: FloatArray,
    work: Workspace,
) -> None:
    """Job of step l: the error estimate of step k is carried to l and added to the state, Eqs. (13) and (19)."""
    form.error(Phi_from_k, delta_x, work.n1)  # (13)
    add_vectors(x, work.n1, x_corrected)  # (19)
