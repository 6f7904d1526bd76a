"""What an innovation leaves in PX4's output: o less the exact replay, in all steps after it.

Kept of it are o_j .. o_{j-D}, less the replay, and the sum of err. In a step o_j is carried forward by Phi, err is
taken of the oldest, and all are moved: the same matrix for each eigenvalue of Phi in its place.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import log

import numpy as np

from filters.arrays import FloatArray

SETTLED = 1e-15
"""So little of the variance is still to come where nothing more is added."""
MOST_CHUNKS = 1_000_000
MOST_DOUBLINGS = 60
PRODUCTS = 5
"""Of matrices, as slow as to walk: so many doubling takes, about."""
WORTH = 40_000
"""Multiplications that take as long as to walk D steps: d^3 of them, for d numbers kept, are a product of matrices."""


def radius(Phi: FloatArray, D: int, g: float) -> float:
    """Spectral radius of a step."""
    still, carried = _step(D, g)
    eigenvalues = np.linalg.eigvals(Phi)
    once = eigenvalues[eigenvalues.imag >= 0.0]  # a conjugate has the conjugate's
    return max(float(np.abs(np.linalg.eigvals(still + value * carried)).max()) for value in once)


def variances(
    Phi: FloatArray, C: FloatArray, N: int, D: int, g: float, innovation: FloatArray, step_radius: float
) -> tuple[FloatArray, FloatArray]:
    """Of o less the exact replay, and of its moves, in each step of a cycle (N,), (N,): the sum over all innovations
    (n, p) of unit covariance before, one in every N steps. C (outputs, n); step_radius: less than 1, `radius`."""
    kept, walk = _doubling(Phi, D), _walking(D, step_radius)
    if D == 0 or kept < walk:
        return _doubled(Phi, C, N, D, g, innovation)
    return _walked(Phi, C, N, D, g, innovation)


def multiplications(Phi: FloatArray, D: int, step_radius: float) -> float:
    """About so many are done by `variances`."""
    kept, walk = _doubling(Phi, D), _walking(D, step_radius)
    return PRODUCTS * kept if D == 0 or kept < walk else walk


def _doubling(Phi: FloatArray, D: int) -> float:
    """Multiplications of one product of matrices of all that is kept."""
    return float((D + 2) * len(Phi)) ** 3


def _walking(D: int, step_radius: float) -> float:
    """What takes as long as to walk until nothing more comes."""
    return WORTH * log(SETTLED) / (2.0 * log(step_radius)) / D if D and step_radius > 0.0 else 0.0


def _step(D: int, g: float) -> tuple[FloatArray, FloatArray]:
    """What a step makes of the numbers kept, newest first, where Phi is 0; and for Phi = 1 besides."""
    shift = np.eye(D + 2, k=-1)
    shift[D + 1] = np.eye(D + 2)[D + 1]
    pull = _pull(D, g)
    return pull @ shift, np.outer(pull[:, 0], np.eye(D + 2)[0])


def _pull(D: int, g: float) -> FloatArray:
    """The sum of err less the oldest, and all moved by g err + 0.1 g^2 (sum of err)."""
    pull = np.eye(D + 2)
    pull[D + 1, D] = -1.0
    pull[: D + 1, D] -= g + 0.1 * g**2
    pull[: D + 1, D + 1] += 0.1 * g**2
    return pull


def _doubled(
    Phi: FloatArray, C: FloatArray, N: int, D: int, g: float, innovation: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """By the covariance of all that is kept, X = A^N X A^N^T + Z, in as many products as the steps have digits."""
    n = len(Phi)
    still, carried = _step(D, g)
    A = np.kron(still, np.eye(n)) + np.kron(carried, Phi)
    powers = [-innovation]
    for _ in range(D):
        powers.append(Phi @ powers[-1])
    before = np.concatenate([*powers[::-1], np.zeros_like(innovation)])
    start = np.kron(_pull(D, g), np.eye(n)) @ before
    X, over = start @ start.T, np.linalg.matrix_power(A, N)
    for _ in range(MOST_DOUBLINGS):
        more = over @ X @ over.T
        X = X + more
        if (np.diag(more) <= SETTLED**2 * np.diag(X)).all():
            break
        over = over @ over
    output = C @ np.eye(n, len(A))
    move = output @ A - C @ Phi @ np.eye(n, len(A))  # of what was kept before the step
    rows = [np.concatenate([output, move])]
    for _ in range(N - 1):
        rows.append(rows[-1] @ A)
    of_all = np.array(rows)
    each = np.sum((of_all @ X) * of_all, axis=2)
    outputs, moves = each[:, : len(C)].sum(axis=1), np.roll(each[:, len(C) :].sum(axis=1), 1)
    moves[0] += np.square(C @ (start - before)[:n]).sum()
    return outputs, moves


def _walked(
    Phi: FloatArray, C: FloatArray, N: int, D: int, g: float, innovation: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Step by step until nothing more comes."""
    outputs, moves, start = np.zeros(N), np.zeros(N), 0
    for output, move, still in _chunks(Phi, C, D, g, innovation):
        steps = np.arange(start, start + len(output)) % N
        np.add.at(outputs, steps, output)
        np.add.at(moves, steps, move)
        start += len(output)
        if still <= SETTLED * outputs.max():
            break
    return outputs, moves


def _chunks(
    Phi: FloatArray, C: FloatArray, D: int, g: float, innovation: FloatArray
) -> Iterator[tuple[FloatArray, FloatArray, float]]:
    """Of each D steps after an innovation (n, p): variances of o less the exact replay, and of its moves, in each; and
    what is still to come, as the largest variance of all that is kept, for o itself may pass through zero. The first
    are of the step of the innovation alone.

    What is at the horizon in the next D steps is there already, but for the moves to come, so all moves are known at
    once, and of the n p numbers of each alike.
    """
    n, p = innovation.shape
    powers = [np.eye(n)]
    for _ in range(D):
        powers.append(Phi @ powers[-1])
    apart = -np.array(powers) @ innovation  # o_{j-D} .. o_j less the replay of the horizon's estimate to there
    total = -apart[0]
    move = g * total + 0.1 * g**2 * total
    apart = apart + move
    yield _variances(C, apart[-1:]), _variances(C, move[None]), np.inf
    by_entry, at_end = _moves(D, g)
    doublings = [np.linalg.matrix_power(Phi, 2**level) for level in range(D.bit_length())]
    for _ in range(MOST_CHUNKS):
        seen = np.concatenate([apart[1:], total[None]]).reshape(-1, n * p)
        moved = np.concatenate([np.zeros((1, n * p)), by_entry @ seen]).reshape(-1, n, p)
        total = (at_end @ seen).reshape(n, p)
        moves = np.diff(moved, axis=0)
        newest = np.concatenate([apart[-1:], moves])  # o_j, and what is added to it in each step from now on
        for level, power in enumerate(doublings):
            newest[2**level :] += power @ newest[: -(2**level)]
        apart = newest + (moved[-1] - moved)
        kept = np.concatenate([apart, g * total[None]])
        yield _variances(C, newest[1:]), _variances(C, moves), float(_variances(C, kept).max())


def _moves(D: int, g: float) -> tuple[FloatArray, FloatArray]:
    """How far all that is kept has been moved after each of D steps, and the sum of err after the last; of
    what comes to the horizon in these steps and the sum of err before them, which have a column each."""
    seen = np.eye(D + 1)
    moved, total = np.zeros(D + 1), seen[D]
    rows = []
    for step in range(D):
        err = -(seen[step] + moved)
        total = total + err
        moved = moved + g * err + 0.1 * g**2 * total
        rows.append(moved)
    return np.array(rows), total


def _variances(C: FloatArray, effects: FloatArray) -> FloatArray:
    """Traces (steps,) of the outputs' covariances, of effects (steps, n, p) of innovations of unit covariance."""
    return np.asarray(np.square(C @ effects).sum(axis=(1, 2)))
