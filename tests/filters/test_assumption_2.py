"""Steffes Sec. III.A, assumption 2: no measurement may be taken while another one is under way. Where it breaks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.covariance_forms import covariance_form
from filters.delayed.larsen import extrapolated_update
from filters.delayed.standard import propagate, update
from filters.kernels.dense import matmul
from filters.records import Estimate, new_correction, new_estimate, new_workspace
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system

M = 6
FORM = covariance_form("textbook")


class TwoSensors(NamedTuple):
    """One process seen by a slow sensor, delayed by M steps, and by a fast one in every step."""

    slow: System
    fast: System
    inputs: FloatArray
    slow_measurement: FloatArray
    fast_measurements: FloatArray


def two_sensors() -> TwoSensors:
    slow = example_system(4, 1, 2, seed=3)
    matrices = slow.parameters
    fast = linear_system(matrices.Phi, matrices.B, np.eye(1, 4), matrices.Q, np.eye(1))
    inputs = np.random.default_rng(1).normal(size=(M, 1))
    start = np.zeros(4), np.eye(4)
    slow_truth = simulate_truth(slow, M + 1, *start, inputs, seed=2)
    fast_truth = simulate_truth(fast, 1, *start, inputs, seed=2)
    return TwoSensors(slow, fast, inputs, slow_truth.measurements[0], fast_truth.measurements)


def updated(system: System, k: int, y: FloatArray, before: Estimate) -> Estimate:
    after = new_estimate(system)
    update(system, FORM, k, y, before, after, new_correction(system), new_workspace(system))
    return after


def propagated(system: System, j: int, before: Estimate, u: FloatArray) -> tuple[Estimate, FloatArray]:
    after = new_estimate(system)
    Phi = propagate(system, FORM, j, before, u, after, new_workspace(system))
    return after, Phi


def optimal(sensors: TwoSensors, *, fast: bool) -> Estimate:
    """At m, with each measurement used in the step in which it was taken."""
    estimate = updated(sensors.slow, 0, sensors.slow_measurement, Estimate(np.zeros(4), np.eye(4)))
    for j in range(M):
        estimate, _ = propagated(sensors.slow, j, estimate, sensors.inputs[j])
        if fast:
            estimate = updated(sensors.fast, j + 1, sensors.fast_measurements[j + 1], estimate)
    return estimate


def extrapolated(sensors: TwoSensors, *, fast: bool) -> Estimate:
    """At m, with the slow measurement used only there, by Larsen's equations; Eqs. (13), (19) give the same."""
    system = sensors.slow
    reference = estimate = Estimate(np.zeros(4), np.eye(4))
    Phi_from_k = np.eye(4)
    for j in range(M):
        estimate, Phi = propagated(system, j, estimate, sensors.inputs[j])
        product = np.empty((4, 4))
        matmul(Phi, Phi_from_k, product)
        Phi_from_k = product
        if fast:
            estimate = updated(sensors.fast, j + 1, sensors.fast_measurements[j + 1], estimate)
    after, correction, work = new_estimate(system), new_correction(system), new_workspace(system)
    y = sensors.slow_measurement
    extrapolated_update(system, FORM, 0, y, reference, Phi_from_k, estimate, after, correction, work)
    return after


def test_extrapolation_is_optimal_while_nothing_else_is_measured() -> None:
    sensors = two_sensors()
    found, expected = extrapolated(sensors, fast=False), optimal(sensors, fast=False)
    np.testing.assert_allclose(found.x, expected.x, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found.P, expected.P, rtol=1e-12, atol=1e-12)


def test_extrapolation_is_wrong_by_so_much_when_something_else_is_measured_meanwhile() -> None:
    """Phi_{k->m} ignores that the updates in between have already removed a part of the error of k."""
    sensors = two_sensors()
    found, expected = extrapolated(sensors, fast=True), optimal(sensors, fast=True)
    wrong = np.linalg.norm(found.x - expected.x) / np.linalg.norm(expected.x)
    assert wrong == pytest.approx(0.1938, abs=1e-4)
    claimed = np.trace(found.P) / np.trace(expected.P)
    assert claimed == pytest.approx(0.9010, abs=1e-4)  # it believes to be better than the optimum
