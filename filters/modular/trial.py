"""Try the functions of a composed filter once: what is wrong with one is best said by its name, before it is compiled.

Compiled code does not look at the bounds of arrays: a function that reads an input that is not there would go on with
whatever lies behind it.
"""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter


def try_functions(composed: ModularFilter, x: FloatArray, u: FloatArray) -> None:
    """Call each of the user's functions at the state x (numbers,) with the input u.

    Raises:
        ValueError: one fails, changes x, returns what it should write into out, or leaves a number that is not finite;
            it names the predictor or the sensor, the function and what came back.
    """
    motion, dt, n = composed.predictor.motion, composed.dt, composed.of.errors
    if composed.predictor.kind == "linear":
        if motion.B.shape[1] not in (0, len(u)):
            raise ValueError(f"predictor: B has {motion.B.shape[1]} columns, but the input has {len(u)} numbers")
    else:
        _try("predictor: f(x, u, dt, out)", motion.f, (x, u, dt), (len(x),), np.nan)
        if hasattr(motion, "jacobian"):
            _try("predictor: jacobian(x, u, dt, out)", motion.jacobian, (x, u, dt), (n, n), 0.0)
    for sensor in composed.sensors:
        if sensor.corrector.kind != "linear":
            view, observed = sensor.corrector.view(n), sensor.corrector.observed
            _try(f"sensor {sensor.name!r}: h(x, out)", view.h, (x,), (observed.numbers,), np.nan)
            if hasattr(view, "jacobian"):
                what = f"sensor {sensor.name!r}: jacobian(x, out)"
                _try(what, view.jacobian, (x,), (observed.errors, n), 0.0)


def _try(
    what: str, function: Callable[..., Any], given: tuple[Any, ...], shape: tuple[int, ...], unwritten: float
) -> None:
    """unwritten: what out holds beforehand; a Jacobian may leave its zeros as they are."""
    if not isinstance(function, FunctionType):
        raise ValueError(f"{what} is a {type(function).__name__}; give a plain function, made by def or lambda")
    before = [np.copy(value) for value in given]
    out = np.full(shape, unwritten)
    sizes = ", ".join(f"{name} {np.shape(value)}" for name, value in zip("xu", given[:2], strict=False))
    try:
        with np.errstate(all="ignore"):
            returned = function(*given, out)
    except Exception as error:
        raise ValueError(f"{what} failed: {type(error).__name__}: {error} ({sizes}, out {shape})") from error
    if returned is not None:
        raise ValueError(
            f"{what} returned a {type(returned).__name__} of shape {np.shape(returned)}; it must write into out, which "
            f"has shape {shape}, and return nothing"
        )
    if not all(np.array_equal(value, copy) for value, copy in zip(given, before, strict=True)):
        raise ValueError(f"{what} changes what it is given; it must write into out only")
    if not np.isfinite(out).all():
        where = ", ".join(str(index) for index in np.argwhere(~np.isfinite(out)).tolist()[:3])
        raise ValueError(
            f"{what} left in out {out.tolist()}: not written, or not finite, is {where}; it must write all of "
            f"shape {shape} and be finite at x = {given[0].tolist()}"
        )
