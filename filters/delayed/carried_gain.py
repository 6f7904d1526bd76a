"""The carried gain: the covariance does not wait for a measurement that is under way, only the estimate does.

That a measurement is being taken is known at k (Sec. III.A, assumption 1), and so are its gain and the covariance that
it will leave, for they depend on no data. So P is updated at k, and what is carried to m is B = Phi_{k->j} K_k (n x p).
At m the estimate alone is corrected by B z. Any number of measurements may be on their way:

    taken at k:     K, P_{k^+} (Eqs. 9, 11), yhat = h(x_{k^-}), B = K; for each g on its way, C_g = H_k B_g (p x p)
    each step:      B becomes Phi B
    f arrives:      z_f = y_f - yhat_f;  x + B_f z_f;  for each later one that knows C_f, yhat + C_f z_f

The last of these is what h(x_{k^-}) would have been with f in it, so that every z is the innovation of the filter
without delay. The error of x has, at any time, the covariance P + sum of B S B^T over what is on its way.

As in `clone` the HR job of step m corrects the estimate that the step before has left, and propagates it then.
"""

from __future__ import annotations

from collections import deque
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.clone import CARRY
from filters.delayed.cloned import carry, compensate
from filters.delayed.flights import steps
from filters.delayed.standard import PROPAGATE, propagate
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.kernels.dense import add_vectors, copy, matvec, subtract_vectors
from filters.measured import Measurements
from filters.problem import Problem, check_problem
from filters.records import Correction, Estimate, Sample, Workspace, new_correction, new_workspace
from filters.running import running
from filters.system import System


class Flight(NamedTuple):
    """A measurement of step k on its way, as it is taken. expected (p,): h(x_{k^-}); K (n, p): its gain; S (p, p)."""

    expected: FloatArray
    K: FloatArray
    S: FloatArray


def new_flight(system: System) -> Flight:
    """Memory for one, zero."""
    n, p = system.states, system.measurements
    return Flight(np.zeros(p), np.zeros((n, p)), np.zeros((p, p)))


def take(
    system: System,
    form: CovarianceForm,
    k: int,
    reference: Estimate,
    P_posterior: FloatArray,
    flight: Flight,
    work: Workspace,
) -> FloatArray:
    """Job of step k: gain, P_{k^+} (Eqs. 9, 11) and what is expected, from x_{k^-}, P_{k^-}. Returns H_k."""
    H = system.H(k, reference.x, system.parameters)
    R = system.R(k, system.parameters)
    form.gain(reference.P, H, R, flight.K, work)
    copy(work.S, flight.S)
    form.covariance(reference.P, H, R, flight.K, P_posterior, work)
    system.h(k, reference.x, system.parameters, flight.expected)
    return H


def couple(form: CovarianceForm, H: FloatArray, B: FloatArray, C: FloatArray) -> None:
    """Job of step k, for each measurement that is on its way there, with its B: what of it will be missed at k."""
    form.expectation(H, B, C)


def land(
    y: FloatArray, expected: FloatArray, B: FloatArray, x: FloatArray, x_corrected: FloatArray, z: FloatArray
) -> None:
    """Job of step m, done before it propagates: the measurement y of step k corrects x of step m - 1.

    B (n, p): as carried to there. z (p,): the innovation is written there.
    """
    subtract_vectors(y, expected, z)
    matvec(B, z, x_corrected)
    add_vectors(x, x_corrected, x_corrected)


class OnItsWay:
    """A measurement taken at k whose correction has yet to land.

    B (n, p): its gain, carried; expected (p,): with all that has landed since k; missed: C by the k of the measurements
    that were on their way at k and still are.
    """

    def __init__(self, k: int, flight: Flight) -> None:
        self.k = k
        self.flight = flight
        self.B = flight.K
        self.expected = flight.expected
        self.missed: dict[int, FloatArray] = {}


class CarriedGain:
    """The filter, step by step. x (n,): the estimate; P (n, n): its covariance once all on its way has landed."""

    def __init__(self, problem: Problem, size: System, update: CovarianceFormName, backend: BackendName) -> None:
        self._size = size
        self._system = arguments_for(backend, problem.system)
        self._form = arguments_for(backend, covariance_form(update, problem.structure))
        self._propagate, self._take = function_for(backend, propagate), function_for(backend, take)
        self._couple, self._carry = function_for(backend, couple), function_for(backend, carry)
        self._land, self._compensate = function_for(backend, land), function_for(backend, compensate)
        self._work = new_workspace(size)
        self.x, self.P = problem.start
        self._flights: deque[OnItsWay] = deque()

    def propagate(self, j: int, u: FloatArray) -> None:
        """From j to j + 1."""
        before, after = Estimate(self.x, self.P), Estimate(np.empty_like(self.x), np.empty_like(self.P))
        Phi = self._propagate(self._system, self._form, j, before, u, after, self._work)
        self.x, self.P = after
        for flight in self._flights:
            B, flight.B = flight.B, np.empty_like(flight.B)
            self._carry(self._form, Phi, B, flight.B)

    def take(self, k: int) -> None:
        """A measurement is taken."""
        taken, reference = OnItsWay(k, new_flight(self._size)), Estimate(self.x, self.P)
        self.P = np.empty_like(self.P)
        H = self._take(self._system, self._form, k, reference, self.P, taken.flight, self._work)
        for earlier in self._flights:
            C = taken.missed[earlier.k] = np.empty_like(taken.flight.S)
            self._couple(self._form, H, earlier.B, C)
        self._flights.append(taken)

    def land(self, y: FloatArray) -> Correction:
        """The first of those on their way arrives. Returns innovation, gain and error at its k."""
        landed, correction = self._flights.popleft(), new_correction(self._size)
        x, self.x = self.x, np.empty_like(self.x)
        self._land(y, landed.expected, landed.B, x, self.x, correction.z)
        for later in self._flights:
            if landed.k in later.missed:
                expected, later.expected = later.expected, np.empty_like(later.expected)
                self._compensate(expected, later.missed.pop(landed.k), correction.z, later.expected)
        return correction._replace(K=landed.flight.K, delta_x=landed.flight.K @ correction.z)

    def reference(self) -> Estimate:
        """The estimate, and its covariance once all on its way has landed; for the record."""
        return Estimate(self.x, self.P)

    def error_covariance(self) -> FloatArray:
        """That of x, now: P + sum of B S B^T."""
        return sum((flight.B @ flight.flight.S @ flight.B.T for flight in self._flights), start=self.P)


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

    Arguments, results and errors as in `standard.run`, but that M may be more than N: measurements are then taken
    before one arrives. The correction is in the state of step m, whatever L is. That a measurement is lost is known
    when it should be taken.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements, several=True)
    recorder = HistoryRecorder(system)
    for filtered in steps(CarriedGain(problem, system, update, backend), problem, N, M, recorder):
        recorder.state(filtered.x)
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


@running("system")
def error_covariances(
    system: System,
    N: int,
    M: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Measurements,
    *,
    update: CovarianceFormName = "textbook",
    backend: BackendName = "reference",
) -> FloatArray:
    """The covariance (steps + 1, n, n) of the error of `run`'s estimate at the end of every step: P + sum of B S B^T.

    It counts what is on its way as not yet known, and is exact for a linear system. Arguments and errors as in `run`.
    """
    problem = check_problem(system, N, M, M, x0, P0, inputs, measurements, several=True)
    recorder, covariances = HistoryRecorder(system), []
    for filtered in steps(CarriedGain(problem, system, update, backend), problem, N, M, recorder):
        recorder.state(filtered.x)
        covariances.append(filtered.error_covariance())
    check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)
    return np.array(covariances)


def _take(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, work = np.zeros_like(at.P_posterior), new_workspace(system)
    return system, form, at.k, at.reference, P_posterior, new_flight(system), work


def _couple(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    C = np.zeros((system.measurements, system.measurements))
    return form, system.H(at.m, at.now.x, system.parameters), _carried(at), C


def _land(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    expected = at.y - at.correction.z
    return at.y, expected, _carried(at), at.now.x, np.zeros(system.states), np.zeros(system.measurements)


def _compensate(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    C = system.H(at.m, at.now.x, system.parameters) @ _carried(at)
    return at.y - at.correction.z, C, at.correction.z, np.zeros(system.measurements)


def _carried(at: Sample) -> FloatArray:
    B: FloatArray = at.transition.Phi @ at.correction.K
    return B


JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PROPAGATE,
    ("update", take, _take),
    CARRY,
    ("land", land, _land),
    ("couple", couple, _couple),
    ("compensate", compensate, _compensate),
)
