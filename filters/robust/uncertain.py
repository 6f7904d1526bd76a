"""A nonlinear system whose noise enters through a matrix and whose matrices are uncertain, and its scaling.

The robust filter's penalties mu and lambda weigh all states alike, so it works in units of `Scaling`, where typical
errors are of one size. A latitude in radians beside a speed in m/s would leave the smallest singular value of its
matrix P with two right digits after 40,000 steps.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.robust.records import RobustModel

Parameters: TypeAlias = Any  # of one system: a named tuple of floats


class Scaling(NamedTuple):
    """Scaled states are (x - origin) / unit, both (n,); scaled measurements are y / measurement_unit (p,)."""

    origin: FloatArray
    unit: FloatArray
    measurement_unit: FloatArray


class Uncertainty(NamedTuple):
    """The matrices of `RobustModel` that say what is uncertain, for scaled states and measurements."""

    E_F: FloatArray
    E_G: FloatArray
    E_H: FloatArray
    E_D: FloatArray
    M1: FloatArray
    M2: FloatArray


class UncertainSystem(NamedTuple):
    """x_{i+1} = f(x_i, u_i) + G w_i and y_i = h(x_i) + v_i, w ~ N(0, Q) and v ~ N(0, R), in the units of the state.

    f(x, u, parameters, out): writes x_{i+1} into out (n,), from x (n,) and u. out is not x.
    F(x, u, parameters, out): writes df/dx into out (n, n), all of it.
    G(x, u, parameters, out): writes the noise matrix into out (n, m), all of it.
    residual(y, x, out): writes y - h(x) into out (p,), angles in (-pi, pi].
    H (p, n) is dh/dx, constant; Q (m, m), R (p, p).
    parameters: passed to the functions; a named tuple of floats.

    The functions are plain Python that numba can compile, as in `System`.
    """

    f: Callable[[FloatArray, FloatArray, Parameters, FloatArray], None]
    F: Callable[[FloatArray, FloatArray, Parameters, FloatArray], None]
    G: Callable[[FloatArray, FloatArray, Parameters, FloatArray], None]
    residual: Callable[[FloatArray, FloatArray, FloatArray], None]
    H: FloatArray
    Q: FloatArray
    R: FloatArray
    parameters: Parameters


def linearised(
    system: UncertainSystem, scaling: Scaling, uncertainty: Uncertainty, x: FloatArray, u: FloatArray
) -> RobustModel:
    """The scaled model at x (n,), in the units of the state."""
    n, m, p = len(x), len(system.Q), len(system.R)
    F, G = np.empty((n, n)), np.empty((n, m))
    system.F(x, u, system.parameters, F)
    system.G(x, u, system.parameters, G)
    unit, measurement_unit = scaling.unit, scaling.measurement_unit
    return RobustModel(
        F=F * unit / unit[:, np.newaxis],
        G=G / unit[:, np.newaxis],
        H=system.H * unit / measurement_unit[:, np.newaxis],
        D=np.eye(p),
        Q=system.Q,
        R=system.R / np.outer(measurement_unit, measurement_unit),
        **uncertainty._asdict(),
    )


def no_uncertainty(states: int, noises: int, measurements: int) -> Uncertainty:
    """Matrices without rows: the filter is then the extended Kalman filter, when mu is infinite."""
    return Uncertainty(
        np.zeros((0, states)),
        np.zeros((0, noises)),
        np.zeros((0, states)),
        np.zeros((0, measurements)),
        np.zeros((states, 1)),
        np.zeros((measurements, 1)),
    )
