"""The oscillator is exact, and the tracker's covariance settles at the solution of the Riccati equation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm, solve_discrete_are

from filters.arrays import FloatArray
from filters.modular import (
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    observe,
    run,
    unscented_corrector,
    unscented_predictor,
)
from filters.systems.spring_mass import (
    Instrument,
    Oscillator,
    frequency,
    motion,
    period_s,
    tracker,
    transition,
    white_jerk,
)

DT_S, JERK_NOISE = 0.02, 18.0
POSITION, ACCELERATION = Instrument(0.05), Instrument(0.5)


# -------------------------------------------------------------------------------------------------- the oscillator


@pytest.mark.parametrize(
    "oscillator", [Oscillator(), Oscillator(damping_n_s_m=0.0), Oscillator(2.0, 30.0, 9.0), Oscillator(0.5, 0.1, 0.01)]
)
def test_motion_is_the_solution_of_its_differential_equation(oscillator: Oscillator) -> None:
    mass, spring, damping = oscillator
    A = np.array([[0.0, 1.0], [-spring / mass, -damping / mass]])
    time_s = np.array([0.0, 0.01, 0.7, 5.0, 40.0])
    expected = np.array([expm(A * time) @ [0.8, -1.3] for time in time_s])
    found = motion(oscillator, time_s, 0.8, -1.3)
    np.testing.assert_allclose(found[:, :2], expected, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(found[:, 2], expected @ A[1], rtol=1e-10, atol=1e-11)


def test_without_damping_it_comes_back_after_a_period() -> None:
    oscillator = Oscillator(damping_n_s_m=0.0)
    found = motion(oscillator, [0.0, period_s(oscillator)], 1.0, 0.5)
    np.testing.assert_allclose(found[1], found[0], atol=1e-14)


def test_with_light_damping_it_loses_a_third_in_20_periods() -> None:
    found = motion(Oscillator(), [0.0, 20 * period_s(Oscillator())], 1.0, 0.0)
    assert found[1, 0] == pytest.approx(2 / 3, abs=0.01)


@pytest.mark.parametrize(
    "oscillator", [Oscillator(0.0), Oscillator(1.0, 0.0), Oscillator(damping_n_s_m=-0.1), Oscillator(1.0, 1.0, 2.0)]
)
def test_what_does_not_oscillate_is_refused(oscillator: Oscillator) -> None:
    with pytest.raises(ValueError, match="a stronger one lets nothing oscillate"):
        frequency(oscillator)


# ------------------------------------------------------------------------------------------------------ the tracker


@pytest.mark.parametrize("dt_s", [0.001, 0.02, 1.5])
def test_transition_and_noise_are_those_of_white_jerk(dt_s: float) -> None:
    """By the matrix exponential of Van Loan, "Computing integrals involving the matrix exponential", 1978."""
    A, density = np.diag([1.0, 1.0], 1), np.diag([0.0, 0.0, JERK_NOISE**2])
    both = expm(np.block([[-A, density], [np.zeros((3, 3)), A.T]]) * dt_s)
    F = both[3:, 3:].T
    np.testing.assert_allclose(transition(dt_s), F, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(white_jerk(dt_s, JERK_NOISE), F @ both[:3, 3:], rtol=1e-9)


def test_each_sensor_has_its_own_rate_and_dropout() -> None:
    composed = tracker(DT_S, JERK_NOISE, Instrument(0.05, every=5, dropout=0.8), Instrument(0.5, every=2))
    assert [(one.name, one.every, one.dropout) for one in composed.sensors] == [
        ("position", 5, 0.8),
        ("acceleration", 2, 0.0),
    ]
    assert composed.dt == DT_S
    measurements = observe(composed, np.zeros((1001, 3)), seed=3)
    assert {one.taken % 5 for one in measurements if one.sensor == "position"} == {0}
    assert sum(one.sensor == "position" for one in measurements) == pytest.approx(0.2 * 201, abs=15)
    assert sum(one.sensor == "acceleration" for one in measurements) == 501


def test_bad_numbers_are_refused() -> None:
    with pytest.raises(ValueError, match=r"dt_s=0\.0 must be positive"):
        tracker(0.0, JERK_NOISE, POSITION, ACCELERATION)
    with pytest.raises(ValueError, match="R is not positive definite"):
        tracker(DT_S, JERK_NOISE, Instrument(0.0), ACCELERATION)
    with pytest.raises(ValueError, match=r"sensor 'acceleration': dropout=1\.5"):
        tracker(DT_S, JERK_NOISE, POSITION, Instrument(0.5, dropout=1.5))


# ------------------------------------------------------------------------------------------- its steady covariance


def move(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    out[0] = x[0] + dt * x[1] + dt * dt / 2 * x[2]
    out[1] = x[1] + dt * x[2]
    out[2] = x[2]


def see_position(x: FloatArray, out: FloatArray) -> None:
    out[0] = x[0]


def see_acceleration(x: FloatArray, out: FloatArray) -> None:
    out[0] = x[2]


Q = white_jerk(DT_S, JERK_NOISE)
R_POSITION, R_ACCELERATION = [[POSITION.sigma**2]], [[ACCELERATION.sigma**2]]
PREDICTORS = {
    "linear": linear_predictor(transition(DT_S), Q),
    "extended": extended_predictor(move, Q),
    "unscented": unscented_predictor(move, Q),
}
CORRECTORS = {
    "linear": (linear_corrector([[1, 0, 0]], R_POSITION), linear_corrector([[0, 0, 1]], R_ACCELERATION)),
    "extended": (extended_corrector(see_position, R_POSITION), extended_corrector(see_acceleration, R_ACCELERATION)),
    "unscented": (
        unscented_corrector(see_position, R_POSITION),
        unscented_corrector(see_acceleration, R_ACCELERATION),
    ),
}


def composed_of(predictor: str, corrector: str) -> ModularFilter:
    position, acceleration = CORRECTORS[corrector]
    return ModularFilter(
        PREDICTORS[predictor], [Sensor("position", position), Sensor("acceleration", acceleration)], DT_S
    )


def settled(composed: ModularFilter, steps: int = 400) -> FloatArray:
    """The covariance after so many steps with all measurements."""
    measurements = observe(composed, np.zeros((steps + 1, 3)), seed=1)
    found = run(composed, np.zeros(3), np.eye(3), np.zeros((steps, 0)), measurements, backend="reference")
    return found.P[-1]


def by_riccati() -> FloatArray:
    """P after the update: (P^-1 + H' R^-1 H)^-1 of the prediction P that solves the equation."""
    H, R = np.eye(3)[[0, 2]], np.diag([POSITION.sigma**2, ACCELERATION.sigma**2])
    P = solve_discrete_are(transition(DT_S).T, H.T, Q, R)
    K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
    return P - K @ H @ P


def test_covariance_settles_at_the_solution_of_the_riccati_equation() -> None:
    np.testing.assert_allclose(settled(tracker(DT_S, JERK_NOISE, POSITION, ACCELERATION)), by_riccati(), rtol=1e-10)


@pytest.mark.parametrize(
    ("predictor", "corrector"), [("unscented", "unscented"), ("extended", "extended"), ("unscented", "linear")]
)
def test_so_it_does_with_unscented_and_extended_parts(predictor: str, corrector: str) -> None:
    np.testing.assert_allclose(settled(composed_of(predictor, corrector)), by_riccati(), rtol=1e-9)


@pytest.mark.parametrize("predictor", PREDICTORS)
@pytest.mark.parametrize("corrector", CORRECTORS)
def test_estimates_are_the_same_whatever_the_parts(predictor: str, corrector: str) -> None:
    linear, other = tracker(DT_S, JERK_NOISE, POSITION, ACCELERATION), composed_of(predictor, corrector)
    truth = motion(Oscillator(), DT_S * np.arange(61), 1.0, 0.0)
    measurements = observe(linear, truth, seed=2)
    expected, found = (
        run(one, np.zeros(3), np.eye(3), np.zeros((60, 0)), measurements, backend="reference")
        for one in (linear, other)
    )
    np.testing.assert_allclose(found.x, expected.x, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.P, expected.P, rtol=1e-8, atol=1e-11)
