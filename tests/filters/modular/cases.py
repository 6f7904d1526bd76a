"""Modular filters to prove laws on: of each kind of part, with plain states and with an attitude, and data for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.kernels.quaternion import rotate_back, turn
from filters.modular import (
    Measurement,
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    observe,
    run,
    space,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.as_system import composed_system
from filters.modular.predictors import Predictor
from filters.modular.space import minus
from filters.system import System
from filters.systems.linear import linear_system

F = np.array([[1.0, 0.3], [-0.2, 0.9]])
B = np.array([[0.0], [0.3]])
Q = np.array([[0.02, 0.01], [0.01, 0.03]])
H_POSITION, R_POSITION = np.array([[1.0, 0.0]]), np.array([[0.2]])
H_BOTH, R_BOTH = np.array([[1.0, 0.5], [0.0, 1.0]]), np.array([[0.5, 0.1], [0.1, 0.3]])


class Case(NamedTuple):
    """A filter, where it starts, and its input of a step."""

    composed: ModularFilter
    x0: FloatArray
    P0: FloatArray
    u: FloatArray

    def inputs(self, steps: int) -> FloatArray:
        """The same input in every step."""
        return np.tile(self.u, (steps, 1))

    def with_sensors(self, *sensors: Sensor) -> Case:
        """The same with other sensors."""
        composed = self.composed
        return self._replace(composed=ModularFilter(composed.predictor, sensors, composed.dt, composed.of))


def pendulum(x: FloatArray, u: FloatArray, dt: float, out: FloatArray) -> None:
    out[0] = x[0] + dt * x[1]
    out[1] = x[1] + dt * (u[0] - np.sin(x[0]))


def pendulum_jacobian(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    out[:] = np.array([[1.0, dt], [-dt * np.cos(x[0]), 1.0]])


def height_jacobian(x: FloatArray, out: FloatArray) -> None:
    out[0, 0], out[0, 1] = np.sin(x[0]), 0.0


def height(x: FloatArray, out: FloatArray) -> None:
    out[0] = 1.0 - np.cos(x[0])


def swing(x: FloatArray, out: FloatArray) -> None:
    out[0] = np.sin(x[0])
    out[1] = x[1]


def gyroscope(x: FloatArray, u: FloatArray, dt: float, out: FloatArray) -> None:
    """An attitude turned at the rate u, less the bias x[4:]."""
    turn(x, 0, dt * (u - x[4:]), 0, out)
    out[4:] = x[4:]


def field(x: FloatArray, out: FloatArray) -> None:
    rotate_back(x, 0, np.array([0.6, 0.0, 0.8]), 0, out)


def attitude(x: FloatArray, out: FloatArray) -> None:
    out[:] = x[:4]


def linear_case(*sensors: Sensor) -> Case:
    composed = ModularFilter(linear_predictor(F, Q, B), sensors)
    return Case(composed, np.array([1.0, -0.5]), np.array([[1.0, 0.2], [0.2, 0.8]]), np.array([0.7]))


def pendulum_case(predictor: Callable[..., Predictor], *sensors: Sensor) -> Case:
    composed = ModularFilter(predictor(pendulum, 0.1 * Q), sensors, dt=0.2)
    return Case(composed, np.array([0.8, 0.1]), 0.1 * np.eye(2), np.array([0.2]))


def attitude_case(predictor: Callable[..., Predictor], *sensors: Sensor) -> Case:
    composed = ModularFilter(predictor(gyroscope, 1e-4 * np.eye(6)), sensors, dt=0.5, of=space(7, attitudes=[0]))
    x0 = np.array([0.8, 0.0, 0.6, 0.0, 0.01, 0.0, -0.02])
    return Case(composed, x0, np.diag([0.02] * 3 + [1e-3] * 3), np.array([0.3, -0.2, 0.4]))


LINEAR = linear_case(
    Sensor("position", linear_corrector(H_POSITION, R_POSITION), every=2, delay=3, dropout=0.3),
    Sensor("both", linear_corrector(H_BOTH, R_BOTH), dropout=0.5),
)
EXTENDED = pendulum_case(
    extended_predictor,
    Sensor("height", extended_corrector(height, [[0.01]]), every=3, delay=2),
    Sensor("swing", extended_corrector(swing, 0.04 * np.eye(2)), every=2, dropout=0.5),
)
UNSCENTED = pendulum_case(
    unscented_predictor,
    Sensor("height", unscented_corrector(height, [[0.01]]), every=3, delay=2),
    Sensor("position", linear_corrector(H_POSITION, R_POSITION), every=2, delay=1, dropout=0.5),
)
ATTITUDE = attitude_case(
    unscented_predictor,
    Sensor("field", extended_corrector(field, 1e-3 * np.eye(3)), every=2, delay=1),
    Sensor("stars", unscented_corrector(attitude, 1e-4 * np.eye(3), observed=space(4, attitudes=[0])), every=3),
)
JACOBIANS = pendulum_case(
    lambda f, noise: extended_predictor(f, noise, pendulum_jacobian),
    Sensor("height", extended_corrector(height, [[0.01]], height_jacobian)),
)
POSITION = linear_case(Sensor("position", linear_corrector(H_POSITION, R_POSITION)))
ONE_SENSOR = {
    "linear": (POSITION, linear_system(F, B, H_POSITION, Q, R_POSITION)),
    "extended": (JACOBIANS, composed_system(JACOBIANS.composed, JACOBIANS.P0, 1)),
}
"""Filters with one sensor, and the same as systems for the filters that are not modular."""

CASES = {"linear": LINEAR, "extended": EXTENDED, "unscented": UNSCENTED, "attitude": ATTITUDE}


def measured(case: Case, steps: int, seed: int = 0) -> list[Measurement]:
    """What the sensors measure along the path from x0 on which nothing disturbs the state."""
    path = run(case.with_sensors().composed, case.x0, case.P0, case.inputs(steps), [], backend="reference").x
    return observe(case.composed, path, seed)


def measured_rows(measurements: list[Measurement]) -> FloatArray:
    """The measurements of one sensor as rows, in the order in which they were taken."""
    return np.array([one.y for one in sorted(measurements, key=lambda one: one.taken)])


def with_timing(one_sensor: tuple[Case, System], every: int, delay: int) -> tuple[Case, System]:
    """The same, with its sensor at this rate and delay."""
    case, system = one_sensor
    (sensor,) = case.composed.sensors
    return case.with_sensors(replace(sensor, every=every, delay=delay)), system


@cache
def everything(name: str, steps: int) -> list[Measurement]:
    """What the sensors of the case of this name would give if each measured in every step, without delay."""
    case = CASES[name]
    always = [replace(sensor, every=1, delay=0, dropout=0.0) for sensor in case.composed.sensors]
    return measured(case.with_sensors(*always), steps)


@st.composite
def arriving(draw: st.DrawFn, name: str, steps: int) -> list[Measurement]:
    """Any of `everything`, each with any delay, in any order."""
    delays = st.none() | st.integers(0, steps + 1)
    found = [(one, draw(delays)) for one in everything(name, steps)]
    return draw(st.permutations([one._replace(arrives=one.taken + late) for one, late in found if late is not None]))


def errors_between(case: Case, found: FloatArray, expected: FloatArray) -> FloatArray:
    """The errors (any, n) that take the expected states (any, numbers) to the found ones."""
    errors = np.zeros((len(found), case.composed.of.errors))
    for a, b, error in zip(found, expected, errors, strict=True):
        minus(case.composed.of, a, b, error)
    return errors


def largest_error(case: Case, found: FloatArray, expected: FloatArray) -> float:
    """The largest number in them."""
    return float(np.abs(errors_between(case, found, expected)).max())
