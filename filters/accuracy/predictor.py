"""PX4's output predictor in closed form: what its smoothing adds to the error of an exact replay.

PX4-Autopilot, src/modules/ekf2/EKF/output_predictor: a filter at the horizon j - D, and an output o that the inputs
carry forward. At the horizon err = f_{j-D} - o_{j-D}; then o_j and all that is kept of it, o_{j-D} .. o_j, are moved by
g err + 0.1 g^2 (sum of err), with g = dt / tau.

With the best gain the error at the horizon is uncorrelated with all innovations before, and o less the exact replay is
a sum of such: the covariance of its response to an innovation adds to V_N(a).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.periodic import steady
from filters.accuracy.riccati import below_one, gain
from filters.accuracy.visible import visible
from filters.arrays import FloatArray

SETTLED = 1e-15
MOST_CHUNKS = 1_000_000


def px4_predictor(model: LinearModel, outputs: ArrayLike, N: int, D: int, g: float) -> Accuracy:
    """D: steps by which the horizon is behind, at least the delay of the measurements; L = D. g: dt / tau of the
    complementary filter, 0 < g; PX4's tau is 0.25 s. Other arguments and errors as `lossless`."""
    check_steps("N", N, 1)
    check_steps("D", D, 0)
    if isinstance(g, bool) or not isinstance(g, int | float | np.number) or not 0.0 < g < np.inf:
        raise ValueError(f"g={g!r} must be positive: it is the period of a step over the time constant tau")
    left, C = visible(model, output_rows(outputs, model.states))
    regime = steady(left, C, [N], N + D)
    exact, no_delay = regime.variances[0, D : N + D], float(regime.variances[0, :N].max())
    before = regime.before[0]
    K = gain(before, left.H, left.R)
    kept = K @ np.linalg.cholesky(left.H @ before @ left.H.T + left.R)  # the effect of an innovation of unit covariance
    over_N = np.linalg.matrix_power(left.Phi, N)
    radius = max(
        _radius(left.Phi, D, g) ** N,
        float(np.abs(np.linalg.eigvals(over_N @ (np.eye(left.states) - K @ left.H))).max()),
    )
    added, moved = np.full(N, np.nan), 0.0
    if below_one(radius):
        added, moves, start = np.zeros(N), np.zeros(N), 0
        for output, move, still in _chunks(left.Phi, C, D, g, kept):
            steps = np.arange(start, start + len(output)) % N
            np.add.at(added, steps, output)
            np.add.at(moves, steps, move)
            start += len(output)
            if still <= SETTLED * added.max():
                break
        moved = float(moves.max())
    return of_cycle(
        N,
        D,
        exact + added,
        no_delay,
        moved,
        believed=float(exact.max()),
        radius=radius,
        verdict="approximate",
    )


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
        seen = np.concatenate([Phi @ apart if D == 0 else apart[1:], total[None]]).reshape(-1, n * p)
        moved = np.concatenate([np.zeros((1, n * p)), by_entry @ seen]).reshape(-1, n, p)
        total = (at_end @ seen).reshape(n, p)
        moves = np.diff(moved, axis=0)
        newest = np.concatenate([apart[-1:], moves])  # o_j, and what is added to it in each step from now on
        for level, power in enumerate(doublings or [Phi]):
            newest[2**level :] += power @ newest[: -(2**level)]
        apart = newest + (moved[-1] - moved)
        apart = apart[-1:] if D == 0 else apart
        kept = np.concatenate([apart, g * total[None]])
        yield _variances(C, newest[1:]), _variances(C, moves), float(_variances(C, kept).max())


def _moves(D: int, g: float) -> tuple[FloatArray, FloatArray]:
    """How far all that is kept has been moved after each of D steps, 1 if D = 0, and the sum of err after the last; of
    what comes to the horizon in these steps and the sum of err before them, which have a column each."""
    steps = max(D, 1)
    seen = np.eye(steps + 1)
    moved, total = np.zeros(steps + 1), seen[steps]
    rows = []
    for step in range(steps):
        err = -(seen[step] + moved)
        total = total + err
        moved = moved + g * err + 0.1 * g**2 * total
        rows.append(moved)
    return np.array(rows), total


def _variances(C: FloatArray, effects: FloatArray) -> FloatArray:
    """Traces (steps,) of the outputs' covariances, of effects (steps, n, p) of innovations of unit covariance."""
    return np.asarray(np.square(C @ effects).sum(axis=(1, 2)))


def _radius(Phi: FloatArray, D: int, g: float) -> float:
    """Of what a step makes of o_j .. o_{j-D}, less the replay, and of the sum of err: that of the same with an
    eigenvalue of Phi in its place, the largest."""
    shift = np.zeros((D + 2, D + 2), dtype=complex)
    shift[1 : D + 1, :D] = np.eye(D)
    shift[D + 1, D + 1] = 1.0
    pull = np.eye(D + 2)
    pull[D + 1, D] = -1.0
    pull[: D + 1, D] -= g + 0.1 * g**2
    pull[: D + 1, D + 1] += 0.1 * g**2
    radii = []
    for eigenvalue in np.linalg.eigvals(Phi):
        shift[0, 0] = eigenvalue
        radii.append(float(np.abs(np.linalg.eigvals(pull @ shift)).max()))
    return max(radii)
