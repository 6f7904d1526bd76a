"""A late measurement used as if it had just been taken: what its filter does not know is how far the vehicle has moved.

So do filters without a memory of the past, for instance robot_localization without its lagged smoothing.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.exact import lossless
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.periodic import steady
from filters.accuracy.prefix import prefix
from filters.accuracy.riccati import gain, steady_prior
from filters.accuracy.visible import visible
from filters.arrays import FloatArray, as_array


class Mean(NamedTuple):
    """The mean output error (N, outputs) in each step from a landing on, once it repeats; radius: of what makes it."""

    errors: FloatArray
    radius: float


def fused_as_fresh(model: LinearModel, outputs: ArrayLike, N: int, M: int, displacement: ArrayLike) -> Accuracy:
    """displacement (p,): h(x_m) - h(x_k), how far the measured quantity moves while the measurement is under way; of a
    motion that is stated, for with a random one the mean error would look like noise.

    The scatter is that of a filter without delay, and that its covariance believes. Other arguments and errors as
    `lossless`; ValueError too for a wrong displacement.
    """
    check_steps("M", M, 0)
    best = lossless(model, outputs, N, 0)
    C = output_rows(outputs, model.states)
    variances = steady(model, C, [N], N).variances[0, :N]
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


def mean_error(model: LinearModel, outputs: ArrayLike, N: int, displacement: ArrayLike) -> Mean:
    """Of the filter of `fused_as_fresh`: ebar^+ = (I - K H) ebar^- - K d, and the model's propagation between."""
    moved = as_array("displacement", displacement)
    if moved.shape != (len(model.H),) or not np.isfinite(moved).all():
        raise ValueError(f"displacement={displacement!r}: give {len(model.H)} finite numbers, one for each measurement")
    left, C = visible(model, output_rows(outputs, model.states))
    over = prefix(left, N)
    K = gain(steady_prior(over.Phi[N], over.Q[N], left.H, left.R), left.H, left.R)
    kept = np.eye(left.states) - K @ left.H
    after = np.linalg.solve(np.eye(left.states) - kept @ over.Phi[N], -K @ moved)
    radius = float(np.abs(np.linalg.eigvals(kept @ over.Phi[N])).max())
    return Mean(np.asarray(np.einsum("oi,aij,j->ao", C, over.Phi[:N], after)), radius)
