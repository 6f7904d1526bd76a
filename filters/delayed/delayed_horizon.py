"""The delayed horizon: the covariances never see a late measurement, and the estimate is replayed to the present.

What PX4 and ArduPilot fly, but for the way to the present, which is exact here. The high-rate (HR) task propagates the
state alone. When the measurement of k arrives at m, the low-rate (LR) task updates estimate and covariance of k and
replays the state over the steps since, to l; then it takes the covariance over the N steps to the next k. From l on the
estimate is the standard filter's.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed import standard
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Estimate, Sample, Workspace, new_correction, new_estimate, new_workspace
from filters.running import running
from filters.system import System


def predict(system: System, j: int, x: FloatArray, u: FloatArray, x_next: FloatArray) -> None:
    """Job of every step, and of each one that is replayed: the state from j to j + 1, Eq. (6)."""
    system.f(j, x, u, system.parameters, x_next)


def propagate_covariance(
    system: System,
    form: CovarianceForm,
    j: int,
    before: Estimate,
    u: FloatArray,
    P_next: FloatArray,
    work: Workspace,
) -> None:
    """Job: P of step j, whose estimate is known by now, becomes that of j + 1, Eq. (8)."""
    Phi = system.F(j, before.x, u, system.parameters)
    form.propagation(Phi, before.P, system.Q(j, system.parameters), P_next, work)


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
    """Filter a record of data in which the measurement of step k can be read from m = k + M on; land at l = k + L.

    Arguments, results and errors as in `standard.run`; M < L <= N, where l = k + N comes before the next x_{k^-}.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    if L <= M:
        raise ValueError(
            f"L={L} must be > M={M}: what is replayed cannot be in the state of the step in which the measurement "
            f"arrives"
        )
    moves, y = problem.inputs, problem.measured.y
    run_predict = function_for(backend, predict)
    run_propagate = function_for(backend, propagate_covariance)
    run_update = function_for(backend, standard.update)
    form = arguments_for(backend, covariance_form(update, problem.structure))
    model = arguments_for(backend, problem.system)
    work, recorder = new_workspace(system), HistoryRecorder(system)

    def predicted(j: int, x: FloatArray) -> FloatArray:
        x_next = np.empty_like(x)
        run_predict(model, j, x, moves[j], x_next)
        return x_next

    reference, P = problem.start, problem.start.P  # P_{k^+} of the last k, P_{k^-} until its measurement is used
    path = [problem.start.x]  # x of each step from the last k on
    to_replay: FloatArray | None = None
    for j in range(len(moves) + 1):
        if j > 0:
            path.append(predicted(j - 1, path[-1]))
        if to_replay is not None and j % N == L % N:
            path, to_replay = [to_replay], None
            for i in range(j - L, j):
                path.append(predicted(i, path[-1]))
        if j % N == 0:
            for i, x in enumerate(path[:-1]):
                before, P = P, np.empty_like(P)
                run_propagate(model, form, j - N + i, Estimate(x, before), moves[j - N + i], P, work)
            reference, path = Estimate(path[-1], P), path[-1:]
            recorder.reference(*reference)
        if j % N == M and j // N < len(y):
            corrected, correction = new_estimate(system), new_correction(system)
            run_update(model, form, j - M, y[j // N], reference, corrected, correction, work)
            to_replay, P = corrected
            recorder.correction(correction)
        recorder.state(path[-1])
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


def _predict(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, at.m, at.now.x, at.u, np.zeros_like(at.now.x)


def _propagate_covariance(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, form, at.m, at.now, at.u, np.zeros_like(at.now.P), new_workspace(system)


PREDICT: JobKind[CovarianceForm] = ("predict", predict, _predict)
JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PREDICT,
    standard.UPDATE,
    ("replay", *PREDICT[1:]),
    ("propagate_covariance", propagate_covariance, _propagate_covariance),
)
