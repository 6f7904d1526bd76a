"""Four answers beside simulations that share no code with the product: vehicles, filters and gains are written here."""

from __future__ import annotations

import numpy as np
import pytest

from filters.accuracy import along, fused_as_fresh, lossless, px4_predictor
from filters.accuracy.periodic import steady
from filters.arrays import FloatArray
from tests.filters.accuracy.cases import CV
from tests.filters.accuracy.chi_square import assert_spread

VEHICLES = 20_000
PHI = np.array([[1.0, 1.0], [0.0, 1.0]])
Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
C = np.eye(2)[:1]


def disturbed(random: np.random.Generator) -> FloatArray:
    """Of constant velocity with white acceleration: the integral of the noise, and what is independent of it."""
    a, b = random.normal(size=(2, VEHICLES))
    return 0.1 * np.array([a / 2 + b / np.sqrt(12), a])


def settled_gain(N: int) -> tuple[FloatArray, FloatArray]:
    """K (2,) and P^-, by the textbook's recursion."""
    P = np.eye(2)
    for _ in range(300 * N):
        K = P[:, 0] / (P[0, 0] + 1.0)
        P = P - np.outer(K, P[0])
        for _ in range(N):
            P = PHI @ P @ PHI.T + Q
    return P[:, 0] / (P[0, 0] + 1.0), P


def test_several_measurements_in_flight() -> None:
    """N = 10, L = 14: a correction waits, carried along, and an innovation takes those that wait into account."""
    random, (K, P) = np.random.default_rng(1), settled_gain(10)
    x = np.linalg.cholesky(P) @ random.normal(size=(2, VEHICLES))
    estimate = np.zeros_like(x)
    waiting: list[tuple[int, FloatArray]] = []
    errors = []
    for j in range(100):
        if j > 0:
            x, estimate = PHI @ x + disturbed(random), PHI @ estimate
            waiting = [(due, PHI @ correction) for due, correction in waiting]
        if waiting and waiting[0][0] == j:
            estimate = estimate + waiting.pop(0)[1]
        if j % 10 == 0:
            expected = estimate[0] + sum(correction[0] for _, correction in waiting)
            innovation = x[0] + random.normal(size=VEHICLES) - expected
            waiting.append((j + 14, np.outer(K, innovation)))
        errors.append(estimate[0] - x[0])
    ages = 14 + (np.arange(60, 100) - 14) % 10
    assert_spread(np.array(errors[60:]), steady(CV, C, 10, 24).variances[0, ages])
    assert np.std(errors[63]) == pytest.approx(lossless(CV, [0], 10, 14).worst, rel=0.02)


def test_px4s_output_predictor() -> None:
    """N = 10, horizon 4 steps behind, g = 0.2; the buffer holds outputs, the truth its own past."""
    random, (K, P) = np.random.default_rng(2), settled_gain(10)
    truth = [np.linalg.cholesky(P) @ random.normal(size=(2, VEHICLES))]
    behind = np.zeros((2, VEHICLES))
    buffer = [behind]
    for _ in range(4):
        truth.append(PHI @ truth[-1] + disturbed(random))
        buffer.append(PHI @ buffer[-1])
    total, errors = np.zeros((2, VEHICLES)), []
    for j in range(400):
        if j > 0:
            truth = [*truth[1:], PHI @ truth[-1] + disturbed(random)]
            buffer = [*buffer[1:], PHI @ buffer[-1]]
            behind = PHI @ behind
        if j % 10 == 0:
            innovation = truth[0][0] + random.normal(size=VEHICLES) - behind[0]
            behind = behind + np.outer(K, innovation)
        err = behind - buffer[0]
        total = total + err
        buffer = [kept + 0.2 * err + 0.1 * 0.2**2 * total for kept in buffer]
        if j >= 390:
            errors.append(buffer[-1][0] - truth[-1][0])
    expected = px4_predictor(CV, [0], 10, 4, 0.2)
    spreads = np.square(errors).mean(axis=1)
    assert np.sqrt(spreads.max()) == pytest.approx(expected.worst, rel=0.02)
    assert np.sqrt(spreads.mean()) == pytest.approx(expected.rms, rel=0.01)


def test_a_late_measurement_fused_as_fresh() -> None:
    """At a constant velocity of 1: every vehicle's position lags by four metres and what noise adds."""
    random, (K, _) = np.random.default_rng(3), settled_gain(10)
    estimate = np.array([np.zeros(VEHICLES), np.ones(VEHICLES)])
    errors = []
    for j in range(4, 404):
        estimate = PHI @ estimate
        if j % 10 == 4:
            late = (j - 4) + random.normal(size=VEHICLES)
            estimate = estimate + np.outer(K, late - estimate[0])
        errors.append(estimate[0] - j)
    means = np.mean(errors[-10:], axis=1)
    np.testing.assert_allclose(means, -4.0, atol=0.1)
    assert fused_as_fresh(CV, [0], 10, 4, [4.0]).bias == pytest.approx(-means.mean(), abs=0.1)


def test_a_record_of_two_sensors_with_random_delays() -> None:
    """The filter starts anew in each step, from what has landed by then, and takes it in the order it was taken."""
    random = np.random.default_rng(4)
    steps, sigmas = 40, {"radar": 1.0, "camera": 0.5}
    landings = [("radar", k, k + int(random.integers(0, 18))) for k in range(0, steps, 5)]
    landings += [("camera", k, k + int(random.integers(0, 9))) for k in range(2, steps, 7)]
    states = [np.sqrt(5.0) * random.normal(size=(2, VEHICLES))]
    for _ in range(steps):
        states.append(PHI @ states[-1] + disturbed(random))
    readings = {(s, k): states[k][0] + sigmas[s] * random.normal(size=VEHICLES) for s, k, _ in landings}
    errors = []
    for j in range(steps + 1):
        x, P = np.zeros((2, VEHICLES)), 5.0 * np.eye(2)
        for i in range(j + 1):
            if i > 0:
                x, P = PHI @ x, PHI @ P @ PHI.T + Q
            for sensor, k, step in landings:
                if k == i and step <= j:
                    K = P[:, 0] / (P[0, 0] + sigmas[sensor] ** 2)
                    x, P = x + np.outer(K, readings[sensor, k] - x[0]), P - np.outer(K, P[0])
        errors.append(x[0] - states[j][0])
    sensors = {sensor: (CV.H, [[sigma**2]]) for sensor, sigma in sigmas.items()}
    found = along(CV.Phi, CV.Q, sensors, [0], 5.0 * np.eye(2), steps, landings)
    assert_spread(np.array(errors), found.deviations**2)
