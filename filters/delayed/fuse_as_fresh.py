"""A late measurement used as if it had just been taken: what many run, and the baseline of all others.

The covariances are those of a filter without delay; the estimate is not: it is drawn to where things were M steps ago.
The estimates are wrong by design wherever what is measured moves.
"""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.delayed import standard
from filters.history import History, HistoryRecorder
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import new_correction, new_estimate, new_workspace
from filters.running import running
from filters.system import System
from filters.systems.lossy import lossy


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
    """Filter a record of data in which the measurement of k arrives at m = k + M and is taken for one of m.

    Arguments, results and errors as in `standard.run`, which this is for M = 0; h, H and R are those of step m. The
    correction is in the state of step m, whatever L is. P_reference is what the filter believes at k, before an update.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    moves, (y, present) = problem.inputs, problem.measured
    propagate, update_at_m = function_for(backend, standard.propagate), function_for(backend, standard.update)
    form, work = arguments_for(backend, covariance_form(update, problem.structure)), new_workspace(system)
    unheard = np.ones((M // N, system.measurements), dtype=np.bool_)  # M = N: the first to arrive is used in cycle 1
    model = arguments_for(backend, lossy(problem.without_losses, N, np.concatenate([unheard, present])))
    recorder = HistoryRecorder(system)

    estimate = problem.start
    for j in range(len(moves) + 1):
        if j > 0:
            before, estimate = estimate, new_estimate(system)
            propagate(model, form, j - 1, before, moves[j - 1], estimate, work)
        if j % N == 0:
            recorder.reference(*estimate)
        k = j - M
        if k >= 0 and k % N == 0 and k // N < len(y):
            before, estimate, correction = estimate, new_estimate(system), new_correction(system)
            update_at_m(model, form, j, y[k // N], before, estimate, correction, work)
            recorder.correction(correction)
        recorder.state(estimate.x)
    at_k = recorder.references().x if M == 0 else None  # what comes later is no update of step k
    return check_history(recorder.history(), at_k, problem, N, sturdier(update), backend)


JOBS = standard.JOBS
