"""Stochastic cloning, projected: what is carried from k to m is the covariance of the state with the measurement.

S. I. Roumeliotis and J. W. Burdick, Stochastic cloning, ICRA 2002, keep a copy of the state of k and its covariance
with the present one. Of these the update needs no more than W = Phi_{k->j} P_{k^-} H_k^T, which is n x p, where
Larsen's method carries Phi_{k->j} itself. At m, with S = H_k P_{k^-} H_k^T + R_k:

    x + W S^-1 (y - h(x_{k^-})),  P - W S^-1 W^T

equal to Eqs. (20) and (21). The measurement is at hand when step m starts, so that its HR job corrects the estimate
that the step before has left, with Phi_{k->m-1}, and propagates what is corrected: that step has nothing to carry.

Where others are taken before one arrives, M > N, there is a W for each on its way, see `cloned`. P is at any time the
covariance of the error of x, for nothing is taken from it before it lands.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.cloned import Clone, carry, compensate, correct, couple, cross, divide, new_clone
from filters.delayed.cloning import Cloning, Jobs
from filters.delayed.flights import steps
from filters.delayed.standard import PROPAGATE
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Estimate, Sample, Workspace, new_estimate, new_workspace
from filters.running import running
from filters.system import System


def start(
    system: System, form: CovarianceForm, k: int, reference: Estimate, clone: Clone, work: Workspace
) -> FloatArray:
    """Job of step k: all of the clone, from x_{k^-}, P_{k^-}. Returns H_k."""
    H = cross(system, form, k, reference, clone, work)
    divide(system, form, k, H, clone, work)
    return H


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

    Arguments, results and errors as in `standard.run`. The correction is in the state of step m, whatever L is. With
    M > N there are several on their way at once; that one is lost is known when it should be taken.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements, several=True)
    recorder = HistoryRecorder(system)
    form = covariance_form(update, problem.structure)
    cloning = Cloning(problem, system, form, Jobs(start, cloned_update), backend)
    for filtered in steps(cloning, problem, N, M, recorder):
        recorder.state(filtered.now.x)
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


def sampled(system: System, at: Sample) -> tuple[FloatArray, Clone, FloatArray]:
    """H_k, the memory of a clone with expectation and W, and W carried to m."""
    clone, H = new_clone(system), system.H(at.k, at.reference.x, system.parameters)
    clone.W[:] = at.reference.P @ H.T
    system.h(at.k, at.reference.x, system.parameters, clone.expected)
    return H, clone, at.transition.Phi @ clone.W


def start_arguments(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    """Of `start`."""
    return system, form, at.k, at.reference, new_clone(system), new_workspace(system)


def _carry(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    _, clone, _ = sampled(system, at)
    Phi = system.F(at.m, at.now.x, at.u, system.parameters).copy()
    return form, Phi, clone.W, np.zeros_like(clone.W)


def _cloned_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    H, clone, W = sampled(system, at)
    work, z = new_workspace(system), np.zeros(system.measurements)
    divide(system, form, at.k, H, clone, work)
    return system, form, at.k, at.y, H, clone, W, at.now, new_estimate(system), z, work


def _couple(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    H, clone, W_earlier = sampled(system, at)
    work, H_now = new_workspace(system), system.H(at.m, at.now.x, system.parameters)
    divide(system, form, at.k, H, clone, work)
    W, G = at.now.P @ H_now.T, np.zeros_like(clone.S)
    return form, H_now, clone, W_earlier, W, np.zeros_like(W), G, work


def _compensate(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    G = system.H(at.m, at.now.x, system.parameters) @ at.transition.Phi @ at.correction.K
    return at.y - at.correction.z, G, at.correction.z, np.zeros(system.measurements)


CARRY: JobKind[CovarianceForm] = ("carry", carry, _carry)
JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PROPAGATE,
    ("start", start, start_arguments),
    CARRY,
    ("update", cloned_update, _cloned_update),
    ("couple", couple, _couple),
    ("compensate", compensate, _compensate),
)
