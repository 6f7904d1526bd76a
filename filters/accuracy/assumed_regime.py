"""The regime of a filter whose gain is not the best one, after each measurement of a repetition (`gains`, `regime`)."""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

import numpy as np

from filters.accuracy.gains import NO_GAIN, CycleNoise, with_assumed
from filters.accuracy.model import LinearModel
from filters.accuracy.pattern import Interval, check_repeats, taken
from filters.accuracy.periodic import by_age, noise_by_age, not_found, or_infinite
from filters.accuracy.prefix import prefix
from filters.accuracy.regime import Regime
from filters.accuracy.repeating import radius_of_repetition, repeating_covariances, repeating_priors
from filters.accuracy.riccati import below_one, gain, updated
from filters.accuracy.unseen import check_seen
from filters.accuracy.visible import visible
from filters.arrays import FloatArray


class AssumedRegime(NamedTuple):
    """regime: as it is; before is what the filter's own P says. believed (q, ages): variances as that P has them.
    radius: of the error over a repetition, unstable from 1 on, and then nothing of the regime is finite."""

    regime: Regime
    believed: FloatArray
    radius: float


def assumed_regime(
    model: LinearModel, outputs: FloatArray, N: Interval, oldest: int, cycle_noise: CycleNoise
) -> AssumedRegime:
    """cycle_noise: what the filter takes for the noise of a cycle, of as many steps as that has. Other arguments and
    errors as `regime`; ValueError too for a repetition that is too long."""
    if isinstance(N, int):
        one = with_assumed(model, outputs, N, oldest, cycle_noise)
        _check_gain(one.radius)
        found = Regime(np.array([N]), one.believed_before[None], one.variances[None], one.jumps[None])
        return AssumedRegime(found, one.believed[None], one.radius)
    check_repeats(N)
    reduced, C = visible(model, outputs)
    check_seen(model, outputs, N)
    intervals = np.diff(taken(N))
    with np.errstate(over="ignore", invalid="ignore"):
        over = prefix(reduced, max(ceil(N), oldest))
        Phi, H, R = over.Phi[intervals], reduced.H, reduced.R
        noises = {int(n): cycle_noise(reduced, int(n)) for n in np.unique(intervals)}
        prior = repeating_priors(Phi, np.array([noises[int(n)] for n in intervals]), H, R)
        if not np.isfinite(prior).all():
            raise ValueError(not_found(N, over.Phi[ceil(N)]))
        K = gain(prior, H, R)
        A, driven = Phi @ (np.eye(reduced.states) - K @ H), Phi @ K
        radius = radius_of_repetition(A)
        _check_gain(radius)
        truth = repeating_covariances(A, driven @ R @ np.swapaxes(driven, -1, -2) + over.Q[intervals])
        noise = noise_by_age(over, C, oldest)
        moved = K @ (H @ truth @ H.T + R) @ np.swapaxes(K, -1, -2)
        found = Regime(
            intervals,
            prior,
            or_infinite(by_age(over, C, updated(truth, K, H, R), oldest) + noise),
            or_infinite(by_age(over, C, moved, oldest)),
        )
        believed = or_infinite(by_age(over, C, updated(prior, K, H, R), oldest) + noise)
        return AssumedRegime(found, believed, radius)


def _check_gain(radius: float) -> None:
    """Raises ValueError where the gain of a mode is zero, and its error neither grows nor decays."""
    if not below_one(radius) and radius < 1.0 + 1e-9:
        raise ValueError(NO_GAIN)
