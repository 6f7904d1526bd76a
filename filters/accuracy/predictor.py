"""PX4's output predictor in closed form: what its smoothing adds to the error of an exact replay.

PX4-Autopilot, src/modules/ekf2/EKF/output_predictor: a filter at the horizon j - D, and an output o that the inputs
carry forward. At the horizon err = f_{j-D} - o_{j-D}; then o_j and all that is kept of it, o_{j-D} .. o_j, are moved by
g err + 0.1 g^2 (sum of err), with g = dt / tau.

With the best gain the error at the horizon is uncorrelated with all innovations before, and o less the exact replay is
a sum of such: the covariance of its response to an innovation adds to V_N(a).
"""

from __future__ import annotations

from collections import deque
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
MOST_CYCLES = 100_000


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
        float(np.abs(np.linalg.eigvals(_step(left.Phi, D, g))).max()) ** N,
        float(np.abs(np.linalg.eigvals(over_N @ (np.eye(left.states) - K @ left.H))).max()),
    )
    added, moved = np.full(N, np.nan), 0.0
    if below_one(radius):
        added, moves = np.zeros(N), np.zeros(N)
        for output, move, still in _cycles(left.Phi, C, N, D, g, kept):
            added += output
            moves += move
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


def _cycles(
    Phi: FloatArray, C: FloatArray, N: int, D: int, g: float, innovation: FloatArray
) -> Iterator[tuple[FloatArray, FloatArray, float]]:
    """Of each cycle after an innovation (n, p), in each step (N,): variances of o less the exact replay, and of its
    moves; and what is still to come, as the largest variance of all that is kept, for o itself may pass through zero.

    What is kept of o is moved as a whole, so each entry is kept less all moves until then.
    """
    apart = [-innovation]  # o_{j-D} .. o_j less the replay of the horizon's estimate to there
    for _ in range(D):
        apart.append(Phi @ apart[-1])
    kept, moved, total = deque(apart), np.zeros_like(innovation), np.zeros_like(innovation)
    for cycle in range(MOST_CYCLES):
        outputs, moves = np.empty(N), np.empty(N)
        for step in range(N):
            if cycle or step:
                kept.append(Phi @ (kept[-1] + moved) - moved)
                kept.popleft()
            err = -(kept[0] + moved)
            total = total + err
            move = g * err + 0.1 * g**2 * total
            moved = moved + move
            outputs[step], moves[step] = np.square(C @ (kept[-1] + moved)).sum(), np.square(C @ move).sum()
        still = max(float(np.square(C @ part).sum()) for part in (*(each + moved for each in kept), g * total))
        yield outputs, moves, still


def _step(Phi: FloatArray, D: int, g: float) -> FloatArray:
    """What a step makes of o_j .. o_{j-D}, less the replay, and of the sum of err."""
    n = len(Phi)
    shift = np.zeros((D + 2, D + 2))
    shift[1 : D + 1, :D] = np.eye(D)
    shift[D + 1, D + 1] = 1.0
    first = np.zeros((D + 2, D + 2))
    first[0, 0] = 1.0
    pull = np.eye(D + 2)
    pull[D + 1, D] = -1.0
    pull[: D + 1, D] -= g + 0.1 * g**2
    pull[: D + 1, D + 1] += 0.1 * g**2
    return np.asarray(np.kron(pull, np.eye(n)) @ (np.kron(shift, np.eye(n)) + np.kron(first, Phi)))
