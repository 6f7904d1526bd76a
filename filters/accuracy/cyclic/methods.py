"""What each method does in the steps of a cycle, as operations on stacked estimation errors.

In step 0 of a cycle a measurement is taken; it is in the output from L steps later on, L = 0, 1, ..., also beyond N.
"""

from __future__ import annotations

import numpy as np

from filters.accuracy.cyclic.engine import Cycle, Operation
from filters.accuracy.model import LinearModel
from filters.arrays import FloatArray


def undelayed(
    model: LinearModel, C: FloatArray, N: int, K: FloatArray, displacement: FloatArray | None = None
) -> Cycle:
    """The standard filter: one block, the error. displacement (p,): by which the measured quantity has moved since the
    measurement, of which the filter does not know."""
    offset = None if displacement is None else -K @ displacement
    A = np.eye(model.states) - K @ model.H
    update = Operation(A, np.asarray(K @ model.R @ K.T), offset, corrects=True)
    return _cycle(N, Operation(model.Phi, model.Q), {0: [update]}, C)


def replayed(model: LinearModel, C: FloatArray, N: int, L: int, K: FloatArray) -> Cycle:
    """Blocks: the error of the output; then those of the estimates with one, two, ... more measurements in them, in the
    order in which they were taken. At a landing each becomes the next. As recalculate, or a delayed horizon."""
    pending = -(-L // N)
    if not pending:
        return undelayed(model, C, N, K)
    n, blocks = model.states, pending + 1
    propagate = Operation(np.kron(np.eye(blocks), model.Phi), np.asarray(np.kron(np.ones((blocks, blocks)), model.Q)))
    later = np.eye(blocks, k=1)
    later[-1, -1] = 1.0  # the newest goes on until there is a newer one
    land = Operation(np.kron(later, np.eye(n)), corrects=True)
    A, W = np.eye(n * blocks), np.zeros((n * blocks, n * blocks))
    A[-n:, -n:] -= K @ model.H
    W[-n:, -n:] = K @ model.R @ K.T
    return _cycle(N, propagate, _by_step(N, L, land, Operation(A, W)), _of_first(C, blocks))


def carried(model: LinearModel, C: FloatArray, N: int, L: int, K: FloatArray, *, compensated: bool = True) -> Cycle:
    """Blocks: the error of the output; then the corrections in flight, oldest first, carried along. As larsen and the
    dual rate filter. compensated: an innovation takes those in flight into account (needed beyond L = N)."""
    pending = -(-L // N)
    if not pending:
        return undelayed(model, C, N, K)
    n, blocks = model.states, pending + 1
    Q = np.zeros((blocks, blocks))
    Q[0, 0] = 1.0
    propagate = Operation(np.kron(np.eye(blocks), model.Phi), np.asarray(np.kron(Q, model.Q)))
    landed = np.eye(blocks, k=1)
    landed[0, 0] = 1.0
    land = Operation(np.kron(landed, np.eye(n)), corrects=True)
    A, W = np.eye(n * blocks), np.zeros((n * blocks, n * blocks))
    known = np.ones(blocks) if compensated else np.eye(blocks)[0]
    A[-n:] = np.kron(known, -K @ model.H)
    A[-n:, -n:] = 0.0  # nothing is in that place yet
    W[-n:, -n:] = K @ model.R @ K.T
    return _cycle(N, propagate, _by_step(N, L, land, Operation(A, W)), _of_first(C, blocks))


def _by_step(N: int, L: int, land: Operation, measure: Operation) -> dict[int, list[Operation]]:
    """What is due in step 0 lands before a measurement is taken there."""
    return {0: [land, measure]} if L % N == 0 else {0: [measure], L % N: [land]}


def _cycle(N: int, propagate: Operation, others: dict[int, list[Operation]], C: FloatArray) -> Cycle:
    steps = tuple((propagate, *others.get(step, ())) for step in range(N))
    return Cycle(steps, C, np.zeros((len(C), len(C))))


def _of_first(C: FloatArray, blocks: int) -> FloatArray:
    return np.hstack([C, np.zeros((len(C), C.shape[1] * (blocks - 1)))])
