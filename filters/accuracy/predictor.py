"""PX4's output predictor in closed form: what its smoothing adds to the error of an exact replay.

PX4-Autopilot, src/modules/ekf2/EKF/output_predictor: a filter at the horizon j - D, and an output o that the inputs
carry forward. At the horizon err = f_{j-D} - o_{j-D}; then o_j and all that is kept of it, o_{j-D} .. o_j, are moved by
g err + 0.1 g^2 (sum of err), with g = dt / tau.

With the best gain the error at the horizon is uncorrelated with all innovations before, and o less the exact replay is
a sum of such: the covariance of its response to an innovation adds to V_N(a).
"""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy import predictor_response
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.pattern import Interval, check_interval, taken
from filters.accuracy.regime import in_steps, regime, worst_of
from filters.accuracy.riccati import below_one, gain
from filters.accuracy.visible import visible

MOST_INNOVATIONS = 50
"""Of a repetition: what each leaves is a sum of its own."""


def predictor_multiplications(model: LinearModel, outputs: ArrayLike, N: Interval, D: int, g: float) -> float:
    """About so many `px4_predictor` takes, of some three nanoseconds each: very many in a fast loop with a short delay.
    Arguments and errors as there."""
    left, _ = visible(model, output_rows(outputs, model.states))
    step_radius = predictor_response.radius(left.Phi, D, g)
    if not below_one(step_radius):
        return 0.0
    return Fraction(N).denominator * predictor_response.multiplications(left.Phi, D, step_radius)


def px4_predictor(model: LinearModel, outputs: ArrayLike, N: Interval, D: int, g: float) -> Accuracy:
    """D: steps by which the horizon is behind, at least the delay of the measurements; L = D. g: dt / tau of the
    complementary filter, 0 < g; PX4's tau is 0.25 s. Other arguments and errors as `lossless`."""
    N = check_interval("N", N)
    check_steps("D", D, 0)
    if isinstance(g, bool) or not isinstance(g, int | float | np.number) or not 0.0 < g < np.inf:
        raise ValueError(f"g={g!r} must be positive: it is the period of a step over the time constant tau")
    if Fraction(N).denominator > MOST_INNOVATIONS:
        raise ValueError(
            f"measurements every {float(N):.9g} steps repeat their pattern after {Fraction(N).denominator:,} of them, "
            f"and what each leaves in the output is summed up for at most {MOST_INNOVATIONS}; take an interval that "
            f"repeats sooner"
        )
    left, C = visible(model, output_rows(outputs, model.states))
    found = regime(model, output_rows(outputs, model.states), N, ceil(N) + D)
    exact = in_steps(found, D)
    H, R = left.H, left.R
    K = gain(found.before, H, R)
    kept = K @ np.linalg.cholesky(H @ found.before @ H.T + R)  # the effect of an innovation of unit covariance
    steps = taken(N)
    cycle = int(steps[-1])
    step_radius = predictor_response.radius(left.Phi, D, g)
    with np.errstate(over="ignore"):
        radius = float(np.power(step_radius, float(N)))
    added, moves = np.zeros(cycle), np.zeros(cycle)
    if below_one(radius):
        for step, innovation in zip(steps, kept, strict=False):
            of = predictor_response.variances(left.Phi, C, cycle, D, g, innovation, step_radius)
            added += np.roll(of[0], step)
            moves += np.roll(of[1], step)
    return of_cycle(
        N,
        D,
        exact + added,
        float(worst_of(found, 0)),
        float(moves.max()),
        believed=float(exact.max()),
        radius=radius,
        verdict="approximate",
    )
