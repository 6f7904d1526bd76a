"""Is a filter as accurate as it says? The normalised estimation error squared, and the bounds it must keep to.

e^T P^-1 e of an error e of length n is chi-square with n degrees of freedom if P is the covariance of e and e is
normal; the mean over R independent runs is chi-square with R n, over R. Above the bounds a filter is too sure of
itself, below them it knows more than it says. Bar-Shalom, Li and Kirubarajan, Estimation with applications to tracking
and navigation, 2001.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray

CONFIDENCE = 0.95


class Bounds(NamedTuple):
    """Between which the mean over runs lies with the confidence asked for, as often below as above."""

    low: float
    high: float


class Consistency(NamedTuple):
    """NEES of some runs beside its bounds.

    runs, n: their number, and the length of an error. mean (steps,): over the runs. overall: of all runs and steps,
    n if the filter is consistent; standard_error: of it, from the differences between the runs. inside, below, above:
    the share of steps in which the mean is there; inside is about the confidence if the filter is consistent, but
    neighbouring steps are not independent of each other, so that it varies more than a share of as many independent
    draws.
    """

    runs: int
    n: int
    mean: FloatArray
    bounds: Bounds
    overall: float
    standard_error: float
    inside: float
    below: float
    above: float


def nees(errors: FloatArray, P: FloatArray) -> FloatArray:
    """e^T P^-1 e (...) of errors (..., n) with the covariances P (..., n, n) that the filter gives them.

    The error of an attitude is the rotation vector between truth and estimate, as in `filters.modular.space.minus`.

    Raises:
        ValueError: the shapes do not fit each other.
        numpy.linalg.LinAlgError: a P is singular.
    """
    if P.shape != (*errors.shape, errors.shape[-1]):
        raise ValueError(f"nees: errors have shape {errors.shape}, P {P.shape}; needed are (..., n) and (..., n, n)")
    normalised = np.linalg.solve(P, errors[..., np.newaxis])[..., 0]
    squared: FloatArray = np.sum(errors * normalised, axis=-1)
    return squared


def bounds(runs: int, n: int, confidence: float = CONFIDENCE) -> Bounds:
    """Two-sided bounds of the mean NEES over independent runs, for errors of length n."""
    from scipy.stats import chi2  # takes half a second to import, and only this needs it

    tail = (1.0 - confidence) / 2.0
    low, high = chi2.ppf([tail, 1.0 - tail], runs * n) / runs
    return Bounds(float(low), float(high))


def consistency(errors: FloatArray, P: FloatArray, confidence: float = CONFIDENCE) -> Consistency:
    """Consistency of independent runs: errors (runs, steps, n) and P (runs, steps, n, n)."""
    runs, _steps, n = errors.shape
    values = nees(errors, P)
    mean: FloatArray = values.mean(axis=0)
    limits = bounds(runs, n, confidence)
    below, above = float(np.mean(mean < limits.low)), float(np.mean(mean > limits.high))
    spread = float(values.mean(axis=1).std(ddof=1) / np.sqrt(runs)) if runs > 1 else float("nan")
    return Consistency(runs, n, mean, limits, float(mean.mean()), spread, 1.0 - below - above, below, above)
