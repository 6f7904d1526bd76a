"""Try the functions of a composed filter once: what is wrong with one is best said by its name, before it is compiled.

Compiled code does not look at the bounds of arrays: a function that reads an input that is not there would go on with
whatever lies behind it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.correctors import NumericView, expect_numeric
from filters.modular.predictors import NumericMotion, predict_numeric
from filters.modular.space import NOTHING, Space, is_point
from filters.modular.workspace import new_workspace
from filters.records import Estimate

TOLERANCE = 1e-3
"""Jacobians may differ by this share of the largest effect in their row."""
ROUNDING = 1e-11
"""What differences of a thousandth of a deviation lose to rounding, as a share of the values that they are of."""


def try_functions(composed: ModularFilter, at: Estimate, u: FloatArray | None) -> None:
    """Call each of the user's functions at an estimate, with the input u; without one the predictor's are left out.

    Raises:
        ValueError: one fails, changes x, returns what it should write into out, or leaves a number that is not finite;
            or a Jacobian is not that of its function. It names the predictor or the sensor, the function and what came
            back.
    """
    if u is not None:
        _try_predictor(composed, at, u)
    for sensor in composed.sensors:
        if sensor.corrector.kind != "linear":
            _try_sensor(composed, sensor, at)


def _try_predictor(composed: ModularFilter, at: Estimate, u: FloatArray) -> None:
    motion, dt, space, x = composed.predictor.motion, composed.dt, composed.of, at.x
    n = space.errors
    if composed.predictor.kind == "linear":
        if motion.B.shape[1] not in (0, len(u)):
            raise ValueError(f"predictor: B has {motion.B.shape[1]} columns, but the input has {len(u)} numbers")
    else:
        what = "predictor: f(x, u, dt, out)"
        _check_attitudes(what, space, _try(what, motion.f, (x, u, dt), (len(x),), np.nan), x)
        if hasattr(motion, "jacobian"):
            what = "predictor: jacobian(x, u, dt, out)"
            F = _try(what, motion.jacobian, (x, u, dt), (n, n), 0.0)
            work = new_workspace(space, NOTHING)
            after = Estimate(np.empty_like(x), np.empty((n, n)))
            predict_numeric(NumericMotion(motion.f, motion.Q), space, at, u, dt, after, work)
            _compare(what, F, work.F, at, after.x)


def _try_sensor(composed: ModularFilter, sensor: Sensor, at: Estimate) -> None:
    space, observed, view = composed.of, sensor.corrector.observed, sensor.corrector.view(composed.of.errors)
    what = f"sensor {sensor.name!r}: h(x, out)"
    _check_attitudes(what, observed, _try(what, view.h, (at.x,), (observed.numbers,), np.nan), at.x)
    if hasattr(view, "jacobian"):
        what = f"sensor {sensor.name!r}: jacobian(x, out)"
        H = _try(what, view.jacobian, (at.x,), (observed.errors, space.errors), 0.0)
        work = new_workspace(space, observed)
        expect_numeric(NumericView(view.h, view.R), observed, space, at, work)
        _compare(what, H, work.H, at, work.expected)


def _check_attitudes(what: str, space: Space, out: FloatArray, x: FloatArray) -> None:
    if not is_point(space, out):
        raise ValueError(
            f"{what} left in out {out.tolist()}, with an attitude that has no length, at x = {x.tolist()}; write a "
            f"unit quaternion, scalar first"
        )


def _try(
    what: str, function: Callable[..., Any], arguments: tuple[Any, ...], shape: tuple[int, ...], unwritten: float
) -> FloatArray:
    """What the function wrote. unwritten: what out holds beforehand; a Jacobian may leave its zeros as they are."""
    before = [np.copy(value) for value in arguments]
    out = np.full(shape, unwritten)
    sizes = ", ".join(f"{name} {np.shape(value)}" for name, value in zip("xu", arguments[:2], strict=False))
    try:
        with np.errstate(all="ignore"):
            returned = function(*arguments, out)
    except Exception as error:
        raise ValueError(f"{what} failed: {type(error).__name__}: {error} ({sizes}, out {shape})") from error
    if returned is not None:
        raise ValueError(
            f"{what} returned a {type(returned).__name__} of shape {np.shape(returned)}; it must write into out, which "
            f"has shape {shape}, and return nothing"
        )
    if not all(np.array_equal(value, copy) for value, copy in zip(arguments, before, strict=True)):
        raise ValueError(f"{what} changes what it is given; it must write into out only")
    if not np.isfinite(out).all():
        where = ", ".join(str(index) for index in np.argwhere(~np.isfinite(out)).tolist()[:3])
        raise ValueError(
            f"{what} left in out {out.tolist()}: not written, or not finite, is {where}; it must write all of "
            f"shape {shape} and be finite at x = {arguments[0].tolist()}"
        )
    return out


def _compare(what: str, jacobian: FloatArray, differences: FloatArray, at: Estimate, values: FloatArray) -> None:
    """Raises ValueError if two Jacobians differ in what a typical error does; values: of the function itself."""
    deviations = np.sqrt(np.diag(at.P))
    deviations[deviations == 0.0] = deviations.min(where=deviations > 0.0, initial=1.0)
    effects, wrong = np.abs(differences) * deviations, np.abs(jacobian - differences) * deviations
    excess = wrong - TOLERANCE * effects.max(axis=1, keepdims=True) - ROUNDING * np.abs(values).max()
    row, column = np.unravel_index(np.argmax(excess), excess.shape)
    if excess[row, column] > 0:
        raise ValueError(
            f"{what} gives {jacobian[row, column]:.6g} in [{row}, {column}], where differences give "
            f"{differences[row, column]:.6g}, at x = {at.x.tolist()}; it is the derivative by the errors of x (of an "
            f"attitude, by a rotation vector in the frame of the body): mend it, or leave it out"
        )
