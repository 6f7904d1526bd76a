"""Sigma points: their weights, and how a mean and a covariance become points and points become these again."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.definite import covariance_root
from filters.kernels.dense import copy_vector
from filters.modular.space import Space, minus_each, plus, plus_each

MEAN_STEPS = 20
MEAN_TOLERANCE = 1e-24
"""The squared length of the last step towards a mean."""


class SigmaPoints(NamedTuple):
    """How sigma points are spread; made by `merwe` or `maccormack`."""

    form: Literal["merwe", "maccormack"]
    alpha: float
    beta: float
    kappa: float


def _checked(points: SigmaPoints) -> SigmaPoints:
    """The points. Raises ValueError unless they are of numbers that spread some for one state or another."""
    for name, value in zip(points._fields[1:], points[1:], strict=True):
        if not isinstance(value, int | float | np.integer | np.floating):
            raise ValueError(f"{points.form}: {name}={value!r:.60} must be a number")
    nowhere = points.alpha == 0 or (points.form == "maccormack" and points.kappa <= 0)
    if nowhere or not np.isfinite([points.alpha, points.beta, points.kappa]).all():
        raise _without_spread(points, "any number of states")
    return points


def _without_spread(points: SigmaPoints, states: str) -> ValueError:
    return ValueError(
        f"{points.form}: alpha={points.alpha}, beta={points.beta}, kappa={points.kappa} spread no sigma points for "
        f"{states}: alpha^2 times {'(n + kappa)' if points.form == 'merwe' else 'kappa'} must be greater than 0, and "
        f"all finite"
    )


class Weights(NamedTuple):
    """Point 0 is the mean, points i and n + i lie `spread` times column i of the root of P from it.

    mean_0, covariance_0: weights of point 0; other: of each other point, for both.
    """

    spread: float
    mean_0: float
    covariance_0: float
    other: float


def merwe(alpha: float = 1.0, beta: float = 2.0, kappa: float = 0.0) -> SigmaPoints:
    """The scaled points of van der Merwe: spread alpha sqrt(n + kappa).

    W_m0 = 1 - n / (alpha^2 (n + kappa)), W_c0 = W_m0 + 1 - alpha^2 + beta. Wan and van der Merwe, The unscented Kalman
    filter for nonlinear estimation, 2000. beta = 2 is best for a normal distribution.

    Raises ValueError for numbers that are none, or spread no points for any n.
    """
    return _checked(SigmaPoints("merwe", alpha, beta, kappa))


USUAL = merwe()


def maccormack(alpha: float = 1.0, beta: float = 2.0, kappa: float = 3.0) -> SigmaPoints:
    """The points of MacCormack and Rubinstein's modular filter: spread alpha sqrt(kappa), kappa in place of n + kappa.

    W_m0 = (alpha^2 kappa - n) / (alpha^2 kappa), W_c0 = W_m0 - alpha^2 + beta: 1 less than `merwe`'s.

    Raises ValueError as that does.
    """
    return _checked(SigmaPoints("maccormack", alpha, beta, kappa))


def weights(points: SigmaPoints, n: int) -> Weights:
    """The weights for errors of length n.

    Raises:
        ValueError: the points are none, or have no spread for this n.
    """
    if not isinstance(points, SigmaPoints):
        raise ValueError(f"points is {points!r:.60}; give merwe(...) or maccormack(...)")
    _checked(points)
    merwes = points.form == "merwe"
    scale = points.alpha * points.alpha * (points.kappa + n if merwes else points.kappa)
    if not 0 < scale < np.inf:
        raise _without_spread(points, f"{n} states")
    mean_0 = 1.0 - n / scale
    covariance_0 = mean_0 - points.alpha**2 + points.beta + (1.0 if merwes else 0.0)
    return Weights(float(np.sqrt(scale)), mean_0, covariance_0, 0.5 / scale)


def draw(
    space: Space, x: FloatArray, P: FloatArray, spread: float, root: FloatArray, errors: FloatArray, points: FloatArray
) -> None:
    """points (2 n + 1, numbers) of the mean x (numbers,) and the covariance P (n, n), through its Cholesky factor.

    errors (2 n + 1, n) = points less x; the zeros among them, before the diagonals, are those that it was made with.
    root (n, n): scratch.
    """
    n = space.errors
    covariance_root(P, root)
    for e in range(n):
        for i in range(e + 1):
            error = spread * root[e, i]
            errors[1 + i, e] = error
            errors[1 + n + i, e] = -error
    plus_each(space, x, errors, points)


def mean(
    space: Space, points: FloatArray, weighing: Weights, errors: FloatArray, step: FloatArray, out: FloatArray
) -> None:
    """out (numbers,) = the weighted mean of points (2 n + 1, numbers); errors (2 n + 1, errors) = points less mean.

    The mean is where the weighted errors vanish: a step from point 0 where all is plain; where attitudes or angles are
    among the numbers, steps are repeated until they vanish. step (errors,): scratch.
    """
    copy_vector(points[0], out)
    minus_each(space, points, out, errors)
    plain = len(space.attitudes) + len(space.angles) == 0
    for _ in range(MEAN_STEPS):
        for e in range(space.errors):
            step[e] = weighing.mean_0 * errors[0, e]
        for i in range(1, points.shape[0], 2):
            for e in range(space.errors):
                step[e] += weighing.other * errors[i, e] + weighing.other * errors[i + 1, e]
        plus(space, out, step, out)
        if plain:
            for i in range(points.shape[0]):
                for e in range(space.errors):
                    errors[i, e] -= step[e]
            break
        minus_each(space, points, out, errors)
        squared = 0.0
        for e in range(space.errors):
            squared += step[e] * step[e]
        if squared < MEAN_TOLERANCE:
            break


def add_covariance(left: FloatArray, right: FloatArray, weighing: Weights, out: FloatArray) -> None:
    """out (a, b) += the weighted sum of left_i right_i^T, for left (2 n + 1, a), right (2 n + 1, b).

    Two points at a time, so that `out` is read and written half as often.
    """
    for r in range(out.shape[0]):
        factor = weighing.covariance_0 * left[0, r]
        for c in range(out.shape[1]):
            out[r, c] += factor * right[0, c]
    for i in range(1, left.shape[0], 2):
        for r in range(out.shape[0]):
            first = weighing.other * left[i, r]
            second = weighing.other * left[i + 1, r]
            for c in range(out.shape[1]):
                out[r, c] += first * right[i, c] + second * right[i + 1, c]
