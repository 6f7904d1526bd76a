"""Recalculate the filter when the delayed measurement arrives: go back to k, update, and propagate to m again.

At m the state and covariance of step k, and the inputs since, are still at hand; the update of Eqs. (9) to (12) at k is
followed by M propagations. Nothing is done twice in other steps. With M > N others have been taken since k: of each of
them state and covariance are kept too, and the replay passes by them, so that they are those which all that came before
has corrected.
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
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements, several=True)
    moves, y = problem.inputs, problem.measured.y
    propagate = function_for(backend, standard.propagate)
    update_at_k = function_for(backend, standard.update)
    form = arguments_for(backend, covariance_form(update, problem.structure))
    model = arguments_for(backend, problem.system)
    work = new_workspace(system)
    recorder = HistoryRecorder(system)

    def propagated(j: int, before: Estimate) -> Estimate:
        after = new_estimate(system)
        propagate(model, form, j, before, moves[j], after, work)
        return after

    estimate = problem.start
    references: dict[int, Estimate] = {}  # x_{k^-} and P_{k^-} of the measurements that have not arrived
    for j in range(len(moves) + 1):
        if j > 0:
            estimate = propagated(j - 1, estimate)
        if j % N == 0:
            references[j] = estimate

        k = j - M
        if k >= 0 and k % N == 0 and k // N < len(y):
            reference, correction = references.pop(k), new_correction(system)
            recorder.reference(*reference)
            estimate = new_estimate(system)
            update_at_k(model, form, k, y[k // N], reference, estimate, correction, work)
            recorder.correction(correction)
            for i in range(k, j):
                estimate = propagated(i, estimate)
                if (i + 1) % N == 0:
                    references[i + 1] = estimate
        recorder.state(estimate.x)
    for reference in references.values():
        recorder.reference(*reference)
    recorder.keep_known(len(y))
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


JOBS = (standard.PROPAGATE, standard.UPDATE, ("replay", *standard.PROPAGATE[1:]))
