"""A modular filter with one sensor as a system: the same model, for the filters that take a `System`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.dense import add_matvec, copy, matvec
from filters.modular.composition import ModularFilter, check_composed
from filters.modular.correctors import ExtendedView, LinearView, NumericView, expect_numeric
from filters.modular.predictors import ExtendedMotion, LinearMotion, NumericMotion, predict_numeric
from filters.modular.space import NOTHING, Space
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Estimate
from filters.system import System

ALLOCATION_FREE = False  # the matrices it returns are new arrays


class Scratch(NamedTuple):
    """What Jacobians by differences are taken with."""

    moved: Estimate
    predicting: Workspace
    correcting: Workspace


class ComposedParameters(NamedTuple):
    """motion, view: the models of predictor and corrector. dt: of a step.

    Where Jacobians are taken by differences, the deviations of P0 (n, n) give their steps.
    """

    motion: Any
    observation: Any
    dt: float
    of: Space
    observed: Space
    P0: FloatArray
    scratch: Scratch


def composed_system(composed: ModularFilter, P0: FloatArray, inputs: int) -> System:
    """The system of a filter whose predictor and only sensor are linear or extended, on plain quantities.

    P0 (n, n): the covariance to start from. inputs: how many numbers an input has.
    """
    check_composed(composed)
    (sensor,) = composed.sensors
    n, observed = composed.of.errors, sensor.corrector.observed
    motion, observation = composed.predictor.motion, sensor.corrector.view(n)
    parameters = ComposedParameters(
        motion,
        observation,
        composed.dt,
        composed.of,
        observed,
        P0,
        Scratch(
            Estimate(np.zeros(n), np.zeros((n, n))),
            new_workspace(composed.of, NOTHING),
            new_workspace(composed.of, observed),
        ),
    )
    f, F = _MOTIONS[type(motion)]
    h, H = _VIEWS[type(observation)]
    return System(n, inputs, observed.errors, f, F, _Q, h, H, _R, parameters)


def _f_linear(_j: int, x: FloatArray, u: FloatArray, parts: ComposedParameters, out: FloatArray) -> None:
    matvec(parts.motion.F, x, out)
    add_matvec(parts.motion.B, u, out)


def _F_linear(_j: int, _x: FloatArray, _u: FloatArray, parts: ComposedParameters) -> FloatArray:
    F: FloatArray = parts.motion.F
    return F


def _f(_j: int, x: FloatArray, u: FloatArray, parts: ComposedParameters, out: FloatArray) -> None:
    parts.motion.f(x, u, parts.dt, out)


def _F(_j: int, x: FloatArray, u: FloatArray, parts: ComposedParameters) -> FloatArray:
    out = np.zeros((len(x), len(x)))
    parts.motion.jacobian(x, u, parts.dt, out)
    return out


def _F_numeric(_j: int, x: FloatArray, u: FloatArray, parts: ComposedParameters) -> FloatArray:
    work = parts.scratch.predicting
    predict_numeric(parts.motion, parts.of, Estimate(x, parts.P0), u, parts.dt, parts.scratch.moved, work)
    out = np.empty((len(x), len(x)))
    copy(work.F, out)
    return out


def _Q(_j: int, parts: ComposedParameters) -> FloatArray:
    Q: FloatArray = parts.motion.Q
    return Q


def _h_linear(_k: int, x: FloatArray, parts: ComposedParameters, out: FloatArray) -> None:
    matvec(parts.observation.H, x, out)


def _H_linear(_k: int, _x: FloatArray, parts: ComposedParameters) -> FloatArray:
    H: FloatArray = parts.observation.H
    return H


def _h(_k: int, x: FloatArray, parts: ComposedParameters, out: FloatArray) -> None:
    parts.observation.h(x, out)


def _H(_k: int, x: FloatArray, parts: ComposedParameters) -> FloatArray:
    out = np.zeros((parts.observed.errors, len(x)))
    parts.observation.jacobian(x, out)
    return out


def _H_numeric(_k: int, x: FloatArray, parts: ComposedParameters) -> FloatArray:
    work = parts.scratch.correcting
    expect_numeric(parts.observation, parts.observed, parts.of, Estimate(x, parts.P0), work)
    out = np.empty((parts.observed.errors, len(x)))
    copy(work.H, out)
    return out


def _R(_k: int, parts: ComposedParameters) -> FloatArray:
    R: FloatArray = parts.observation.R
    return R


_Functions = tuple[Callable[..., Any], Callable[..., FloatArray]]
_MOTIONS: dict[type, _Functions] = {
    LinearMotion: (_f_linear, _F_linear),
    ExtendedMotion: (_f, _F),
    NumericMotion: (_f, _F_numeric),
}
_VIEWS: dict[type, _Functions] = {
    LinearView: (_h_linear, _H_linear),
    ExtendedView: (_h, _H),
    NumericView: (_h, _H_numeric),
}
