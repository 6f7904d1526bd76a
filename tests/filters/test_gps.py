"""The patent's example: its model, its consistency with chi-square, and how little n = 5 costs in accuracy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chi2

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.delayed import standard
from filters.error_covariance import true_covariance
from filters.system import System
from filters.systems.gps import (
    CLOCK_BIAS,
    CLOCK_DRIFT,
    POSITION,
    VELOCITY,
    gps,
    gps_coarse,
    gps_start,
    pseudoranges,
    simulate_flight,
)

STEPS = 240


def test_the_model_over_n_periods_is_that_of_one_applied_n_times() -> None:
    n, fine = 5, gps(steps=20).parameters
    Phi, Q = np.eye(8), np.zeros((8, 8))
    for _ in range(n):
        Phi, Q = fine.Phi @ Phi, fine.Phi @ Q @ fine.Phi.T + fine.Q
    for noise, share in (("averaged", n), ("sampled", 1)):
        coarse = gps_coarse(n, steps=20, noise=noise).parameters
        np.testing.assert_allclose(coarse.Phi, Phi, rtol=1e-12)
        np.testing.assert_allclose(coarse.Q, Q, rtol=1e-12, atol=1e-15)
        np.testing.assert_array_equal(coarse.H, fine.H)
        np.testing.assert_allclose(coarse.R, fine.R / share)


def test_noise_reaches_the_state_by_four_ways() -> None:
    """To the lowest order in T, Q = Gamma q Gamma^T T: rank four, in velocity and clock drift."""
    T = 1e-6
    driven = [*range(8)[VELOCITY], CLOCK_DRIFT]
    Q = gps(T, 1, acceleration_noise=2.0, clock_noise=3.0).parameters.Q / T
    np.testing.assert_allclose(np.diag(Q)[driven], [4.0, 4.0, 4.0, 9.0])
    np.testing.assert_allclose(Q - np.diag(np.diag(Q)), 0.0, atol=1e-5)
    assert np.linalg.matrix_rank(Q, tol=1e-5) == 4


def test_H_is_the_derivative_of_the_pseudoranges() -> None:
    system, steps = gps(steps=600), 1000.0 * np.eye(8)
    for k in (0, 300, 600):
        differences = [(pseudoranges(system, k, d) - pseudoranges(system, k, -d)) / 2000.0 for d in steps]
        H = system.H(k, np.zeros(8), system.parameters)
        np.testing.assert_allclose(np.array(differences).T, H, atol=1e-7)


def test_satellites_are_well_spread_and_move() -> None:
    system = gps(period_s=60.0, steps=30)
    for H in system.parameters.H:
        dilution = np.linalg.inv(H[:, [0, 1, 2, CLOCK_BIAS]].T @ H[:, [0, 1, 2, CLOCK_BIAS]])
        assert np.sqrt(np.trace(dilution[:3, :3])) < 2.4
        assert np.all(-H[:, 2] > np.sin(np.radians(10)))
    distance = np.linalg.norm(system.parameters.satellites_m[0] - [0, 0, -6_371e3], axis=-1)
    np.testing.assert_allclose(distance, 26_560e3)
    speed = np.linalg.norm(np.diff(gps(steps=1).parameters.satellites_m, axis=0), axis=-1)
    assert np.all((speed > 2_500) & (speed < 4_000))  # m/s, as seen from the turning Earth


def errors(system: System, n: int, seeds: range) -> tuple[FloatArray, FloatArray]:
    """Of flights with true ranges: errors (flights, steps + 1, 8) and their true covariance (steps + 1, 8, 8)."""
    found = []
    for seed in seeds:
        flight = simulate_flight(system, STEPS, seed)
        record = flight.x0, flight.P0, flight.inputs, flight.truth.measurements
        history = multirate_gain.run(system, n, *record, coarse=gps_coarse(n, steps=STEPS), backend="numpy")
        found.append(history.x - flight.truth.x)
    return np.array(found), true_covariance(system, flight.P0, history.gains).after


@pytest.mark.parametrize("n", [1, 5])
@pytest.mark.exhaust
def test_errors_are_as_large_as_the_true_covariance_says(n: int) -> None:
    """NEES: the mean over flights times their number is chi-square with 8 degrees of freedom each."""
    flights = 40
    error, P = errors(gps(steps=STEPS), n, range(flights))
    for j in (0, 7, 30, 60, 120, 180, 240):
        nees = np.einsum("fi,fi->", error[:, j], np.linalg.solve(P[j], error[:, j].T).T)
        low, high = chi2.ppf([0.0005, 0.9995], 8 * flights)
        assert low < nees < high


def test_how_close_a_gain_every_five_seconds_comes() -> None:
    """Settled: 2.6 % more position error (1 sigma) than with a gain every second, 1.1 % more velocity error."""
    system = gps(steps=STEPS)
    nothing = np.zeros(8), gps_start(), np.zeros((STEPS, 0))
    measurements = np.zeros((STEPS + 1, 4))
    optimal = standard.run(system, 1, 0, 0, *nothing, measurements, backend="numpy")
    coarse = gps_coarse(5, steps=STEPS)
    fifth = multirate_gain.run(system, 5, *nothing, measurements, coarse=coarse, backend="numpy")
    after = [true_covariance(system, nothing[1], gains).after[-1] for gains in (fifth.gains, optimal.gains)]
    for states, more in ((POSITION, 1.0261), (VELOCITY, 1.0109)):
        found, best = (np.sqrt(np.trace(P[states, states])) for P in after)
        assert found / best == pytest.approx(more, abs=0.002)


@pytest.mark.parametrize("bad", [{"period_s": 0.0}, {"range_sigma_m": -1.0}, {"steps": -1}])
def test_bad_arguments(bad: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=r"gps: period_s=.* must be positive, steps=.* at least 0"):
        gps(**bad)
    with pytest.raises(ValueError, match="n=0 must be at least 1"):
        gps_coarse(0)
