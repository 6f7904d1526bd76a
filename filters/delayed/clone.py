"""Stochastic cloning, projected: what is carried from k to m is the covariance of the state with the measurement.

S. I. Roumeliotis and J. W. Burdick, Stochastic cloning, ICRA 2002, keep a copy of the state of k and its covariance
with the present one. Of these the update needs no more than W = Phi_{k->j} P_{k^-} H_k^T, which is n x p, where
Larsen's method carries Phi_{k->j} itself. At m, with S = H_k P_{k^-} H_k^T + R_k:

    x + W S^-1 (y - h(x_{k^-})),  P - W S^-1 W^T

equal to Eqs. (20) and (21). The measurement is at hand when step m starts, so that its HR job corrects the estimate
that the step before has left, with Phi_{k->m-1}, and propagates what is corrected: that step has nothing to carry.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.standard import PROPAGATE, propagate
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.kernels.dense import add, matmul_narrow, subtract_vectors
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Estimate, Sample, Workspace, new_correction, new_estimate, new_workspace
from filters.running import running
from filters.system import System


class Clone(NamedTuple):
    """What is kept of step k until its measurement arrives.

    expected (p,): h(x_{k^-}). W (n, p): P_{k^-} H_k^T. S, factor (p, p): the innovation covariance, and what divides by
    it (see `CovarianceForm.factor`).
    """

    expected: FloatArray
    W: FloatArray
    S: FloatArray
    factor: FloatArray


def new_clone(system: System) -> Clone:
    """Memory for one, zero."""
    n, p = system.states, system.measurements
    return Clone(np.zeros(p), np.zeros((n, p)), np.zeros((p, p)), np.zeros((p, p)))


def start(
    system: System, form: CovarianceForm, k: int, reference: Estimate, clone: Clone, work: Workspace
) -> FloatArray:
    """Job of step k: all of the clone, from x_{k^-}, P_{k^-}. Returns H_k."""
    H = cross(system, form, k, reference, clone, work)
    divide(system, form, k, H, clone, work)
    return H


def carry(Phi: FloatArray, W: FloatArray, W_next: FloatArray) -> None:
    """Job of steps k + 1 .. m - 1: W of the step before becomes that of this one, by its Phi."""
    matmul_narrow(Phi, W, W_next)


def cloned_update(
    _system: System,
    form: CovarianceForm,
    _k: int,
    y: FloatArray,
    _H: FloatArray,
    clone: Clone,
    W: FloatArray,
    before: Estimate,
    after: Estimate,
    z: FloatArray,
    work: Workspace,
) -> None:
    """Job of step m, done before it propagates: the measurement y of step k corrects the estimate of step m - 1.

    W (n, p): as carried to there. z (p,): the innovation is written there.
    """
    correct(form, y, clone, W, before, after, z, work)


def cross(
    system: System, form: CovarianceForm, k: int, reference: Estimate, clone: Clone, work: Workspace
) -> FloatArray:
    """What can be had at k only: h(x_{k^-}) and W. Returns H_k."""
    H = system.H(k, reference.x, system.parameters)
    form.cross(reference.P, H, clone.W, work)
    system.h(k, reference.x, system.parameters, clone.expected)
    return H


def divide(system: System, form: CovarianceForm, k: int, H: FloatArray, clone: Clone, work: Workspace) -> None:
    """S from W, and its factor."""
    matmul_narrow(H, clone.W, clone.S)
    add(clone.S, system.R(k, system.parameters), clone.S)  # innovation covariance
    form.factor(clone.S, clone.factor, work)


def correct(
    form: CovarianceForm,
    y: FloatArray,
    clone: Clone,
    W: FloatArray,
    before: Estimate,
    after: Estimate,
    z: FloatArray,
    work: Workspace,
) -> None:
    """Eqs. (20) and (21) by W."""
    subtract_vectors(y, clone.expected, z)
    form.cross_update(before, W, clone.S, clone.factor, z, after, work)


def gain_at_k(form: CovarianceForm, clone: Clone, K: FloatArray, work: Workspace) -> None:
    """K_k (Eq. 9), which no job needs; for the record."""
    form.cross_gain(clone.W, clone.S, K, work)


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
    return run_jobs(
        start, cloned_update, covariance_form, system, N, M, L, x0, P0, inputs, measurements, update, backend
    )


def run_jobs(
    start: Callable[..., FloatArray],
    update: Callable[..., None],
    form_named: Callable[[CovarianceFormName], CovarianceForm],
    system: System,
    N: int,
    M: int,
    L: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Measurements,
    form_name: CovarianceFormName,
    backend: BackendName,
) -> History:
    """`run` with these jobs at k and m, and these forms."""
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    moves, y = problem.inputs, problem.measured.y
    run_propagate, run_start = function_for(backend, propagate), function_for(backend, start)
    run_carry, run_update = function_for(backend, carry), function_for(backend, update)
    run_gain = function_for(backend, gain_at_k)
    form, model = arguments_for(backend, form_named(form_name)), arguments_for(backend, problem.system)
    work = new_workspace(system)
    recorder = HistoryRecorder(system)

    def corrected(k: int, before: Estimate) -> Estimate:
        after, correction = new_estimate(system), new_correction(system)
        run_update(model, form, k, y[k // N], H, clone, W, before, after, correction.z, work)
        run_gain(form, clone, correction.K, work)
        recorder.correction(correction)
        return after

    estimate = problem.start
    H, clone, W = np.empty(0), new_clone(system), np.empty(0)
    for j in range(len(moves) + 1):
        k = j - M
        arrives = k >= 0 and k % N == 0 and k // N < len(y)
        if j > 0:
            before = corrected(k, estimate) if arrives and M > 0 else estimate
            estimate = new_estimate(system)
            Phi = run_propagate(model, form, j - 1, before, moves[j - 1], estimate, work)
            if 0 < j % N < M:
                W_before, W = W, np.empty_like(W)
                run_carry(Phi, W_before, W)
        if j % N == 0:
            recorder.reference(*estimate)
            clone = new_clone(system)
            H, W = run_start(model, form, j, estimate, clone, work), clone.W
        if arrives and M == 0:
            estimate = corrected(k, estimate)
        recorder.state(estimate.x)
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(form_name), backend)


def sampled(system: System, at: Sample) -> tuple[FloatArray, Clone, FloatArray]:
    """H_k, the memory of a clone with expectation and W, and W carried to m."""
    clone, H = new_clone(system), system.H(at.k, at.reference.x, system.parameters)
    clone.W[:] = at.reference.P @ H.T
    system.h(at.k, at.reference.x, system.parameters, clone.expected)
    return H, clone, at.transition.Phi @ clone.W


def start_arguments(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    """Of `start`."""
    return system, form, at.k, at.reference, new_clone(system), new_workspace(system)


def _carry(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    _, clone, _ = sampled(system, at)
    return at.transition.Phi, clone.W, np.empty_like(clone.W)


def _cloned_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    H, clone, W = sampled(system, at)
    work, z = new_workspace(system), np.empty(system.measurements)
    divide(system, form, at.k, H, clone, work)
    return system, form, at.k, at.y, H, clone, W, at.now, new_estimate(system), z, work


CARRY: JobKind[CovarianceForm] = ("carry", carry, _carry)
JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PROPAGATE,
    ("start", start, start_arguments),
    CARRY,
    ("update", cloned_update, _cloned_update),
)
