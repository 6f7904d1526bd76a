"""Biases of the rocket's sensors are the same in a flight, and what the filter makes of them."""

from __future__ import annotations

import numpy as np
import pytest

from filters.systems.rocket_filter import ACCELEROMETER, CAMERA, GPS, SENSORS, sensors
from studies.modular.biases import CASES, NONE, Biases, bias_study, biased, drawn
from studies.modular.rocket_flights import flight, measure


def test_a_bias_is_added_to_every_measurement_of_its_sensor_and_to_no_other() -> None:
    measured = measure(0.0, 0, flight(0, "reference").states[:40])
    bias = drawn(Biases((GPS,), 1.0), 0)
    for before, after in zip(measured, biased(measured, bias), strict=True):
        if before.sensor == GPS:
            np.testing.assert_allclose(np.subtract(after.y, before.y), bias[GPS])
        else:
            assert after is before


def test_the_cameras_bias_turns_its_quaternion() -> None:
    measured = [one for one in measure(0.0, 0, flight(0, "reference").states[:40]) if one.sensor == CAMERA]
    bias = {CAMERA: np.array([0.0, 0.2, 0.0])}
    for before, after in zip(measured, biased(measured, bias), strict=True):
        assert np.linalg.norm(after.y) == pytest.approx(1.0)
        assert 2 * np.arccos(abs(np.dot(before.y, after.y))) == pytest.approx(0.2)


def test_biases_grow_with_their_size_and_have_the_noise_as_their_deviation() -> None:
    noise = {each.name: np.sqrt(np.diagonal(each.corrector.R)) for each in sensors()}
    one, three = (drawn(Biases(SENSORS, size), 5) for size in (1.0, 3.0))
    for name in SENSORS:
        np.testing.assert_allclose(three[name], 3 * one[name])
        of_flights = np.array([drawn(Biases((name,), 1.0), seed)[name] for seed in range(200)])
        np.testing.assert_allclose(of_flights.std(axis=0), noise[name], rtol=0.2)
        np.testing.assert_allclose(of_flights[5], one[name])
    assert drawn(NONE, 5) == {}


@pytest.mark.exhaust
def test_a_biased_accelerometer_moves_the_velocity() -> None:
    none, biased_row = bias_study(range(2), (NONE, Biases((ACCELEROMETER,), 1.0)))
    assert (biased_row.errors.rms[:, 1] > 2 * none.errors.rms[:, 1]).all()


def test_each_sensor_is_biased_alone_and_all_are_together() -> None:
    assert [case.sensors for case in CASES] == [(), *((name,) for name in SENSORS), SENSORS, SENSORS]
