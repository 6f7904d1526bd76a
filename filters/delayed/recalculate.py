"""Recalculate the filter when the delayed measurement arrives: go back to k, update, and propagate to m again.

At m the state and covariance of step k, and the inputs since, are still at hand; the update of Eqs. (9) to (12) at k is
followed by M propagations. Nothing is done twice in other steps.
"""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.delayed import standard
from filters.history import History, HistoryRecorder
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Estimate, new_correction, new_estimate, new_workspace
from filters.running import running
from filters.system import System


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

    Arguments, results and errors as in `standard.run`. The correction is in the state of step m, whatever L is.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    moves, y = problem.inputs, problem.measured.y
    propagate = function_for(backend, standard.propagate)
    update_at_k = function_for(backend, standard.update)
    form, model = arguments_for(backend, covariance_form(update)), arguments_for(backend, problem.system)
    work = new_workspace(system)
    recorder = HistoryRecorder(system)

    def propagated(j: int, before: Estimate) -> Estimate:
        after = new_estimate(system)
        propagate(model, form, j, before, moves[j], after, work)
        return after

    estimate = reference = problem.start
    for j in range(len(moves) + 1):
        if j > 0:
            estimate = propagated(j - 1, estimate)
        if j % N == 0 and M < N:
            reference = estimate
            recorder.reference(*reference)

        k = j - M
        if k >= 0 and k % N == 0 and k // N < len(y):
            correction = new_correction(system)
            estimate = new_estimate(system)
            update_at_k(model, form, k, y[k // N], reference, estimate, correction, work)
            for i in range(k, j):
                estimate = propagated(i, estimate)
            recorder.correction(correction)

        if j % N == 0 and M == N:  # the measurement that has just arrived belonged to the reference before this one
            reference = estimate
            recorder.reference(*reference)
        recorder.state(estimate.x)
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


JOBS = (standard.PROPAGATE, standard.UPDATE, ("replay", *standard.PROPAGATE[1:]))
