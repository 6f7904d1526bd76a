"""PX4's output predictor: a filter at a delayed horizon, and outputs carried to the present that are drawn after it.

The extended Kalman filter runs D = M steps behind, where the late measurement meets it. The outputs o are carried
forward by the inputs alone; in every step they are compared with the filter at its horizon, and they and the whole
buffer of them are shifted by g e + 0.1 g^2 sum(e), e = x - o at the horizon, g = step / tau: a complementary filter.
**The output is approximate**: it follows a correction with the time constant tau, where other methods jump.

PX4-Autopilot, src/modules/ekf2/EKF/output_predictor/output_predictor.cpp (correctOutputStates). There velocity and
position are drawn so, attitude by a correction of its next rotation; here all states are.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed import standard
from filters.delayed.delayed_horizon import PREDICT
from filters.delayed.delayed_horizon import predict as predict_output
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.kernels.dense import add_vectors
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Sample, new_correction, new_estimate, new_workspace
from filters.running import running
from filters.system import System

TAU_S = 0.25
"""EKF2_TAU_VEL and EKF2_TAU_POS as PX4 ships them."""

STEP_S = 0.01
"""EKF2_PREDICT_US as PX4 ships it."""

INTEGRAL = 0.1
"""Share of g^2 with which the sum of the errors counts."""


class PullGains(NamedTuple):
    """error: g; total: 0.1 g^2."""

    error: float
    total: float


def pull_gains(tau_s: float, step_s: float) -> PullGains:
    """Of the time constant and the length of a step. tau is at least a step.

    Raises:
        ValueError: one of them is not positive and finite.
    """
    for name, value in (("tau_s", tau_s), ("step_s", step_s)):
        if not 0 < value < np.inf:
            raise ValueError(f"{name}={value!r} must be a number of seconds greater than 0")
    g = step_s / max(tau_s, step_s)
    return PullGains(g, INTEGRAL * g**2)


def pull(
    x: FloatArray,
    o: FloatArray,
    total: FloatArray,
    gains: PullGains,
    total_next: FloatArray,
    shift: FloatArray,
) -> None:
    """Job: by how much the outputs are to be shifted, from filter x and output o at the horizon, all (n,).

    total: sum of the errors of the steps before; with that of this one it is total_next.
    """
    for i in range(x.shape[0]):
        error = x[i] - o[i]
        total_next[i] = total[i] + error
        shift[i] = gains.error * error + gains.total * total_next[i]


def shift_output(o: FloatArray, shift: FloatArray, o_shifted: FloatArray) -> None:
    """Job, for each of the D + 1 outputs from the horizon to the present."""
    add_vectors(o, shift, o_shifted)


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
    tau_s: float = TAU_S,
    step_s: float = STEP_S,
) -> History:
    """Filter a record of data in which the measurement of step k can be read from step m = k + M on.

    Arguments, results and errors as in `standard.run`; the estimate begins to follow the correction in step m, whatever
    L is. tau_s: time constant of the outputs; step_s: length of a step.

    Of the history x is the output, approximate; all else is of the filter behind it, which is exact.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    moves, y = problem.inputs, problem.measured.y
    gains = pull_gains(tau_s, step_s)
    predict, propagate = function_for(backend, predict_output), function_for(backend, standard.propagate)
    update_at_horizon = function_for(backend, standard.update)
    run_pull, run_shift = function_for(backend, pull), function_for(backend, shift_output)
    form = arguments_for(backend, covariance_form(update, problem.structure))
    model = arguments_for(backend, problem.system)
    work, recorder = new_workspace(system), HistoryRecorder(system)

    steps = len(moves)
    estimate, outputs, total = problem.start, [problem.start.x], np.zeros(system.states)
    for j in range(steps + M + 1):  # beyond the end for the covariances of the last steps
        if 0 < j <= steps:
            o = np.empty_like(outputs[-1])
            predict(model, j - 1, outputs[-1], moves[j - 1], o)
            outputs.append(o)
        horizon = j - M
        if horizon > 0:
            before, estimate = estimate, new_estimate(system)
            propagate(model, form, horizon - 1, before, moves[horizon - 1], estimate, work)
        if horizon >= 0 and horizon % N == 0:
            recorder.reference(*estimate)
            if j <= steps and horizon // N < len(y):
                before, estimate, correction = estimate, new_estimate(system), new_correction(system)
                update_at_horizon(model, form, horizon, y[horizon // N], before, estimate, correction, work)
                recorder.correction(correction)
        if horizon >= 0 and j <= steps:
            before_total, total, shift = total, np.empty_like(total), np.empty_like(total)
            run_pull(estimate.x, outputs[-1 - M], before_total, gains, total, shift)
            for i in range(-1 - M, 0):
                o, outputs[i] = outputs[i], np.empty_like(shift)
                run_shift(o, shift, outputs[i])
            del outputs[: -1 - M]
        if j <= steps:
            recorder.state(outputs[-1])
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


def _pull(_system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x = at.reference.x + at.correction.delta_x
    memory = np.zeros_like(x), np.zeros_like(x)
    return x, at.reference.x, at.correction.delta_x.copy(), pull_gains(TAU_S, STEP_S), *memory


def _shift_output(_system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return at.now.x, at.correction.delta_x, np.zeros_like(at.now.x)


JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PREDICT,
    *standard.JOBS,
    ("pull", pull, _pull),
    ("shift_output", shift_output, _shift_output),
)
