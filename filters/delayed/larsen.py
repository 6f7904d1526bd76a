"""Larsen's measurement extrapolation: the correction of step k is carried to m by Phi_{k->m}, Eqs. (20) and (21)."""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.larsen_in_flight import compensate, correct, gain, run_in_flight
from filters.delayed.standard import PROPAGATE, propagate
from filters.delayed.standard import update as update_at_once
from filters.delayed.update import update_error
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.kernels.dense import add_vectors
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Correction, Estimate, Sample, Workspace, new_correction, new_estimate, new_workspace
from filters.running import running
from filters.system import System


def propagate_accumulate(
    system: System,
    form: CovarianceForm,
    j: int,
    before: Estimate,
    Phi_from_k: FloatArray,
    u: FloatArray,
    after: Estimate,
    Phi_next: FloatArray,
    work: Workspace,
) -> None:
    """Job: the estimate at j becomes that at j + 1, and Phi_{k->j} becomes Phi_{k->j+1}, Eqs. (6), (8) and (16)."""
    Phi = propagate(system, form, j, before, u, after, work)
    form.accumulation(Phi, Phi_from_k, Phi_next)  # (16)


def extrapolated_update(
    system: System,
    form: CovarianceForm,
    k: int,
    y: FloatArray,
    reference: Estimate,
    Phi_from_k: FloatArray,
    before: Estimate,
    after: Estimate,
    correction: Correction,
    work: Workspace,
) -> None:
    """Job: the estimate at m before the measurement y of step k becomes that after it, Eqs. (9), (20) and (21).

    reference: x_{k^-}, P_{k^-}, as they were at k; Phi_from_k: Phi_{k->m}; before: x_{m^-}, P_{m^-}.
    """
    H = system.H(k, reference.x, system.parameters)
    R = system.R(k, system.parameters)
    form.gain(reference.P, H, R, correction.K, work)
    update_error(system, k, y, reference.x, correction)
    form.error(Phi_from_k, correction.delta_x, work.n1)
    add_vectors(before.x, work.n1, after.x)  # (20)
    form.delayed_covariance(Phi_from_k, reference.P, H, R, correction.K, before.P, after.P, work)


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
    """Filter a record of data in which the measurement of step k can be read from step m = k + M on.

    Arguments, results and errors as in `standard.run`. The correction is in the state of step m, whatever L is. With
    M > N there are several on their way at once, see `larsen_in_flight`.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements, several=True)
    moves, y = problem.inputs, problem.measured.y
    recorder = HistoryRecorder(system)
    if M > N:
        run_in_flight(problem, N, M, covariance_form(update, problem.structure), backend, recorder)
        return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)
    run_propagate = function_for(backend, propagate)
    run_propagate_accumulate = function_for(backend, propagate_accumulate)
    run_update_at_once = function_for(backend, update_at_once)
    run_update = function_for(backend, extrapolated_update)
    form = arguments_for(backend, covariance_form(update, problem.structure))
    model = arguments_for(backend, problem.system)
    work = new_workspace(system)

    estimate = reference = problem.start
    Phi_from_k = np.eye(system.states)
    for j in range(len(moves) + 1):
        if j > 0:
            i, before, estimate = j - 1, estimate, new_estimate(system)
            if i % N == 0:
                Phi_from_k = run_propagate(model, form, i, before, moves[i], estimate, work)  # the product so far, (15)
            elif i % N < M:
                Phi_before, Phi_from_k = Phi_from_k, np.empty_like(Phi_from_k)
                run_propagate_accumulate(model, form, i, before, Phi_before, moves[i], estimate, Phi_from_k, work)
            else:
                run_propagate(model, form, i, before, moves[i], estimate, work)

        if j % N == 0 and M < N:
            reference = estimate
            recorder.reference(*reference)

        k = j - M
        if k >= 0 and k % N == 0 and k // N < len(y):
            before, estimate, correction = estimate, new_estimate(system), new_correction(system)
            if M == 0:
                run_update_at_once(model, form, k, y[k // N], before, estimate, correction, work)
            else:
                run_update(model, form, k, y[k // N], reference, Phi_from_k, before, estimate, correction, work)
            recorder.correction(correction)

        if j % N == 0 and M == N:  # the measurement that has just arrived belonged to the reference before this one
            reference = estimate
            recorder.reference(*reference)
        recorder.state(estimate.x)
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


def _propagate_accumulate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    after, Phi_next = new_estimate(system), np.zeros_like(at.transition.Phi)
    return system, form, at.m, at.now, at.transition.Phi, at.u, after, Phi_next, new_workspace(system)


def _extrapolated_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    after, correction, work = new_estimate(system), new_correction(system), new_workspace(system)
    return system, form, at.k, at.y, at.reference, at.transition.Phi, at.now, after, correction, work


def _gain(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.zeros_like(at.P_posterior), new_correction(system)
    return system, form, at.k, at.reference, P_posterior, correction, new_workspace(system)


def _correct(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    correction, x_corrected = new_correction(system), np.zeros_like(at.now.x)
    correction.K[:] = at.correction.K
    transition, work = at.transition, new_workspace(system)
    return system, form, at.k, at.y, at.reference.x, transition.Phi, at.now.x, x_corrected, correction, work


def _compensate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return form, at.now.x, at.transition.Phi, at.correction.delta_x, np.zeros_like(at.now.x), new_workspace(system)


JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PROPAGATE,
    ("propagate_accumulate", propagate_accumulate, _propagate_accumulate),
    ("update", extrapolated_update, _extrapolated_update),
    ("gain", gain, _gain),
    ("correct", correct, _correct),
    ("compensate", compensate, _compensate),
)
