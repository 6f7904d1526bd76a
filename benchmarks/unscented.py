"""Composed filters, compiled, against FilterPy's: 9 states (position, velocity, acceleration), 3 measurements a step.

All filter a whole record, predict and correct in every step, and keep the estimate of each. FilterPy does so in its own
loop where it has one, and gets models in the form that it is quickest with. Half the time of our linear filter goes
into checking and sorting the measurements.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter, KalmanFilter, MerweScaledSigmaPoints, UnscentedKalmanFilter

from benchmarks.timing import Result, times_faster
from filters.arrays import FloatArray
from filters.modular import (
    ModularFilter,
    Sensor,
    extended_corrector,
    linear_corrector,
    linear_predictor,
    merwe,
    observe,
    run,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.correctors import Corrector
from filters.modular.predictors import Predictor

STEPS = 4000
DT = 0.1
F = np.kron([[1.0, DT, DT * DT / 2], [0.0, 1.0, DT], [0.0, 0.0, 1.0]], np.eye(3))
Q = 0.01 * np.eye(9)
H, R_POSITION = np.eye(3, 9), np.eye(3)
R_RADAR = np.diag([1.0, 1e-4, 1e-4])
X0, P0 = np.array([100.0, 50.0, 60.0, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0]), np.eye(9)


def move(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    """Each axis on its own, with the acceleration that it has."""
    for i in range(3):
        out[i] = x[i] + dt * x[3 + i] + 0.5 * dt * dt * x[6 + i]
        out[3 + i] = x[3 + i] + dt * x[6 + i]
        out[6 + i] = x[6 + i]


def radar(x: FloatArray, out: FloatArray) -> None:
    """Range, azimuth, elevation."""
    out[0] = np.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])
    out[1] = np.arctan2(x[1], x[0])
    out[2] = np.arcsin(x[2] / out[0])


def radar_jacobian(x: FloatArray, out: FloatArray) -> None:
    ground = x[0] * x[0] + x[1] * x[1]
    squared = ground + x[2] * x[2]
    flat, distance = np.sqrt(ground), np.sqrt(squared)
    out[0, 0], out[0, 1], out[0, 2] = x[0] / distance, x[1] / distance, x[2] / distance
    out[1, 0], out[1, 1] = -x[1] / ground, x[0] / ground
    out[2, 0], out[2, 1] = -x[0] * x[2] / (squared * flat), -x[1] * x[2] / (squared * flat)
    out[2, 2] = flat / squared


def results() -> Iterator[Result]:
    moving = linear_predictor(F, Q)
    unscented = unscented_corrector(radar, R_RADAR, merwe())
    yield _result("UnscentedKalmanFilter", unscented_predictor(move, Q, merwe()), unscented, _unscented, 50)
    yield _result("ExtendedKalmanFilter", moving, extended_corrector(radar, R_RADAR, radar_jacobian), _extended, 10)
    yield _result("KalmanFilter", moving, linear_corrector(H, R_POSITION), _linear, 10)


def _result(
    name: str,
    predictor: Predictor,
    corrector: Corrector,
    theirs: Callable[[list[FloatArray]], FloatArray],
    target: float,
) -> Result:
    composed = ModularFilter(predictor, [Sensor("only", corrector)], DT)
    record = [one for one in observe(composed, _truth(), 1) if one.taken > 0]
    inputs = np.zeros((STEPS, 0))
    measured = [one.y for one in record]

    def ours() -> FloatArray:
        return run(composed, X0, P0, inputs, record, backend="compiled").x[1:]

    np.testing.assert_allclose(ours(), theirs(measured), rtol=1e-9, atol=1e-9)
    ratio = times_faster(ours, lambda: theirs(measured))
    return Result(f"composed filter: faster than FilterPy's {name}", ratio, target)


def _truth() -> FloatArray:
    x = np.empty((STEPS + 1, 9))
    x[0] = X0 + 0.3
    for j in range(STEPS):
        move(x[j], np.empty(0), DT, x[j + 1])
    return x


def _unscented(measured: list[FloatArray]) -> FloatArray:
    def radar_of(x: FloatArray) -> tuple[float, float, float]:
        a, b, c = x.item(0), x.item(1), x.item(2)
        distance = math.sqrt(a * a + b * b + c * c)
        return distance, math.atan2(b, a), math.asin(c / distance)

    points = MerweScaledSigmaPoints(9, alpha=1.0, beta=2.0, kappa=0.0)
    kalman = UnscentedKalmanFilter(9, 3, DT, radar_of, lambda x, _dt: F @ x, points)
    _start(kalman, R_RADAR)
    return np.asarray(kalman.batch_filter(measured)[0])


def _extended(measured: list[FloatArray]) -> FloatArray:
    def radar_of(x: FloatArray) -> FloatArray:
        a, b, c = x.item(0), x.item(1), x.item(2)
        distance = math.sqrt(a * a + b * b + c * c)
        return np.array((distance, math.atan2(b, a), math.asin(c / distance)))

    def jacobian_of(x: FloatArray) -> FloatArray:
        out = np.zeros((3, 9))
        radar_jacobian(x, out)
        return out

    kalman = ExtendedKalmanFilter(dim_x=9, dim_z=3)
    kalman.F = F
    _start(kalman, R_RADAR)
    found = np.empty((len(measured), 9))
    for row, y in zip(found, measured, strict=True):
        kalman.predict()
        kalman.update(y, jacobian_of, radar_of)
        row[:] = kalman.x
    return found


def _linear(measured: list[FloatArray]) -> FloatArray:
    kalman = KalmanFilter(dim_x=9, dim_z=3)
    kalman.F, kalman.H = F, H
    _start(kalman, R_POSITION)
    return np.asarray(kalman.batch_filter(measured)[0])


def _start(kalman: Any, R: FloatArray) -> None:
    kalman.x, kalman.P, kalman.Q, kalman.R = X0.copy(), P0.copy(), Q, R
