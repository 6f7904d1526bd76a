"""The dual rate filter, Eqs. (13) to (19): a high-rate (HR) and a low-rate (LR) task side by side.

The tasks exchange only what Fig. 2 names. HR to LR at k: Phi_{(k-N)->k} and Q_{(k-N)->k}, and x_{k^-}, from which the
innovation is formed (Eq. 5). LR to HR at l: delta_x_{k^+}. Where l comes after the next k, or m does, several
corrections are on their way at once: see `high_rate_task` and `low_rate_task`.
"""

from __future__ import annotations

from collections import deque
from typing import Any, Literal, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.breakdown import check_history, sturdier
from filters.choice import check_choice
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.high_rate import hr_propagate, hr_restart, hr_update
from filters.delayed.high_rate_task import HighRateTask
from filters.delayed.low_rate import lr_correct, lr_gain, lr_propagate, lr_update
from filters.delayed.low_rate_noise import (
    NOISE_METHODS,
    HalvedTransition,
    LowRateNoise,
    hr_propagate_euler,
    hr_propagate_sum,
    lr_propagate_euler,
)
from filters.delayed.low_rate_task import LowRateTask
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Correction, Sample, Transition, new_correction, new_transition, new_workspace
from filters.running import running
from filters.system import System

GainTime: TypeAlias = Literal["at-update", "precomputed"]
Feedback: TypeAlias = Literal["next-step", "same-step"]


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
    low_rate_noise: LowRateNoise = "exact",
    gain: GainTime = "at-update",
    feedback: Feedback = "next-step",
    backend: BackendName = "reference",
) -> History:
    """Filter a record of data in which the measurement of k can be read from m = k + M on; correct at l = k + L.

    Other arguments, results and errors as in `standard.run`.
    low_rate_noise: "exact" (Eq. 18), or an approximation, "sum" (Eq. 23) or "euler" (Eq. 24).
    gain: "at-update", or "precomputed" before the measurement arrives (Sec. III.D); the numbers are the same.
    feedback: "next-step" corrects at the start of step l, M < L, where l = k + N comes before the next x_{k^-} is
        taken; "same-step" corrects at the end of step l, M <= L.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements, several=True)
    moves, y = problem.inputs, problem.measured.y
    check_choice("low_rate_noise", low_rate_noise, ("exact", "sum", "euler"))
    check_choice("gain", gain, ("at-update", "precomputed"))
    check_choice("feedback", feedback, ("next-step", "same-step"))
    next_step = feedback == "next-step"
    if next_step and L <= M:
        raise ValueError(
            f"L={L} must be > M={M}: the correction cannot land in the step in which the measurement arrives "
            f"(same-step feedback allows L = M)"
        )
    noise, form = NOISE_METHODS[low_rate_noise], covariance_form(update, problem.structure)
    recorder = HistoryRecorder(system)
    high_rate = HighRateTask(problem.system, N, L, problem.start.x, noise, form, backend)
    low_rate = LowRateTask(
        problem.system,
        problem.start.P,
        noise,
        form,
        backend,
        early=gain == "precomputed",
        in_flight=(L - next_step) // N,
        known=recorder.reference,
    )

    def measured(k: int) -> bool:
        return k >= 0 and k % N == 0 and k // N < len(y)

    corrections: deque[Correction] = deque()  # that have not landed
    for j in range(len(moves) + 1):
        if j > 0:
            high_rate.step(j - 1, moves[j - 1])
        if next_step and measured(j - L):
            high_rate.correct(j - L, L, corrections.popleft().delta_x)
        if j % N == 0:
            low_rate.receive(high_rate.message(j), measured=measured(j))
        if measured(j - M):
            correction = low_rate.update(y[(j - M) // N])
            corrections.append(correction)
            recorder.correction(correction)
        if not next_step and measured(j - L):
            high_rate.correct(j - L, L, corrections.popleft().delta_x)
        recorder.state(high_rate.x)
    recorder.keep_known(len(y))
    exact = recorder.references().x if low_rate_noise == "exact" else None
    return check_history(recorder.history(), exact, problem, N, sturdier(update), backend)


def _hr_restart(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, at.m, at.now.x, at.u, np.zeros_like(at.now.x)


def _hr_propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x_next, following = np.zeros_like(at.now.x), new_transition(system)
    return system, form, at.m, at.now.x, at.transition, at.u, x_next, following, new_workspace(system)


def _hr_propagate_euler(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x_next, following = np.zeros_like(at.now.x), _halved(new_transition(system), at)
    return system, form, at.m, at.now.x, _halved(at.transition, at), at.u, x_next, following, new_workspace(system)


def _hr_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return form, at.now.x, at.transition.Phi, at.correction.delta_x, np.zeros_like(at.now.x), new_workspace(system)


def _lr_propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return form, at.P_posterior, at.transition, np.zeros_like(at.P_posterior), new_workspace(system)


def _lr_propagate_euler(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_next = np.zeros_like(at.P_posterior)
    return form, at.P_posterior, _halved(at.transition, at), P_next, new_workspace(system)


def _lr_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.zeros_like(at.P_posterior), new_correction(system)
    return system, form, at.k, at.y, at.reference, P_posterior, correction, new_workspace(system)


def _lr_gain(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.zeros_like(at.P_posterior), new_correction(system)
    return system, form, at.k, at.reference, P_posterior, correction, new_workspace(system)


def _lr_correct(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    correction = new_correction(system)
    correction.K[:] = at.correction.K
    return system, at.k, at.y, at.reference, correction


def _halved(transition: Transition, at: Sample) -> HalvedTransition:
    return HalvedTransition(transition.Phi, transition.Q.copy(), transition.Q.copy(), at.m)


JOBS: tuple[JobKind[CovarianceForm], ...] = (
    ("hr_restart", hr_restart, _hr_restart),
    ("hr_propagate", hr_propagate, _hr_propagate),
    ("hr_propagate_sum", hr_propagate_sum, _hr_propagate),
    ("hr_propagate_euler", hr_propagate_euler, _hr_propagate_euler),
    ("hr_update", hr_update, _hr_update),
    ("lr_propagate", lr_propagate, _lr_propagate),
    ("lr_propagate_euler", lr_propagate_euler, _lr_propagate_euler),
    ("lr_update", lr_update, _lr_update),
    ("lr_gain", lr_gain, _lr_gain),
    ("lr_correct", lr_correct, _lr_correct),
)
