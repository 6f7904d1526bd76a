"""A late measurement used as if it had just been taken: what its filter does not know is how far the vehicle has moved.

So do filters without a memory of the past, for instance robot_localization without its lagged smoothing.
"""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.exact import lossless
from filters.accuracy.gains import NO_GAIN
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.pattern import Interval, check_interval, check_repeats, taken
from filters.accuracy.prefix import prefix
from filters.accuracy.regime import in_steps, regime
from filters.accuracy.repeating import repeating_priors
from filters.accuracy.riccati import below_one, gain
from filters.accuracy.visible import visible
from filters.arrays import FloatArray, as_array


class Mean(NamedTuple):
    """The mean output error (steps, outputs) in each step of a repetition, from a landing on; radius: of what makes it,
    over a repetition."""

    errors: FloatArray
    radius: float


def fused_as_fresh(model: LinearModel, outputs: ArrayLike, N: Interval, M: int, displacement: ArrayLike) -> Accuracy:
    """displacement (p,): h(x_m) - h(x_k), how far the measured quantity moves while the measurement is under way; of a
    motion that is stated, for with a random one the mean error would look like noise.

    The scatter is that of a filter without delay, and that its covariance believes. Other arguments and errors as
    `lossless`; ValueError too for a wrong displacement.
    """
    check_steps("M", M, 0)
    N = check_interval("N", N)
    check_repeats(N)
    best = lossless(model, outputs, N, 0)
    C = output_rows(outputs, model.states)
    variances = in_steps(regime(model, C, N, ceil(N)), 0)
    mean = mean_error(model, C, N, displacement)
    return of_cycle(
        N,
        M,
        variances,
        best.no_delay**2,
        best.jump**2,
        believed=best.worst**2,
        means=mean.errors,
        radius=mean.radius,
        verdict="approximate",
    )


def mean_error(model: LinearModel, outputs: ArrayLike, N: Interval, displacement: ArrayLike) -> Mean:
    """Of the filter of `fused_as_fresh`: ebar^+ = (I - K H) ebar^- - K d, and the model's propagation between."""
    moved = as_array("displacement", displacement)
    if moved.shape != (len(model.H),) or not np.isfinite(moved).all():
        raise ValueError(f"displacement={displacement!r}: give {len(model.H)} finite numbers, one for each measurement")
    left, C = visible(model, output_rows(outputs, model.states))
    intervals = np.diff(taken(N))
    over, identity = prefix(left, ceil(N)), np.eye(left.states)
    K = gain(repeating_priors(over.Phi[intervals], over.Q[intervals], left.H, left.R), left.H, left.R)
    kept = identity - K @ left.H
    brought, left_over = identity, np.zeros(left.states)  # what a repetition makes of the mean error after its first
    for n, later in zip(intervals, np.roll(np.arange(len(intervals)), -1), strict=True):
        brought = kept[later] @ over.Phi[n] @ brought
        left_over = kept[later] @ over.Phi[n] @ left_over - K[later] @ moved
    radius = float(np.abs(np.linalg.eigvals(brought)).max())
    if not below_one(radius):
        raise ValueError(NO_GAIN)
    errors, after = [], np.linalg.solve(identity - brought, left_over)
    for n, later in zip(intervals, np.roll(np.arange(len(intervals)), -1), strict=True):
        errors.append(np.einsum("oi,aij,j->ao", C, over.Phi[:n], after))
        after = kept[later] @ over.Phi[n] @ after - K[later] @ moved
    return Mean(np.concatenate(errors), radius)
