"""The dual rate filter, Eqs. (13) to (19): a high-rate (HR) and a low-rate (LR) task side by side.

The tasks exchange only what Fig. 2 names. HR to LR at k: Phi_{(k-N)->k} and Q_{(k-N)->k}, and x_{k^-}, from which the
innovation is formed (Eq. 5). LR to HR at l: delta_x_{k^+}.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.choice import check_choice
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.high_rate import hr_propagate, hr_restart, hr_update
from filters.delayed.low_rate import lr_correct, lr_gain, lr_propagate, lr_update
from filters.delayed.low_rate_noise import (
    NOISE_METHODS,
    HalvedTransition,
    LowRateNoise,
    NoiseMethod,
    hr_propagate_euler,
    hr_propagate_sum,
    lr_propagate_euler,
)
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Correction, Estimate, Sample, Transition, new_correction, new_transition, new_workspace
from filters.running import running
from filters.system import System

GainTime: TypeAlias = Literal["at-update", "precomputed"]
Feedback: TypeAlias = Literal["next-step", "same-step"]


class Message(NamedTuple):
    """From HR to LR at k. transition: over the steps k - N .. k, None at k = 0."""

    k: int
    x: FloatArray
    transition: Any


class HighRateTask:
    """The whole state x_j (n,) and the transition from the last k to j."""

    def __init__(
        self,
        system: System,
        N: int,
        x0: FloatArray,
        noise: NoiseMethod,
        form: CovarianceForm,
        backend: BackendName,
    ) -> None:
        self._size = system
        self._N = N
        self._noise = noise
        self._work = new_workspace(system)
        self._system = arguments_for(backend, system)
        self._form = arguments_for(backend, form)
        self._restart = function_for(backend, hr_restart)
        self._propagate = function_for(backend, noise.propagate)
        self._update = function_for(backend, hr_update)
        self._transition: Any = None
        self.x = np.array(x0, dtype=np.float64)

    def step(self, j: int, u: FloatArray) -> None:
        """From j to j + 1."""
        x, self.x = self.x, np.empty_like(self.x)
        if j % self._N == 0:
            start = self._restart(self._system, j, x, u, self.x)
            self._transition = self._noise.start(start, j, self._N)
        else:
            following = self._noise.new(self._size)
            self._transition = self._propagate(
                self._system, self._form, j, x, self._transition, u, self.x, following, self._work
            )

    def message(self, k: int) -> Message:
        """What LR gets at k."""
        return Message(k, self.x, self._transition)

    def correct(self, L: int, delta_x: FloatArray) -> None:
        """Take in the error estimate of k = l - L."""
        Phi_from_k = self._transition.Phi if L > 0 else np.eye(len(self.x))
        x, self.x = self.x, np.empty_like(self.x)
        self._update(x, Phi_from_k, delta_x, self.x, self._work)


class LowRateTask:
    """The error estimate in the making, and P (n, n): P_{k^+} of the last k, P_{k^-} until its measurement is used."""

    def __init__(
        self,
        system: System,
        P0: FloatArray,
        noise: NoiseMethod,
        form: CovarianceForm,
        gain: GainTime,
        backend: BackendName,
    ) -> None:
        self._size = system
        self._gain_time = gain
        self._work = new_workspace(system)
        self._system = arguments_for(backend, system)
        self._form = arguments_for(backend, form)
        self._propagate = function_for(backend, noise.lr_propagate)
        self._update = function_for(backend, lr_update)
        self._gain = function_for(backend, lr_gain)
        self._correct = function_for(backend, lr_correct)
        self.P = np.array(P0, dtype=np.float64)
        self._k = 0
        self._reference = Estimate(np.empty(0), self.P)
        self._correction = new_correction(system)

    def propagate(self, message: Message, *, measured: bool) -> FloatArray:
        """Go to the next k, at which a measurement is taken or is missing. Returns P_{k^-}."""
        P = self.P
        if message.transition is not None:
            P = np.empty_like(P)
            self._propagate(self._form, self.P, message.transition, P, self._work)
        self._k, self._reference = message.k, Estimate(message.x, P)
        self.P = P  # stays so if the measurement is missing
        self._correction = new_correction(self._size)
        if measured and self._gain_time == "precomputed":
            self.P = np.empty_like(P)
            self._gain(self._system, self._form, self._k, self._reference, self.P, self._correction, self._work)
        return P

    def update(self, y: FloatArray) -> Correction:
        """Use the measurement of the last k."""
        if self._gain_time == "precomputed":
            self._correct(self._system, self._k, y, self._reference, self._correction)
        else:
            self.P = np.empty_like(self.P)
            self._update(self._system, self._form, self._k, y, self._reference, self.P, self._correction, self._work)
        return self._correction


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
    feedback: "next-step" corrects at the start of step l, M < L <= N, where l = k + N comes before the next x_{k^-} is
        taken; "same-step" corrects at the end of step l, M <= L < N.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    moves, y = problem.inputs, problem.measured.y
    check_choice("low_rate_noise", low_rate_noise, ("exact", "sum", "euler"))
    check_choice("gain", gain, ("at-update", "precomputed"))
    check_choice("feedback", feedback, ("next-step", "same-step"))
    _check_feedback_step(N, M, L, feedback)
    noise, form = NOISE_METHODS[low_rate_noise], covariance_form(update)
    high_rate = HighRateTask(problem.system, N, problem.start.x, noise, form, backend)
    low_rate = LowRateTask(problem.system, problem.start.P, noise, form, gain, backend)
    recorder = HistoryRecorder(system)

    correction: Correction | None = None
    for j in range(len(moves) + 1):
        if j > 0:
            high_rate.step(j - 1, moves[j - 1])
        if feedback == "next-step" and correction is not None and j % N == L % N:
            high_rate.correct(L, correction.delta_x)
            correction = None
        if j % N == 0:
            measured = j // N < len(y)
            recorder.reference(high_rate.x, low_rate.propagate(high_rate.message(j), measured=measured))
        if j % N == M and j // N < len(y):  # m < k + N, so the cycle is still that of k
            correction = low_rate.update(y[j // N])
            recorder.correction(correction)
        if feedback == "same-step" and correction is not None and j % N == L:
            high_rate.correct(L, correction.delta_x)
            correction = None
        recorder.state(high_rate.x)
    exact = recorder.references().x if low_rate_noise == "exact" else None
    return check_history(recorder.history(), exact, problem, N, sturdier(update), backend)


def _check_feedback_step(N: int, M: int, L: int, feedback: Feedback) -> None:
    if feedback == "next-step" and L <= M:
        raise ValueError(
            f"L={L} must be > M={M}: the correction cannot land in the step in which the measurement arrives "
            f"(same-step feedback allows L = M)"
        )
    if feedback == "same-step" and L >= N:
        raise ValueError(f"L={L} must be < N={N} with same-step feedback: the correction lands during step l")


def _hr_restart(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, at.m, at.now.x, at.u, np.empty_like(at.now.x)


def _hr_propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x_next, following = np.empty_like(at.now.x), new_transition(system)
    return system, form, at.m, at.now.x, at.transition, at.u, x_next, following, new_workspace(system)


def _hr_propagate_euler(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x_next, following = np.empty_like(at.now.x), _halved(new_transition(system), at)
    return system, form, at.m, at.now.x, _halved(at.transition, at), at.u, x_next, following, new_workspace(system)


def _hr_update(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return at.now.x, at.transition.Phi, at.correction.delta_x, np.empty_like(at.now.x), new_workspace(system)


def _lr_propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return form, at.P_posterior, at.transition, np.empty_like(at.P_posterior), new_workspace(system)


def _lr_propagate_euler(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_next = np.empty_like(at.P_posterior)
    return form, at.P_posterior, _halved(at.transition, at), P_next, new_workspace(system)


def _lr_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.empty_like(at.P_posterior), new_correction(system)
    return system, form, at.k, at.y, at.reference, P_posterior, correction, new_workspace(system)


def _lr_gain(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.empty_like(at.P_posterior), new_correction(system)
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
