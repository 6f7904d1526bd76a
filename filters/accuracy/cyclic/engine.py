"""The covariance of whatever a linear filter holds, in each step of a cycle that repeats.

What the filter and its surroundings hold is stacked in one vector s. An operation makes A s + offset + w of it,
w ~ N(0, W); a cycle is a list of operations for each of its steps.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray

MOST_DOUBLINGS = 60


class Operation(NamedTuple):
    """A (d, d): dense or sparse. W (d, d), offset (d,): zero if None. corrects: a correction, by which outputs move."""

    A: Any
    W: FloatArray | None = None
    offset: FloatArray | None = None
    corrects: bool = False


class Cycle(NamedTuple):
    """steps: the operations of each, in order. C (outputs, d): the outputs, in whose covariance `beside` (outputs,
    outputs) is too, of noise that the stack does not hold."""

    steps: tuple[tuple[Operation, ...], ...]
    C: FloatArray
    beside: FloatArray


class Regime(NamedTuple):
    """Once it repeats; in each step of the cycle, after its operations.

    radius: spectral radius of a cycle. variances (steps,): trace of the output's covariance. means (steps, outputs).
    moves (steps,): variance by which the corrections of that step move the output, the largest of them. All but the
    radius nan where it is 1 or more, up to rounding.
    """

    radius: float
    variances: FloatArray
    means: FloatArray
    moves: FloatArray


def regime(cycle: Cycle) -> Regime:
    """From X = A_c X A_c^T + W_c, by doubling, and one replay."""
    d, steps = cycle.C.shape[1], len(cycle.steps)
    A: FloatArray = np.eye(d)
    X: FloatArray = np.zeros((d, d))
    mean: FloatArray = np.zeros(d)
    for operation in _operations(cycle):
        A = operation.A @ A
        X, mean = _applied(operation, X, mean)
    radius = float(np.abs(np.linalg.eigvals(A)).max())
    if not radius < 1.0 - 1e-9:
        nothing = np.full(steps, np.nan)
        return Regime(radius, nothing, np.full((steps, len(cycle.C)), np.nan), nothing)
    mean = np.asarray(np.linalg.solve(np.eye(d) - A, mean), dtype=np.float64)
    X = _repeated(A, X)
    variances, moves, means = np.zeros(steps), np.zeros(steps), np.zeros((steps, len(cycle.C)))
    for step, operations in enumerate(cycle.steps):
        for operation in operations:
            if operation.corrects:
                moves[step] = max(moves[step], _moved(operation, cycle.C, X))
            X, mean = _applied(operation, X, mean)
        variances[step] = np.trace(cycle.C @ X @ cycle.C.T + cycle.beside)
        means[step] = cycle.C @ mean
    return Regime(radius, variances, means, moves)


def _operations(cycle: Cycle) -> list[Operation]:
    return [operation for operations in cycle.steps for operation in operations]


def _applied(operation: Operation, X: FloatArray, mean: FloatArray) -> tuple[FloatArray, FloatArray]:
    X = operation.A @ (operation.A @ X).T  # X is symmetric
    mean = operation.A @ mean
    if operation.W is not None:
        X += operation.W
    if operation.offset is not None:
        mean = mean + operation.offset
    return X, mean


def _moved(operation: Operation, C: FloatArray, X: FloatArray) -> float:
    by = C @ operation.A - C
    moved = np.trace(by @ X @ by.T)
    return float(moved if operation.W is None else moved + np.trace(C @ operation.W @ C.T))


def _repeated(A: FloatArray, X: FloatArray) -> FloatArray:
    """The sum of A^i X (A^i)^T over all i."""
    for _ in range(MOST_DOUBLINGS):
        more = A @ X @ A.T
        X = X + more
        if (np.diag(more) <= 1e-17 * np.diag(X)).all():
            break
        A = A @ A
    return 0.5 * (X + X.T)
