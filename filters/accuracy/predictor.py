"""PX4's output predictor in closed form: what its smoothing adds to the error of an exact replay.

PX4-Autopilot, src/modules/ekf2/EKF/output_predictor: a filter at the horizon j - D, and an output o that the inputs
carry forward. At the horizon err = f_{j-D} - o_{j-D}; then o_j and all that is kept of it, o_{j-D} .. o_j, are moved by
g err + 0.1 g^2 (sum of err), with g = dt / tau.

With the best gain the error at the horizon is uncorrelated with all innovations before, and o less the exact replay is
a sum of such: the covariance of its response to an innovation adds to V_N(a).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy import predictor_response
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.periodic import steady
from filters.accuracy.riccati import below_one, gain
from filters.accuracy.visible import visible


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
    step_radius = predictor_response.radius(left.Phi, D, g)
    radius = max(
        step_radius**N,
        float(np.abs(np.linalg.eigvals(over_N @ (np.eye(left.states) - K @ left.H))).max()),
    )
    added, moved = np.full(N, np.nan), 0.0
    if below_one(radius):
        added, moves = predictor_response.variances(left.Phi, C, N, D, g, kept, step_radius)
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
