"""The multirate gain: a measurement in every step, covariance and gain only in every n-th.

"Optimal covariance filtering", a patent, Eq. (1): K(t, dT) = K(t, n dT) / n. The gain
computed over n dT, as if there were one measurement in that time, is divided among the n measurements.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName
from filters.covariances import check_measurement_noise
from filters.delayed.update import update_error
from filters.factored import FactoredFormName, factored_form
from filters.factored.form import FactoredForm
from filters.factored.workspace import FactoredWorkspace, new_factored_workspace
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.kernels.dense import add_vectors
from filters.measured import Measurements
from filters.problem import check_multirate_problem, check_system
from filters.records import Correction, Sample, new_correction
from filters.rounding import check_rounding
from filters.running import running
from filters.system import System
from filters.systems.coarse import over
from filters.systems.lossy import lossy
from filters.systems.shaped import shaped
from filters.systems.trial import first_input, try_functions


def state_update(
    system: System, j: int, x: FloatArray, u: FloatArray, y: FloatArray, correction: Correction, x_next: FloatArray
) -> None:
    """Job of every step, at high rate: x_{j-1} becomes x_j with the measurement y of step j.

    The state is propagated by the model, then corrected. The correction is the patent's Eq. (2), which has no
    propagation. correction: its K (n, p) is given, z (p,) and delta_x (n,) are filled.
    """
    state_predict(system, j, x, u, x_next)
    state_correct(system, j, y, correction, x_next)


def state_predict(system: System, j: int, x: FloatArray, u: FloatArray, x_next: FloatArray) -> None:
    """The half of `state_update` that needs no measurement: x_{j-1} becomes x_{j^-}."""
    system.f(j - 1, x, u, system.parameters, x_next)


def state_correct(system: System, j: int, y: FloatArray, correction: Correction, x: FloatArray) -> None:
    """The other half of `state_update`: x_{j^-} becomes x_j, in place, by the patent's Eq. (2)."""
    update_error(system, j, y, x, correction)
    add_vectors(x, correction.delta_x, x)


def covariance_gain(
    coarse: System,
    form: FactoredForm,
    k: int,
    n: int,
    x_last: FloatArray,
    u: FloatArray,
    x: FloatArray,
    factors: FloatArray,
    predicted: FloatArray,
    K: FloatArray,
    posterior: FloatArray,
    work: FactoredWorkspace,
) -> None:
    """Job of every n-th step k, at low rate: the gain to be used with each measurement, Eq. (1).

    coarse: the system over n steps. x_last, u: the estimate and the input of step k - n. x: x_{k^-}.
    factors, predicted, posterior: those of P_{(k-n)^+}, which is given, and of P_{k^-} and P_{k^+}, which are filled.
    """
    Phi = coarse.F(k - n, x_last, u, coarse.parameters)
    form.propagation(Phi, factors, coarse.Q(k - n, coarse.parameters), predicted, work)
    divided_gain(coarse, form, k, n, x, predicted, K, posterior, work)


def divided_gain(
    coarse: System,
    form: FactoredForm,
    k: int,
    n: int,
    x: FloatArray,
    predicted: FloatArray,
    K: FloatArray,
    posterior: FloatArray,
    work: FactoredWorkspace,
) -> None:
    """What is left of `covariance_gain` when P_{k^-} is known: K(k, n dT) / n, Eq. (1), and P_{k^+}."""
    form.update(predicted, coarse.H(k, x, coarse.parameters), coarse.R(k, coarse.parameters), K, posterior, work)
    share = 1.0 / n
    for i in range(K.shape[0]):
        for j in range(K.shape[1]):
            K[i, j] *= share


def cycle_in_use(j: int, n: int, L: int) -> int:
    """Which gain step j uses: c for that of k = c n, in use from step k + L on. That of k = 0 is known beforehand."""
    return max(j - L, 0) // n


@running("system")
def run(
    system: System,
    n: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Measurements,
    *,
    coarse: System | None = None,
    form: FactoredFormName = "conventional",
    L: int = 0,
    update: CovarianceFormName = "textbook",
    backend: BackendName = "reference",
) -> History:
    """Filter a record of data with gains that are computed every n-th step.

    n: steps between gains. L: the gain of k is in use from step k + L on, 0 <= L <= n; before step L, that of k = 0.
    x0 (states,), P0 (states, states): estimate and covariance at step 0, before its measurement.
    inputs (steps, inputs): row j takes the state from j to j + 1.
    measurements (steps + 1, measurements): row j is used in step j. None in place of a row, or of a number in it, says
        that it was lost: it corrects nothing. A gain is computed with the numbers of which at least one came in its n
        steps, k to k + n - 1; for n = 1 that is the standard filter.
    coarse: the system over n steps, `over(system, n)` if not given, which is known of a `linear_system` whose Phi and
        Q do not change; its functions get the steps of `system`, and estimate and input at the start of an interval.
    form: how the covariance is kept. update: the covariance form by which the conventional one multiplies.

    In the result, P_reference is what the gains of k = 0, n, 2n, ... were computed from, innovations and gains have one
    row per step, and gains are those used: K(t, n dT) / n.

    Raises:
        ValueError: n, L or a shape is wrong, a name is unknown, R of some k is not positive definite, a number is not
            finite, or coarse is not given and `over` refuses to make it; and as `standard.run`.
    """
    problem = check_multirate_problem(system, n, L, x0, P0, inputs, measurements)
    moves, (y, present) = problem.inputs, problem.measured
    coarse = over(system, n) if coarse is None else coarse
    check_system("coarse", coarse)
    if coarse[:3] != system[:3]:
        raise ValueError(
            f"coarse has {coarse.states} states, {coarse.inputs} inputs and {coarse.measurements} measurements, the "
            f"system {system.states}, {system.inputs} and {system.measurements}; they must be the same"
        )
    try_functions(coarse, problem.start.x, first_input(moves))
    coarse = lossy(shaped(coarse), n, np.logical_or.reduceat(present, range(0, len(y), n)))
    for k in range(0, len(y), n):
        check_measurement_noise(coarse.R(k, coarse.parameters), k)
    kept = factored_form(form, update)
    run_predict = function_for(backend, state_predict)
    run_correct = function_for(backend, state_correct)
    run_covariance_gain = function_for(backend, covariance_gain)
    run_divided_gain = function_for(backend, divided_gain)
    model, coarse_model, bound = (arguments_for(backend, value) for value in (problem.system, coarse, kept))
    work = new_factored_workspace(system)
    recorder = HistoryRecorder(system)

    x = x_last = problem.start.x
    factors = np.empty((system.states, system.states))
    gains: list[FloatArray] = []
    for j in range(len(y)):
        x_before, x = x, x.copy()
        if j > 0:
            run_predict(model, j, x_before, moves[j - 1], x)
        if j % n == 0:
            predicted, posterior, P = np.empty_like(factors), np.empty_like(factors), np.empty_like(factors)
            K = np.empty((system.states, system.measurements))
            if j == 0:
                kept.factor(problem.start.P, predicted)
                run_divided_gain(coarse_model, bound, j, n, x, predicted, K, posterior, work)
            else:
                u = moves[j - n]
                run_covariance_gain(coarse_model, bound, j, n, x_last, u, x, factors, predicted, K, posterior, work)
            kept.covariance(predicted, P)
            recorder.reference(x.copy(), P)
            factors = posterior
            gains.append(K)
        correction = new_correction(system)._replace(K=np.where(present[j], gains[cycle_in_use(j, n, L)], 0.0))
        run_correct(model, j, y[j], correction, x)
        if j % n == 0:
            x_last = x
        recorder.correction(correction)
        recorder.state(x)
    remedy = sturdier(update, form)
    history = check_history(recorder.history(), None, problem, n, remedy, backend, coarse)
    check_rounding(coarse, history.x, recorder.references(), n * np.array(gains), moves, n, n, remedy, backend)
    return history


def _state_update(system: System, _form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    correction = new_correction(system)._replace(K=at.correction.K)
    return system, at.m + 1, at.now.x, at.u, at.y, correction, np.zeros_like(at.now.x)


def _covariance_gain(system: System, form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    """From k to m, with the system itself in place of the coarse one, for that has the same shapes."""
    P = at.P_posterior
    factors, predicted, posterior, K = (
        np.zeros_like(P),
        np.zeros_like(P),
        np.zeros_like(P),
        np.zeros_like(at.correction.K),
    )
    form.factor(P, factors)
    x_last = at.reference.x + at.correction.delta_x
    work = new_factored_workspace(system)
    return system, form, at.m, at.m - at.k, x_last, at.u, at.now.x, factors, predicted, K, posterior, work


JOBS: tuple[JobKind[FactoredForm], ...] = (
    ("state_update", state_update, _state_update),
    ("covariance_gain", covariance_gain, _covariance_gain),
)
