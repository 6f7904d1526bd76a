"""Larsen's method where others are measured before one arrives, M > N: one product Phi_{k->j} for each on its way.

Covariances depend on no data. So at k itself the gain K_k and P_{k^+} are computed, and from then on the covariance
counts what has been measured, landed or not: it is that of the filter without delay. At m only the estimate is
corrected, Eqs. (10), (20). The state x_{k^-} from which its innovation is formed must hold all that was measured before
k; of that, some landed after k. So each that lands also corrects the x_{k'^-} of those that were measured since and
have not landed, by the product that it had at k':

    x_{k'^-} += Phi_{k->k'} delta_x_k        which takes H Phi_{k->k'} delta_x_k from the innovation of k'.

For a linear system the innovations are those of the filter without delay. (Were the covariance corrected at m too, as
it is where M <= N, so it would have to be at every k'.)
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.high_rate import hr_update
from filters.delayed.low_rate import lr_gain
from filters.delayed.standard import propagate
from filters.delayed.update import update_error
from filters.history import HistoryRecorder
from filters.kernels.dense import add_vectors
from filters.problem import Problem
from filters.records import Correction, Estimate, Workspace, new_correction, new_estimate, new_workspace
from filters.system import System

gain = lr_gain
"""Job at k: H, R, the gain K_k and P_{k^+}, Eqs. (9), (11)."""

compensate = hr_update
"""Job at m, for each that is on its way since: x_{k'^-} += Phi_{k->k'} delta_x_k, as in Eqs. (13), (19)."""


def correct(
    system: System,
    form: CovarianceForm,
    k: int,
    y: FloatArray,
    x_reference: FloatArray,
    Phi_from_k: FloatArray,
    x: FloatArray,
    x_corrected: FloatArray,
    correction: Correction,
    work: Workspace,
) -> None:
    """Job at m: the state before the measurement y of step k becomes that after it, Eqs. (5), (10) and (20).

    correction: holds the gain of k. x_reference: x_{k^-}, with all that was measured before. Phi_from_k: Phi_{k->m}.
    """
    update_error(system, k, y, x_reference, correction)
    form.error(Phi_from_k, correction.delta_x, work.n1)
    add_vectors(x, work.n1, x_corrected)  # (20)


@dataclass
class Flight:
    """A measurement on its way. reference: x_{k^-}, P_{k^-}; correction: holds K_k; Phi: Phi_{k->j} of now.

    Phi_at: what Phi was at the references taken since, of which those that have not landed are the next flights.
    """

    k: int
    reference: Estimate
    correction: Correction
    Phi: FloatArray
    Phi_at: list[FloatArray] = field(default_factory=list)


def run_in_flight(
    problem: Problem, N: int, M: int, form: CovarianceForm, backend: BackendName, recorder: HistoryRecorder
) -> None:
    """Fill the recorder with a run of M > N."""
    system, moves, y = problem.system, problem.inputs, problem.measured.y
    run_propagate, run_product = function_for(backend, propagate), function_for(backend, form.accumulation)
    run_gain, run_correct = function_for(backend, gain), function_for(backend, correct)
    run_compensate = function_for(backend, compensate)
    bound, model = arguments_for(backend, form), arguments_for(backend, system)
    work = new_workspace(system)

    flights: deque[Flight] = deque()
    after_the_last: list[Estimate] = []  # references at which nothing was measured
    estimate = problem.start
    for j in range(len(moves) + 1):
        if j > 0:
            i, before, estimate = j - 1, estimate, new_estimate(system)
            Phi = run_propagate(model, bound, i, before, moves[i], estimate, work)
            for flight in flights:
                Phi_before, flight.Phi = flight.Phi, np.empty_like(flight.Phi)
                if flight.k == i:
                    flight.Phi[:] = Phi  # the product so far, (15)
                else:
                    run_product(Phi, Phi_before, flight.Phi)  # (16)

        if flights and flights[0].k == j - M:
            flight = flights.popleft()
            k, x_reference, correction, x = flight.k, flight.reference.x, flight.correction, estimate.x
            estimate = Estimate(np.empty_like(x), estimate.P)
            run_correct(model, bound, k, y[k // N], x_reference, flight.Phi, x, estimate.x, correction, work)
            recorder.reference(*flight.reference)
            recorder.correction(correction)
            for later, Phi in zip(flights, flight.Phi_at, strict=True):
                x, x_corrected = later.reference.x, np.empty_like(x)
                run_compensate(bound, x, Phi, correction.delta_x, x_corrected, work)
                later.reference = later.reference._replace(x=x_corrected)

        if j % N == 0:
            if j // N < len(y):
                for flight in flights:
                    flight.Phi_at.append(flight.Phi)
                reference, correction = estimate, new_correction(system)
                estimate = Estimate(reference.x, np.empty_like(reference.P))
                run_gain(model, bound, j, reference, estimate.P, correction, work)
                flights.append(Flight(j, reference, correction, np.eye(system.states)))
            else:
                after_the_last.append(estimate)
        recorder.state(estimate.x)
    for reference in (*(flight.reference for flight in flights), *after_the_last):
        recorder.reference(*reference)
    recorder.keep_known(len(y))
