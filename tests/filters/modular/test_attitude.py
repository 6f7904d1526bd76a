"""Attitudes in modular filters: means and covariances on the manifold, never of four numbers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from filters.arrays import FloatArray
from filters.kernels.quaternion import turn
from filters.modular import (
    Measurement,
    ModularFilter,
    Sensor,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    run,
    space,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.predictors import Predictor
from filters.modular.sigma_points import Weights, mean
from filters.modular.space import minus, plus

ATTITUDE = space(4, attitudes=[0])
TURNING = space(7, attitudes=[3])
"""A turn rate in the body, and the attitude that it turns."""

seeds = st.integers(0, 2**31 - 1)
spreads = st.floats(0.0, 0.8)


def rotations(seed: int, count: int) -> Rotation:
    return Rotation.random(count, random_state=np.random.default_rng(seed))


def numbers(attitudes: Rotation) -> FloatArray:
    return np.asarray(attitudes.as_quat(scalar_first=True))


def scattered(seed: int, count: int, spread: float) -> Rotation:
    """Attitudes within `spread` radians or so of one that may be anywhere."""
    vectors = np.random.default_rng([seed, 1]).normal(0.0, spread / np.sqrt(3), (count, 3))
    return rotations(seed, 1)[0] * Rotation.from_rotvec(vectors)


def mean_of(attitudes: Rotation, signs: FloatArray | None = None) -> Rotation:
    """By the filter, all with the same weight."""
    count = len(attitudes)
    points = numbers(attitudes) * (1.0 if signs is None else signs[:, np.newaxis])
    out = np.empty(4)
    mean(ATTITUDE, points, Weights(np.nan, 1 / count, np.nan, 1 / count), np.empty((count, 3)), np.empty(3), out)
    return Rotation.from_quat(out, scalar_first=True)


def angle(a: Rotation, b: Rotation) -> float:
    return float((a.inv() * b).magnitude())


# ------------------------------------------------------------------------------------------------------- the mean


@given(seeds, spreads)
def test_the_mean_of_a_symmetric_set_is_its_centre_and_scipys(seed: int, spread: float) -> None:
    centre = rotations(seed, 1)[0]
    vectors = np.random.default_rng([seed, 1]).normal(0.0, spread, (5, 3))
    both = centre * Rotation.from_rotvec(np.concatenate([np.zeros((1, 3)), vectors, -vectors]))
    assert angle(mean_of(both), centre) < 1e-12
    assert angle(mean_of(both), both.mean()) < 1e-7


@given(seeds, spreads)
def test_the_mean_of_any_set_is_where_the_errors_vanish(seed: int, spread: float) -> None:
    attitudes = scattered(seed, 7, spread)
    centre = mean_of(attitudes)
    np.testing.assert_allclose((centre.inv() * attitudes).as_rotvec().mean(axis=0), 0.0, atol=1e-11)


@given(seeds, spreads)
def test_the_mean_turns_with_the_set(seed: int, spread: float) -> None:
    """Whichever frames attitudes are given in, of the world or of the body, the mean is the same attitude."""
    attitudes = scattered(seed, 7, spread)
    world, body = rotations(seed + 1, 2)
    assert angle(mean_of(world * attitudes * body), world * mean_of(attitudes) * body) < 1e-11


@given(seeds, spreads)
def test_signs_of_quaternions_do_not_matter(seed: int, spread: float) -> None:
    attitudes, signs = scattered(seed, 7, spread), np.random.default_rng(seed).choice([-1.0, 1.0], 7)
    assert angle(mean_of(attitudes, signs), mean_of(attitudes)) < 1e-12


def test_averaging_four_numbers_would_be_wrong() -> None:
    """Turns about z by -30, 0 and 30 degrees, the last as -q: the mean is no turn; the numbers' turns by 55 degrees."""
    attitudes = Rotation.from_rotvec([[0.0, 0.0, -np.pi / 6], [0.0, 0.0, 0.0], [0.0, 0.0, np.pi / 6]])
    signs = np.array([1.0, 1.0, -1.0])
    averaged = np.mean(signs[:, np.newaxis] * numbers(attitudes), axis=0)
    assert np.linalg.norm(averaged) == pytest.approx(0.375, abs=0.001)  # nor has it length 1
    turned = Rotation.from_quat(averaged, scalar_first=True).magnitude()
    assert turned == pytest.approx(2 * np.arctan(2 * np.sin(np.pi / 12)))
    assert mean_of(attitudes, signs).magnitude() < 1e-14


def test_averaging_four_numbers_is_wrong_with_the_right_signs_too() -> None:
    """Turns about z by 0, 0 and 90 degrees: 30 on average, but the numbers say 29.3, and have length 0.93."""
    attitudes = Rotation.from_rotvec([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, np.pi / 2]])
    averaged = numbers(attitudes).mean(axis=0)
    assert np.linalg.norm(averaged) == pytest.approx(0.933, abs=0.001)
    assert np.degrees(Rotation.from_quat(averaged, scalar_first=True).magnitude()) == pytest.approx(29.3, abs=0.05)
    assert np.degrees(mean_of(attitudes).magnitude()) == pytest.approx(30.0, abs=1e-10)


# ------------------------------------------------------------------------------------------------- the covariance


def spin(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    for a in range(3):
        out[a] = dt * x[a]
    turn(x, 3, out, 0, out)
    for a in range(3):
        out[a] = x[a]


def attitude(x: FloatArray, out: FloatArray) -> None:
    for a in range(4):
        out[a] = x[3 + a]


RATE, RATE_SIGMA, ATTITUDE_SIGMA = np.array([0.9, -0.4, 1.3]), 0.2, np.array([0.25, 0.1, 0.15])
Q = 1e-12 * np.eye(6)
STEPS, DT = 10, 0.1
START = np.concatenate([RATE, numbers(rotations(5, 1)[0])])
P0 = np.diag(np.concatenate([np.full(3, RATE_SIGMA), ATTITUDE_SIGMA]) ** 2)


def monte_carlo(count: int) -> tuple[FloatArray, Rotation]:
    """Rates and attitudes of many that start as the filter thinks, after one second."""
    random = np.random.default_rng(0)
    rates = RATE + random.normal(0.0, RATE_SIGMA, (count, 3))
    started = Rotation.from_rotvec(random.normal(0.0, ATTITUDE_SIGMA, (count, 3)))
    start = Rotation.from_quat(START[3:], scalar_first=True)
    return rates, start * started * Rotation.from_rotvec(STEPS * DT * rates)


def test_unscented_mean_and_covariance_agree_with_monte_carlo() -> None:
    """Errors of 14 degrees at first, 19 at the end: the standard deviations agree to 2 %."""
    composed = ModularFilter(unscented_predictor(spin, Q), [], DT, TURNING)
    found = run(composed, START, P0, np.zeros((STEPS, 0)), [], backend="reference")
    rates, attitudes = monte_carlo(40_000)
    estimate = Rotation.from_quat(found.x[-1, 3:], scalar_first=True)
    errors = np.hstack([rates - found.x[-1, :3], (estimate.inv() * attitudes).as_rotvec()])
    sigma = errors.std(axis=0)
    np.testing.assert_allclose(np.sqrt(np.diag(found.P[-1])), sigma, rtol=0.02)
    np.testing.assert_allclose(found.P[-1] / np.outer(sigma, sigma), np.corrcoef(errors.T), atol=0.03)
    np.testing.assert_allclose(errors.mean(axis=0), 0.0, atol=0.02)
    assert angle(Rotation.from_quat(START[3:], scalar_first=True), estimate) > 1.0


# ------------------------------------------------------------------------------------------- signs, in a whole filter


@pytest.mark.parametrize("predictor", [unscented_predictor(spin, Q), extended_predictor(spin, Q)], ids=["UKF", "EKF"])
@settings(max_examples=20)
@given(seed=seeds)
def test_signs_of_measured_quaternions_change_nothing(predictor: Predictor, seed: int) -> None:
    gyro = linear_corrector(np.eye(3, 6), 0.01 * np.eye(3))
    camera = unscented_corrector(attitude, 0.02 * np.eye(3), observed=ATTITUDE)
    composed = ModularFilter(predictor, [Sensor("gyro", gyro), Sensor("camera", camera, 2, 1)], DT, TURNING)
    random = np.random.default_rng(seed)
    seen = numbers(scattered(seed, 3, 0.3))
    gyros = [Measurement("gyro", j, j, RATE + random.normal(0.0, 0.1, 3)) for j in range(6)]

    def found(signs: FloatArray, start: FloatArray) -> FloatArray:
        cameras = [Measurement("camera", 2 * j, 2 * j + 1, signs[j] * seen[j]) for j in range(3)]
        x0 = np.concatenate([RATE, start])
        history = run(composed, x0, P0, np.zeros((5, 0)), [*gyros, *cameras], backend="reference")
        errors = np.empty(6)
        minus(TURNING, history.x[-1], START, errors)
        return np.concatenate([errors, history.P.ravel()])

    expected = found(np.ones(3), seen[0])
    np.testing.assert_allclose(found(random.choice([-1.0, 1.0], 3), seen[0]), expected, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(found(np.ones(3), -seen[0]), expected, rtol=1e-10, atol=1e-12)


@given(seeds, spreads)
def test_a_point_moved_by_its_error_is_the_other_point(seed: int, spread: float) -> None:
    a, b = numbers(scattered(seed, 2, spread))
    error, moved = np.empty(3), np.empty(4)
    minus(ATTITUDE, a, b, error)
    plus(ATTITUDE, b, error, moved)
    assert abs(moved @ a) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("wrong", [{"angles": [4]}, {"attitudes": [1]}, {"attitudes": [0], "angles": [3]}])
def test_a_space_needs_indices_that_fit(wrong: dict[str, list[int]]) -> None:
    with pytest.raises(ValueError, match=r"space: 4 numbers cannot hold .*; give the index of each one"):
        space(4, **wrong)


@pytest.mark.parametrize("wrong", [{"angles": [0.5]}, {"attitudes": [0.0]}])
def test_a_space_needs_whole_indices(wrong: dict[str, list[float]]) -> None:
    with pytest.raises(ValueError, match=r"space: .*=\[0\..\] must be a list of whole numbers"):
        space(4, **wrong)  # type: ignore[arg-type]  # what a user may give


def test_a_heading_that_is_measured_as_it_is_comes_round() -> None:
    """From pi - 0.1 to a measured -pi + 0.1 it is 0.2 further, not 2 pi - 0.2 back; R = P: half of it is taken."""
    heading = space(1, angles=[0])
    compass = Sensor("compass", linear_corrector([[1.0]], [[1.0]], observed=heading), every=1)
    composed = ModularFilter(linear_predictor([[1.0]], Q=[[0.0]]), [compass], dt=1.0, of=heading)
    seen = [Measurement("compass", taken=0, arrives=0, y=[-np.pi + 0.1])]
    history = run(composed, [np.pi - 0.1], [[1.0]], None, seen)
    assert np.cos(history.x[-1, 0]) == pytest.approx(-1, abs=1e-12)


def test_an_attitude_is_no_linear_function_of_the_state() -> None:
    with pytest.raises(ValueError, match=r"observed has attitudes.*extended_corrector or unscented_corrector"):
        linear_corrector(np.eye(3), np.eye(3), observed=ATTITUDE)
