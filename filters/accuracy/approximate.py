"""The accuracy of filters whose gain is not that of the true model, and of one that never corrects."""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.assumed_regime import assumed_regime
from filters.accuracy.exact import lossless
from filters.accuracy.gains import Assumed, halved_noise, summed_noise, with_assumed
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, diverging, of_cycle
from filters.accuracy.pattern import Interval, check_interval
from filters.accuracy.regime import in_steps, worst_of
from filters.accuracy.riccati import below_one, steady_state
from filters.accuracy.visible import seen
from filters.arrays import FloatArray, as_array
from filters.choice import check_choice
from filters.covariances import check_measurement_noise
from filters.delayed.low_rate_noise import LowRateNoise


def with_low_rate_noise(
    model: LinearModel, outputs: ArrayLike, N: Interval, L: int, low_rate_noise: LowRateNoise
) -> Accuracy:
    """The dual rate filter with the noise of N steps only summed, "sum" (Steffes 2014, Eq. 23), or half of it taken
    through the transition, "euler" (Eq. 24). "exact": `lossless`. Arguments and errors as there."""
    check_choice("low_rate_noise", low_rate_noise, ("exact", "sum", "euler"))
    if low_rate_noise == "exact":
        return lossless(model, outputs, N, L)
    N = check_interval("N", N)
    check_steps("L", L, 0)
    C = output_rows(outputs, model.states)
    noise = summed_noise if low_rate_noise == "sum" else halved_noise
    of, believed, radius = assumed_regime(model, C, N, ceil(N) + L, noise)
    return of_cycle(
        N,
        L,
        in_steps(of, L),
        lossless(model, C, N, 0).no_delay ** 2,
        float(of.jumps[:, L].max()),
        believed=float(worst_of(of._replace(variances=believed), L)),
        radius=radius,
        verdict="approximate",
    )


def with_wrong_noise(model: LinearModel, outputs: ArrayLike, N: int, L: int, R: ArrayLike) -> Accuracy:
    """A filter that takes R (p, p) for the covariance of the measurement noise. Other arguments and errors as
    `lossless`."""
    C = _checked(model, outputs, N, L)
    assumed = as_array("R", R)
    if assumed.shape != model.R.shape:
        raise ValueError(f"R has shape {assumed.shape}, needed is {model.R.shape}, that of the model's own")
    check_measurement_noise(assumed, None)
    return _outcome(lossless(model, C, N, 0), L, with_assumed(model, C, N, N + L, R=assumed))


def with_divided_gain(model: LinearModel, outputs: ArrayLike, n: int, *, averaged: bool = True) -> Accuracy:
    """A measurement in every step, N = 1, L = 0; the gain is that over n steps, divided by n (the multirate gain).

    averaged: it is computed with R / n, as of the mean of n measurements; else with R. Other arguments and errors as
    `lossless`.
    """
    check_steps("n", n, 1)
    C = _checked(model, outputs, 1, 0)
    share = n if averaged else 1
    return _outcome(lossless(model, C, 1, 0), 0, with_assumed(model, C, 1, 1, R=model.R / share, divided=n))


def discarded(model: LinearModel, outputs: ArrayLike, N: Interval) -> Accuracy:
    """Measurements that are late are thrown away: with a fixed delay, all of them. Arguments and errors as `lossless`.

    Only what decays by itself has an accuracy then; else it diverges.
    """
    N, C = check_interval("N", N), output_rows(outputs, model.states)
    no_delay = lossless(model, C, N, 0).no_delay
    part, rows = seen(model, C)
    radius = float(np.abs(np.linalg.eigvals(part.Phi)).max())
    if not below_one(radius):
        return diverging(N, no_delay**2, radius)
    variances = np.array([np.trace(rows @ steady_state(part.Phi, part.Q) @ rows.T)])
    settled = of_cycle(1, 0, variances, no_delay**2, 0.0, radius=radius, verdict="approximate")
    return settled._replace(N=N, L=None, oldest=None, mean_age=None)


def _checked(model: LinearModel, outputs: ArrayLike, N: int, L: int) -> FloatArray:
    check_steps("N", N, 1)
    check_steps("L", L, 0)
    return output_rows(outputs, model.states)


def _outcome(best: Accuracy, L: int, regime: Assumed) -> Accuracy:
    window = slice(L, L + ceil(best.N))
    return of_cycle(
        best.N,
        L,
        regime.variances[window],
        best.no_delay**2,
        float(regime.jumps[L]),
        believed=float(regime.believed[window].max()),
        radius=regime.radius,
        verdict="approximate",
    )
