"""Roll back and replay: a late measurement counts as if it had come in time, from its arrival on and not before."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.delayed import recalculate
from filters.modular import Measurement, run
from tests.filters.modular.cases import (
    CASES,
    LINEAR,
    ONE_SENSOR,
    arriving,
    largest_error,
    measured,
    measured_rows,
    with_timing,
)

STEPS = {"linear": 8, "extended": 6, "unscented": 6, "attitude": 4}
DATA = st.data()


@pytest.mark.parametrize("name", CASES)
@settings(max_examples=25)
@given(data=DATA)
def test_it_is_the_filter_that_got_in_time_what_has_arrived_by_now(name: str, data: st.DataObject) -> None:
    case, steps = CASES[name], STEPS[name]
    measurements = data.draw(arriving(name, steps))
    found = run(
        case.composed, case.x0, case.P0, case.inputs(steps), measurements, history=steps + 1, backend="reference"
    )
    for j in range(steps + 1):
        in_time = [one._replace(arrives=one.taken) for one in measurements if one.arrives <= j]
        expected = run(case.composed, case.x0, case.P0, case.inputs(j), in_time, backend="reference")
        assert largest_error(case, found.x[[j]], expected.x[[-1]]) <= 1e-10
        np.testing.assert_allclose(found.P[j], expected.P[-1], rtol=0, atol=1e-10)


@settings(max_examples=50)
@given(data=DATA)
def test_linear_sensors_in_time_are_the_textbook(data: st.DataObject) -> None:
    """One line of NumPy per equation, for what has arrived at the end."""
    steps = 8
    measurements = data.draw(arriving("linear", steps))
    found = run(
        LINEAR.composed, LINEAR.x0, LINEAR.P0, LINEAR.inputs(steps), measurements, history=9, backend="reference"
    )
    x, P = LINEAR.x0, LINEAR.P0
    motion = LINEAR.composed.predictor.motion
    for j in range(steps + 1):
        if j > 0:
            x = motion.F @ x + motion.B @ LINEAR.u
            P = motion.F @ P @ motion.F.T + motion.Q
        for sensor in LINEAR.composed.sensors:
            H, R = sensor.corrector.view(2)
            for one in measurements:
                if (one.sensor, one.taken) == (sensor.name, j) and one.arrives <= steps:
                    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
                    x, P = x + K @ (one.y - H @ x), P - K @ H @ P
    np.testing.assert_allclose(found.x[-1], x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.P[-1], P, rtol=0, atol=1e-10)


@settings(max_examples=50)
@given(measurements=arriving("linear", 6))
def test_the_order_in_which_they_are_listed_does_not_matter(measurements: list[Measurement]) -> None:
    listed, sorted_by_step = (
        run(LINEAR.composed, LINEAR.x0, LINEAR.P0, LINEAR.inputs(6), given_so, history=7, backend="reference")
        for given_so in (measurements, sorted(measurements, key=lambda one: (one.taken, one.sensor)))
    )
    for found, expected in zip(listed, sorted_by_step, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", ONE_SENSOR)
@pytest.mark.parametrize(("every", "delay"), [(1, 0), (1, 1), (3, 1), (3, 3), (4, 2)])
def test_one_sensor_is_the_filter_of_the_system(name: str, every: int, delay: int) -> None:
    case, system = with_timing(ONE_SENSOR[name], every, delay)
    measurements = measured(case, 11)
    found = run(case.composed, case.x0, case.P0, case.inputs(11), measurements, backend="reference")
    expected = recalculate.run(
        system, every, delay, delay, case.x0, case.P0, case.inputs(11), measured_rows(measurements)
    )
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-10)
