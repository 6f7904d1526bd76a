"""State augmentation: the states of the last D steps are estimated beside the present one, all with their covariances.

A measurement that is D steps late is one of the oldest of them, and the update corrects them all; so it is exact, as
Larsen's method is. What it costs grows with D in every step, and with D^2 in the update. Autoware's localisation fuses
late poses so (ekf_localizer, `TimeDelayKalmanFilter`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import check_history
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.kernels.dense import (
    add,
    add_matmul_blocked,
    add_vectors,
    matmul_blocked,
    matmul_narrow,
    matmul_transposed_narrow,
    matvec,
    mirror,
    negate,
    subtract_vectors,
    transpose,
)
from filters.kernels.solve import inverse
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Correction, Sample, Workspace, new_correction, new_workspace
from filters.running import running
from filters.system import System

REMEDY = "run filters.larsen with update='joseph', which is as exact, or give a smaller P0 or more noise (Q, R)"
"""Where rounding is too much for the update."""


class Stack(NamedTuple):
    """D + 1 states and their covariances. That of step j is in slot j % slots; slots = D + 2, one of them free.

    x (slots, n); P (slots, slots, n, n): P[a, b] of the states in slots a and b.
    """

    x: FloatArray
    P: FloatArray


class StackGains(NamedTuple):
    """HP (slots, p, n): H P[a, b], where slot a is measured; K (slots, n, p): gain of the state in each slot b."""

    HP: FloatArray
    K: FloatArray


def new_stack(system: System, D: int) -> Stack:
    """Memory for the states of D past steps and the present one, zero."""
    n, slots = system.states, D + 2
    return Stack(np.zeros((slots, n)), np.zeros((slots, slots, n, n)))


def new_gains(system: System, D: int) -> StackGains:
    """Memory for the gains of a stack."""
    n, p, slots = system.states, system.measurements, D + 2
    return StackGains(np.zeros((slots, p, n)), np.zeros((slots, n, p)))


def predict(system: System, form: CovarianceForm, j: int, stack: Stack, u: FloatArray, work: Workspace) -> None:
    """Job: the present goes from j to j + 1 (Eqs. 6, 8), into the free slot; the slot of step j - D becomes free.

    The covariance of the new state with each of the D that stay is Phi_j times that of the old one.
    """
    slots = stack.x.shape[0]
    now, following = j % slots, (j + 1) % slots
    system.f(j, stack.x[now], u, system.parameters, stack.x[following])  # (6)
    Phi = system.F(j, stack.x[now], u, system.parameters)
    form.propagation(Phi, stack.P[now, now], system.Q(j, system.parameters), stack.P[following, following], work)  # (8)
    for i in range(slots - 2):
        past = (j - i) % slots
        form.product(Phi, stack.P[now, past], stack.P[following, past])
        transpose(stack.P[following, past], stack.P[past, following])


def update(
    system: System,
    m: int,
    y: FloatArray,
    before: Stack,
    after: Stack,
    gains: StackGains,
    correction: Correction,
    work: Workspace,
) -> None:
    """Job of step m: all states before the measurement y of k = m - D become those after it, Eqs. (9) to (12).

    As in the short covariance form, P - K (H P), but S is inverted once for all states. K of the correction is that of
    step k.
    """
    slots = before.x.shape[0]
    D = slots - 2
    k = m - D
    measured = k % slots
    H = system.H(k, before.x[measured], system.parameters)
    for i in range(D + 1):
        slot = (m - i) % slots
        matmul_blocked(H, before.P[measured, slot], gains.HP[slot])
    matmul_transposed_narrow(gains.HP[measured], H, work.S)
    add(work.S, system.R(k, system.parameters), work.S)  # innovation covariance
    inverse(work.S, work.S_inverse, work.pp1)
    system.h(k, before.x[measured], system.parameters, correction.z)
    subtract_vectors(y, correction.z, correction.z)  # (5)
    for i in range(D + 1):
        slot = (m - i) % slots
        matmul_narrow(work.S_inverse, gains.HP[slot], work.pn1)
        transpose(work.pn1, gains.K[slot])  # (9)
        matvec(gains.K[slot], correction.z, correction.delta_x)  # (10)
        add_vectors(before.x[slot], correction.delta_x, after.x[slot])  # (12)
    for i in range(D + 1):
        slot = (m - i) % slots
        negate(gains.K[slot], work.np1)
        for older in range(i, D + 1):
            other = (m - older) % slots
            add_matmul_blocked(before.P[slot, other], work.np1, gains.HP[other], after.P[slot, other])  # (11)
            transpose(after.P[slot, other], after.P[other, slot])
        mirror(after.P[slot, slot])
    for r in range(correction.K.shape[0]):
        for c in range(correction.K.shape[1]):
            correction.K[r, c] = gains.K[measured, r, c]


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
    """Filter a record of data in which the measurement of step k can be read from step m = k + M on; D = M.

    Arguments, results and errors as in `standard.run`; the correction is in the state of step m, whatever L is. The
    covariance form is that of the propagation; the update has one of its own, see `update`.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    moves, y = problem.inputs, problem.measured.y
    run_predict, run_update = function_for(backend, predict), function_for(backend, _update)
    form = arguments_for(backend, covariance_form(update, problem.structure))
    model = arguments_for(backend, problem.system)
    stack, spare, gains = new_stack(system, M), new_stack(system, M), new_gains(system, M)
    work, recorder = new_workspace(system), HistoryRecorder(system)

    def remember(j: int) -> None:
        now = j % (M + 2)
        recorder.reference(stack.x[now].copy(), stack.P[now, now].copy())

    stack.x[0], stack.P[0, 0] = problem.start
    for j in range(len(moves) + 1):
        if j > 0:
            run_predict(model, form, j - 1, stack, moves[j - 1], work)
        if j % N == 0 and M < N:
            remember(j)
        k = j - M
        if k >= 0 and k % N == 0 and k // N < len(y):
            correction = new_correction(system)
            run_update(model, j, y[k // N], stack, spare, gains, correction, work)
            stack, spare = spare, stack
            recorder.correction(correction)
        if j % N == 0 and M == N:  # the measurement that has just arrived belonged to the reference before this one
            remember(j)
        recorder.state(stack.x[j % (M + 2)].copy())
    return check_history(recorder.history(), recorder.references().x, problem, N, REMEDY, backend)


_update = update
"""By a name that no argument of `run` has."""

Arguments = Callable[[System, CovarianceForm, Sample], tuple[Any, ...]]


def _stacked(system: System, D: int, at: Sample) -> Stack:
    """The estimate of m in all slots, the less correlated the farther apart."""
    stack = new_stack(system, D)
    slots = [(at.m - i) % (D + 2) for i in range(D + 1)]
    for i, slot in enumerate(slots):
        stack.x[slot] = at.now.x
        for older, other in enumerate(slots):
            stack.P[slot, other] = 0.9 ** abs(i - older) * at.now.P
    return stack


def _predict(D: int) -> Arguments:
    def arguments(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
        return system, form, at.m, _stacked(system, D, at), at.u, new_workspace(system)

    return arguments


def _update_arguments(D: int) -> Arguments:
    def arguments(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
        before, after, gains = _stacked(system, D, at), new_stack(system, D), new_gains(system, D)
        return system, at.m, at.y, before, after, gains, new_correction(system), new_workspace(system)

    return arguments


def predict_kind(D: int) -> JobKind[CovarianceForm]:
    """Its operations are linear in D."""
    return f"predict_{D}", predict, _predict(D)


def update_kind(D: int) -> JobKind[CovarianceForm]:
    """Its operations are quadratic in D."""
    return f"update_{D}", update, _update_arguments(D)


JOBS = (predict_kind(0), predict_kind(1), update_kind(0), update_kind(1), update_kind(2))
"""As few D as say what every other one costs."""
