"""A typical moment of a composed filter: what it has in memory once it has run for a while."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray
from filters.kernels.place import IntArray
from filters.modular.arrivals import whole
from filters.modular.breakdown import PREDICTOR, Failure, breakdown
from filters.modular.check import as_numbers, check_start
from filters.modular.composition import ModularFilter, Sensor, check_composed
from filters.modular.correction import correction
from filters.modular.estimate import empty, is_sound
from filters.modular.measurements import expected_by
from filters.modular.space import NOTHING, Space, plus
from filters.modular.trial import try_functions
from filters.modular.workspace import new_workspace
from filters.normal import normal
from filters.records import Estimate
from filters.seed import check_seed

WARM_UP = 12
"""Steps with a measurement of each sensor, after which the covariance is far from its start."""


class Moment(NamedTuple):
    """An estimate, the input of the step, and what each sensor measures in it."""

    estimate: Estimate
    u: FloatArray
    y: tuple[FloatArray, ...]


def typical_moment(
    composed: ModularFilter,
    x0: ArrayLike | None = None,
    P0: ArrayLike | None = None,
    u: ArrayLike | None = None,
    seed: int = 0,
) -> Moment:
    """The filter after some steps on measurements of its own model; its functions are tried first, one by one.

    x0 (numbers,): a typical state; zero, with attitudes that turn nothing, if not given. P0 (n, n): the covariance to
    start from; the unit matrix if not given. u: a typical input; if not given, zero for a linear predictor and an
    empty one for others.

    Raises:
        ValueError: a shape is wrong, P0 is no covariance, a function does not do what it should (see `trial`),
            or an estimate breaks down; it names the part.
    """
    check_composed(composed)
    check_seed(seed)
    space, random = composed.of, np.random.default_rng(seed)
    x, P = check_start(space, origin(space) if x0 is None else x0, np.eye(space.errors) if P0 is None else P0)
    inputs = np.zeros(_inputs(composed)) if u is None else as_numbers("u", u)
    if inputs.ndim != 1 or not np.isfinite(inputs).all():
        raise ValueError(f"u has shape {inputs.shape}; an input has one dimension, and finite numbers")
    try_functions(composed, Estimate(x, P), inputs)
    with np.errstate(all="ignore"):  # a breakdown is found by what it leaves
        at = _warmed_up(composed, Estimate(x, P), inputs, random)
    return Moment(at, inputs, tuple(expected_by(sensor, space)(at.x) for sensor in composed.sensors))


def near(composed: ModularFilter, typical: Moment, seed: int, index: int) -> Moment:
    """Another moment with memory of its own: each index has its values."""
    random = np.random.default_rng([seed, index])
    P = typical.estimate.P * random.uniform(0.9, 1.1)
    estimate = Estimate(drawn(composed.of, typical.estimate.x, P, random), P)
    y = [
        drawn(sensor.corrector.observed, value, sensor.corrector.R, random)
        for sensor, value in zip(composed.sensors, typical.y, strict=True)
    ]
    return Moment(estimate, typical.u.copy(), tuple(y))


def drawn(space: Space, point: FloatArray, covariance: FloatArray, random: np.random.Generator) -> FloatArray:
    """The point, moved by a normal error."""
    out = np.empty(space.numbers)
    plus(space, point, normal(random, covariance), out)
    return out


def _warmed_up(composed: ModularFilter, start: Estimate, u: FloatArray, random: np.random.Generator) -> Estimate:
    if composed.update == "u-d":  # on the covariance itself, for it is far from rounding
        composed = replace(composed, update="joseph")
    space, at = composed.of, start
    truth = drawn(space, at.x, at.P, random)
    for step in range(WARM_UP):
        for number, sensor in enumerate(composed.sensors):
            y = drawn(sensor.corrector.observed, expected_by(sensor, space)(truth), sensor.corrector.R, random)
            at = _sound(composed, number, step, Failure(at, _corrected(composed, sensor, at, y)), u)
        truth = drawn(space, evolved(composed, truth, u), composed.predictor.motion.Q, random)
        at = _sound(composed, PREDICTOR, step, Failure(at, _predicted(composed, at, u)), u)
    return at


def origin(space: Space) -> FloatArray:
    x = np.zeros(space.numbers)
    starts: IntArray = space.attitudes
    x[starts] = 1.0
    return x


def _inputs(composed: ModularFilter) -> int:
    motion = composed.predictor.motion
    return int(motion.B.shape[1]) if composed.predictor.kind == "linear" else 0


def evolved(composed: ModularFilter, x: FloatArray, u: FloatArray) -> FloatArray:
    """The state one step after x (numbers,), without noise."""
    motion = composed.predictor.motion
    if composed.predictor.kind == "linear":
        return np.asarray(motion.F @ x + motion.B @ u)
    out = np.empty_like(x)
    motion.f(x, u, composed.dt, out)
    return out


def _predicted(composed: ModularFilter, at: Estimate, u: FloatArray) -> Estimate:
    space, after = composed.of, empty(composed.of)
    predict, motion = composed.predictor.predict, composed.predictor.motion
    predict(motion, space, at, u, composed.dt, after, new_workspace(space, NOTHING))
    return after


def _corrected(composed: ModularFilter, sensor: Sensor, at: Estimate, y: FloatArray) -> Estimate:
    space, corrector, after = composed.of, sensor.corrector, empty(composed.of)
    view, observed = corrector.view(space.errors), corrector.observed
    work = new_workspace(space, observed)
    correction(composed, corrector)(view, observed, space, at, y, whole(observed), after, work)
    return after


def _sound(composed: ModularFilter, part: int, step: int, job: Failure, u: FloatArray) -> Estimate:
    """What a job left, if it is an estimate."""
    if not is_sound(composed.of, job.after, np.empty_like(job.after.P)):
        raise breakdown(composed, part, step, job, u)
    return job.after
