"""A modular filter as the linear model that it is at one state: what its covariance does there."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.sensors import SensorsModel, sensors_model
from filters.arrays import FloatArray, as_array
from filters.kernels.dense import copy_diagonal
from filters.modular.check import check_start
from filters.modular.composition import ModularFilter, Sensor, check_composed
from filters.modular.correctors import NumericView, UnscentedView, observe_numeric
from filters.modular.predictors import NumericMotion, UnscentedMotion, evolve_numeric
from filters.modular.space import NOTHING
from filters.modular.trial import try_functions
from filters.modular.typical import origin
from filters.modular.workspace import new_workspace
from filters.records import Estimate


def linearised_filter(
    composed: ModularFilter, x0: ArrayLike | None = None, P0: ArrayLike | None = None, u: ArrayLike | None = None
) -> SensorsModel:
    """Phi, Q of the predictor, H and R of each sensor, at the state x0 (numbers,) under the input u.

    Not given are zero, with attitudes that turn nothing. P0 (n, n): where Jacobians are taken by differences, its
    deviations give their steps; the unit matrix if not given. Those of unscented parts are always: of what their points
    add to the first order of a model there is nothing.

    Raises:
        ValueError: a shape is wrong, P0 is no covariance, or a function does not do what it should (see `trial`); it
            names the part.
    """
    check_composed(composed)
    space = composed.of
    x, P = check_start(space, origin(space) if x0 is None else x0, np.eye(space.errors) if P0 is None else P0)
    motion = composed.predictor.motion
    inputs = motion.B.shape[1] if composed.predictor.kind == "linear" else 0
    move = np.zeros(inputs) if u is None else as_array("u", u)
    try_functions(composed, Estimate(x, P), move)
    work = new_workspace(space, NOTHING)
    copy_diagonal(P, work.variances)
    evolve = composed.predictor.evolve
    if evolve is None:
        assert isinstance(motion, UnscentedMotion)
        evolve, motion = evolve_numeric, NumericMotion(motion.f, motion.Q)
    evolve(motion, space, x, move, composed.dt, np.empty_like(x), work)
    sensors = {sensor.name: (_seen(composed, sensor, x, P), sensor.corrector.R) for sensor in composed.sensors}
    return sensors_model(work.F, motion.Q, sensors)


def _seen(composed: ModularFilter, sensor: Sensor, x: FloatArray, P: FloatArray) -> FloatArray:
    """H (p, n)."""
    corrector = sensor.corrector
    work = new_workspace(composed.of, corrector.observed)
    copy_diagonal(P, work.variances)
    view, observe = corrector.view(composed.of.errors), corrector.observe
    if observe is None:
        assert isinstance(view, UnscentedView)
        view, observe = NumericView(view.h, view.R), observe_numeric
    observe(view, corrector.observed, composed.of, x, work)
    return work.H
