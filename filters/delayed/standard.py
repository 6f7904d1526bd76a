"""The error-state Kalman filter without delay, Eqs. (6) to (12): what the other methods are measured against."""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.update import update_covariance, update_error
from filters.history import History
from filters.jobs import JobKind
from filters.kernels.dense import (
    add_vectors,
    copy,
    copy_vector,
    store,
    store_vector,
)
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import (
    Correction,
    Estimate,
    Sample,
    Workspace,
    new_correction,
    new_estimate,
    new_workspace,
)
from filters.running import running
from filters.system import System


def propagate(
    system: System,
    form: CovarianceForm,
    j: int,
    before: Estimate,
    u: FloatArray,
    after: Estimate,
    work: Workspace,
) -> FloatArray:
    """Job: the estimate at j becomes that at j + 1, Eqs. (6) and (8). Returns Phi_j."""
    system.f(j, before.x, u, system.parameters, after.x)  # (6)
    Phi = system.F(j, before.x, u, system.parameters)
    form.propagation(Phi, before.P, system.Q(j, system.parameters), after.P, work)  # (8)
    return Phi


def update(
    system: System,
    form: CovarianceForm,
    k: int,
    y: FloatArray,
    before: Estimate,
    after: Estimate,
    correction: Correction,
    work: Workspace,
) -> None:
    """Job: the estimate before the measurement y of step k becomes that after it, Eqs. (9) to (12)."""
    update_covariance(system, form, k, before, correction.K, after.P, work)
    update_error(system, k, y, before.x, correction)
    add_vectors(before.x, correction.delta_x, after.x)  # (12)


def filter_all(
    system: System,
    form: CovarianceForm,
    N: int,
    predicted: Estimate,
    inputs: FloatArray,
    measurements: FloatArray,
    history: History,
    corrected: Estimate,
    correction: Correction,
    work: Workspace,
) -> None:
    """The whole filter as one kernel: all steps, with an update at k = 0, N, 2N, ... while there are measurements.

    Shapes as in `run`. `predicted` holds the start and is overwritten; the result is in `history`.
    """
    for j in range(len(inputs) + 1):
        if j > 0:
            propagate(system, form, j - 1, corrected, inputs[j - 1], predicted, work)
        cycle = j // N
        if j % N == 0:
            store(predicted.P, history.P_reference, cycle)
        if j % N == 0 and cycle < len(measurements):
            update(system, form, j, measurements[cycle], predicted, corrected, correction, work)
            store_vector(correction.z, history.innovations, cycle)
            store(correction.K, history.gains, cycle)
        else:
            copy_vector(predicted.x, corrected.x)
            copy(predicted.P, corrected.P)
        store_vector(corrected.x, history.x, j)


@running("system")
def run(
    system: System,
    N: int,
    M: int,
    L: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Measurements,
    *,
    update: CovarianceFormName = "textbook",
    backend: BackendName = "reference",
) -> History:
    """Filter a record of data as if measurements came without delay: used in the step in which they are taken.

    N, M, L: steps between measurements, delay, feedback; this method checks M and L but has no use for them.
    x0 (n,), P0 (n, n): estimate and covariance at step 0, before its measurement.
    inputs (steps, m): row j takes the state from j to j + 1.
    measurements (cycles, p): row c is taken at k = cN; where there are fewer than steps // N + 1, the last are missing,
        and more are refused. None in place of a row, or of a number in it, says that it was lost: the filter uses the
        rest, as if H and R had no other rows. Of what was lost the innovation is nan and the gain zero.
    update: the covariance form. All lose digits where R is tiny beside H P H^T, or measurements nearly the same: P may
        cease to be a covariance (textbook, short), or the gain be far from the best one (joseph). A run that has been
        spoilt so is refused. Most is borne by the factors of P that `multirate_gain.run` can keep, for n = 1 the same
        filter.

    Raises:
        ValueError: N, M, L or a shape is wrong, a name is unknown, or a number is not finite; the system gives one that
            is not, or a Q or R that is no covariance; or rounding has been too much for a covariance or a gain, see
            `breakdown` and `rounding`. The step is named, and what to do.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements, several=True)
    steps, cycles = len(problem.inputs), len(problem.inputs) // N + 1
    updates = min(cycles, len(problem.measured.y))
    n, p = system.states, system.measurements
    history = History(
        np.empty((steps + 1, n)), np.empty((cycles, n, n)), np.empty((updates, p)), np.empty((updates, n, p))
    )
    function_for(backend, filter_all)(
        arguments_for(backend, problem.system),
        arguments_for(backend, covariance_form(update, problem.structure)),
        N,
        problem.start,
        problem.inputs,
        problem.measured.y,
        history,
        new_estimate(system),
        new_correction(system),
        new_workspace(system),
    )
    x_reference = history.x[::N].copy()
    x_reference[:updates] -= np.einsum("cnp,cp->cn", history.gains, history.innovations)  # what was added (10, 12)
    return check_history(history, x_reference, problem, N, sturdier(update), backend)


def _propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, form, at.m, at.now, at.u, new_estimate(system), new_workspace(system)


def _update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    after, correction = new_estimate(system), new_correction(system)
    return system, form, at.k, at.y, at.reference, after, correction, new_workspace(system)


PROPAGATE: JobKind[CovarianceForm] = ("propagate", propagate, _propagate)
UPDATE: JobKind[CovarianceForm] = ("update", update, _update)
JOBS = (PROPAGATE, UPDATE)
