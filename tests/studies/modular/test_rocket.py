"""What holds of "residuals for position and orientation (...) within acceptable ranges (<15%) during ascent"."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from filters.arrays import FloatArray
from filters.systems.rocket_filter import ACCELEROMETER, CAMERA, GPS, OF, SENSORS
from studies.modular import rocket as study
from studies.modular.rocket import (
    BASE,
    BLIND_CASES,
    DROPOUT_CASES,
    EXTENDED,
    PHASES,
    QUANTITIES,
    ResidualRow,
    RocketResults,
)
from studies.modular.rocket_flights import Case, Run, fly
from studies.modular.rocket_readings import READINGS

EARLY = 130
"""Steps that are flown without compiling: a second on the pad, and 0.3 s of flight."""

COUNT = 7
COMPILED_CASES = (*DROPOUT_CASES, *BLIND_CASES)
"""Those with the unscented predictor, for one compilation."""


def made(position: FloatArray, error: FloatArray, turn: FloatArray, attitude_error: FloatArray) -> Run:
    """A run whose position (steps, 3) and attitude, as a rotation vector (steps, 3), are wrong by these errors."""
    steps = len(position)
    truth, x, errors = np.zeros((steps, 16)), np.zeros((steps, 16)), np.zeros((steps, 15))
    true = Rotation.from_rotvec(turn)
    truth[:, :3], truth[:, 12:] = position, true.as_quat(scalar_first=True)
    truth[1:, 9:12] = np.diff(turn, axis=0)
    x[:, 12:] = (true * Rotation.from_rotvec(-attitude_error)).as_quat(scalar_first=True)
    errors[:, :3], errors[:, 12:] = error, attitude_error
    return Run(np.arange(float(steps)), truth, x, np.tile(np.eye(15), (steps, 1, 1)), errors)


@cache
def early(case: Case = BASE) -> Run:
    return fly(case, 0, steps=EARLY, backend="reference")


@cache
def results() -> RocketResults:
    return study.rocket_study(range(COUNT), range(COUNT), main=COMPILED_CASES, side=())


def residual(reading: str, case: Case = BASE) -> ResidualRow:
    (row,) = (row for row in results().residuals if row.case == case and row.reading == reading)
    return row


def share(row: study.ResidualRow) -> float:
    """Of the flights that keep to the claim."""
    return row.hold / row.runs


# ----------------------------------------------------------------------------------------------------- the readings


def test_readings_of_position() -> None:
    one = made(np.array([[3.0, 0.0, 4.0]]), np.array([[0.3, 0.0, 0.8]]), np.zeros((1, 3)), np.zeros((1, 3)))
    assert READINGS["position / distance from the pad"](one) == pytest.approx(np.sqrt(0.73) / 5)
    assert READINGS["height / height"](one) == pytest.approx(0.2)
    assert READINGS["horizontal / horizontal distance"](one) == pytest.approx(0.1)


def test_the_worst_axis_is_worse_than_all_others() -> None:
    one = made(np.array([[3.0, 0.01, 4.0]]), np.array([[0.3, 0.1, 0.8]]), np.zeros((1, 3)), np.zeros((1, 3)))
    assert READINGS["worst axis / its coordinate"](one) == pytest.approx(10.0)


def test_readings_of_orientation() -> None:
    """After 1.5 turns about the nose, with an error of 0.1 about it: the net turn is half a turn."""
    turn = np.zeros((31, 3))
    turn[:, 0] = np.linspace(0.0, 3 * np.pi, 31)
    error = np.tile([0.1, 0.0, 0.0], (31, 1))
    one = made(np.ones((31, 3)), np.zeros((31, 3)), turn, error)
    assert READINGS["orientation / all turned"](one)[-1] == pytest.approx(0.1 / (3 * np.pi), rel=0.02)
    assert READINGS["orientation / net turn"](one)[-1] == pytest.approx(0.1 / np.pi)
    assert READINGS["difference of quaternions"](one)[-1] == pytest.approx(2 * np.sin(0.1 / 4))


def test_the_nose_does_not_mind_roll() -> None:
    """Pitched by 0.2 since launch, wrong by 0.05 in pitch and by a radian in roll."""
    turn, error = np.array([[0.0, 0.0, 0.0], [0.0, 0.2, 0.0]]), np.zeros((2, 3))
    pitch_only = made(np.ones((2, 3)), error, turn, np.array([[0.0, 0.0, 0.0], [0.0, 0.05, 0.0]]))
    roll_only = made(np.ones((2, 3)), error, turn, np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    assert READINGS["nose / turn of the nose"](pitch_only)[1] == pytest.approx(0.25)
    assert READINGS["nose / turn of the nose"](roll_only)[1] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.exhaust
def test_a_quaternion_and_its_negative_have_the_same_residual() -> None:
    one = early()
    flipped = one._replace(x=one.x * np.where(np.arange(16) < 12, 1.0, -1.0))
    for reading in ("difference of quaternions", "orientation / net turn", "nose / turn of the nose"):
        np.testing.assert_allclose(READINGS[reading](flipped)[EARLY:], READINGS[reading](one)[EARLY:])


@pytest.mark.parametrize(
    ("residuals", "from_s"),
    [([20, 14, 14], 1.0), ([0, 0, 0], 0.0), ([0, 20, 0], 2.0), ([0, 0, 20], np.inf), ([np.inf, 0, 0], 1.0)],
)
def test_it_holds_from_the_last_time_above(residuals: list[float], from_s: float) -> None:
    """Residuals at -1 s, where they do not count, and at 0, 1 and 2 s."""
    assert study.holds_from(np.arange(-1.0, 3.0), np.array([50.0, *residuals])) == from_s


# ------------------------------------------------------------------------------------------------------- one flight


@pytest.mark.exhaust
def test_a_flight_is_the_same_for_all_cases() -> None:
    np.testing.assert_array_equal(early().truth, early(EXTENDED).truth)
    np.testing.assert_array_equal(early().x[0, :12], early(EXTENDED).x[0, :12])


@pytest.mark.exhaust
def test_unscented_and_extended_prediction_agree() -> None:
    """A step of 10 ms is as good as linear: they differ by less than a thousandth of a standard deviation."""
    sigma = np.sqrt(np.diagonal(early().P, axis1=1, axis2=2))
    assert (np.abs(early().errors - early(EXTENDED).errors) < 1e-3 * sigma)[1:].all()


@pytest.mark.exhaust
def test_errors_are_those_of_the_estimate() -> None:
    one = early()
    np.testing.assert_array_equal(one.errors[:, :12], one.truth[:, :12] - one.x[:, :12])
    true, estimate = (Rotation.from_quat(states[:, 12:], scalar_first=True) for states in (one.truth, one.x))
    np.testing.assert_allclose(one.errors[:, 12:], (estimate.inv() * true).as_rotvec(), atol=1e-14)


@pytest.mark.exhaust
def test_a_summary_holds_all_readings_and_quantities() -> None:
    one = study.summary(early())
    assert one.residuals.shape == (len(READINGS), EARLY + 1)
    assert one.nees.shape == (1 + len(QUANTITIES), EARLY + 1)
    assert not np.isnan(one.residuals).any()
    position = np.linalg.norm(early().errors[100:, :3], axis=1)
    assert one.rms[0] == pytest.approx(np.sqrt(np.mean(position**2)))
    assert one.largest[0] == pytest.approx(position.max())
    angle = np.degrees(np.linalg.norm(early().errors[100:, 12:], axis=1))
    assert one.largest[-1] == pytest.approx(angle.max())


def test_right_after_ignition_it_knows_where_it_is() -> None:
    """Without knowledge of the thrust: within a metre or so, and two degrees."""
    position, _, _, _, orientation = study.summary(early()).rms
    assert position < 1.5
    assert orientation < 2.0


# ------------------------------------------------------------------------------------------------------- the claims


@pytest.mark.exhaust
def test_the_claim_holds_of_position_as_a_share_of_distance() -> None:
    """Within a second of ignition, up to 80 % of all measurements lost, and without any one of the sensors."""
    for case in (*DROPOUT_CASES[:3], *BLIND_CASES):
        row = residual("position / distance from the pad", case)
        assert row.worst < 15
        assert row.holds_from_s < 1
        assert row.hold == row.runs
    assert residual("position / distance from the pad").typical.value < 0.2


@pytest.mark.exhaust
def test_the_claim_does_not_hold_of_each_axis() -> None:
    """Where a coordinate is small, no error is a small share of it."""
    assert residual("worst axis / its coordinate").worst > 100
    assert share(residual("horizontal / horizontal distance", DROPOUT_CASES[2])) < 0.8


@pytest.mark.exhaust
def test_the_claim_holds_of_orientation_as_a_share_of_all_that_was_turned() -> None:
    """A little more than a second after ignition, for a share of nothing is not small; and as quaternions, always."""
    row = residual("orientation / all turned")
    assert row.half_from_s < 1.0
    assert row.holds_from_s < 1.2
    assert row.typical.value < 0.5
    assert residual("difference of quaternions").holds_from_s == 0.0
    assert residual("difference of quaternions").worst < 1


@pytest.mark.exhaust
def test_the_claim_does_not_hold_of_orientation_if_most_is_lost() -> None:
    assert share(residual("orientation / all turned", DROPOUT_CASES[-1])) < 0.5
    assert share(residual("nose / turn of the nose", DROPOUT_CASES[-1])) < 0.5


@pytest.mark.exhaust
def test_errors_grow_with_dropout() -> None:
    rows = {row.case: row for row in results().errors}
    means = np.array([rows[case].rms.mean(axis=0) for case in DROPOUT_CASES])
    assert (np.diff(means, axis=0) > 0).all()
    assert (means[0] < [0.5, 0.1, 0.7, 0.6, 0.3]).all()
    assert (means[2] < 10 * means[0]).all()
    assert (means[3] > 6 * means[0]).all()


@pytest.mark.exhaust
def test_each_sensor_is_for_something() -> None:
    """Without GPS: position. Without the accelerometer: velocity and acceleration. Without a camera: orientation."""
    rows = {row.case: row.rms.mean(axis=0) for row in results().errors}
    without = {sensor: rows[case] / rows[BASE] for sensor, case in zip(SENSORS, BLIND_CASES, strict=True)}
    assert without[GPS][0] > 5
    assert without[ACCELEROMETER][1] > 5
    assert without[ACCELEROMETER][2] > 10
    assert without[CAMERA][4] > 2
    for ratio in without.values():
        assert (ratio > 0.9).all()


@pytest.mark.exhaust
def test_the_filter_is_as_accurate_as_it_says_but_for_thrust_onset() -> None:
    """NEES of the 15 errors in each phase; that of acceleration rises when thrust sets in within 50 ms."""
    rows = {(row.phase, row.of): row for row in results().nees if row.case == BASE}
    for phase in PHASES:
        row = rows[phase, "all"]
        assert row.n == OF.errors
        assert 10 < row.mean < 20
    assert rows["thrust onset", "acceleration"].mean > 1.5 * rows["powered", "acceleration"].mean
    (series,) = (series for series in results().series if series.case == BASE)
    first = (series.time_s > 0) & (series.time_s < 0.1)
    assert series.nees[0, first].max() > 1.5 * series.bounds.high


@pytest.mark.exhaust
def test_the_filter_is_too_sure_of_itself_if_most_is_lost() -> None:
    """95 %: it takes thrust onset and roll for white noise, and has seen too little of them."""
    rows = {(row.phase, row.of): row for row in results().nees if row.case == DROPOUT_CASES[-1]}
    for phase in ("thrust onset", "powered", "burnout"):
        assert rows[phase, "all"].mean > 1.2 * rows[phase, "all"].bounds.high


@pytest.mark.exhaust
def test_results_are_of_all_cases_and_readings() -> None:
    found = results()
    assert found.apogee_m.shape == (COUNT,)
    assert [row.case for row in found.errors] == list(COMPILED_CASES)
    assert {len(row.rms) for row in found.errors} == {COUNT}
    assert len(found.residuals) == len(COMPILED_CASES) * len(READINGS)
    assert len(found.nees) == len(COMPILED_CASES) * len(PHASES) * (1 + len(QUANTITIES))
    for series in found.series:
        assert series.median.shape == series.high.shape == (len(READINGS), len(series.time_s))
        assert (series.median <= series.high).all()


@pytest.mark.exhaust
def test_progress_is_told_and_side_cases_fly_with_few_seeds() -> None:
    told = []
    found = study.rocket_study(
        (0, 1), (0,), main=(BASE,), side=BLIND_CASES[:1], progress=lambda *state: told.append(state)
    )
    assert [state[:2] for state in told] == [(1, 2), (2, 2)]
    assert [len(row.rms) for row in found.errors] == [2, 1]
    assert len(found.series) == 1
