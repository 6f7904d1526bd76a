"""What holds of "predictive quality remained mostly unaffected up to sensor dropout of 80%", and what does not."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from filters.arrays import FloatArray
from studies.modular import oscillator as study
from studies.modular.oscillator import KEEN, LOWEST, USUAL, Row
from studies.modular.oscillator_run import (
    AMPLITUDES,
    PERIODS,
    POSITION_SIGMA_M,
    SENSORS,
    SETTLED_PERIODS,
    Record,
    Setting,
    arriving,
    estimate,
    oscillation,
    own_model,
    residuals,
)

CLAIMED = 0.8
RUNS = 3


@cache
def records(rate: int = USUAL.rate) -> tuple[Record, ...]:
    return tuple(oscillation(Setting(rate), seed) for seed in range(RUNS if rate <= USUAL.rate else 2))


@cache
def row(dropout: float, setting: Setting = USUAL) -> Row:
    return study.row(records(setting.rate), setting, dropout, "reference")


def pooled(values: FloatArray) -> FloatArray:
    """Root mean squares over all runs, as each run has as many values."""
    root: FloatArray = np.sqrt(np.mean(values**2, axis=0))
    return root


def ratio(what: str, dropout: float, setting: Setting = USUAL) -> FloatArray:
    """At this dropout over that at the lowest one."""
    over: FloatArray = pooled(getattr(row(dropout, setting), what)) / pooled(getattr(row(LOWEST, setting), what))
    return over


# -------------------------------------------------------------------------------------------------------- the runs


def test_with_more_dropout_fewer_of_the_same_measurements_arrive() -> None:
    record, kept = records()[0], set(range(2002))
    for dropout in study.DROPOUTS:
        ids = {id(one) for one in arriving(record, dropout)}
        now = {i for i, one in enumerate(record.measurements) if id(one) in ids}
        assert now <= kept
        assert len(now) == pytest.approx(2002 * (1 - dropout), abs=90)
        kept = now


def test_only_the_sensors_named_lose_measurements() -> None:
    everything = [one for one in records()[0].measurements if one.sensor == "position"]
    left = arriving(records()[0], 0.9, losing="acceleration")
    assert [one for one in left if one.sensor == "position"] == everything
    assert len(left) - len(everything) == pytest.approx(100, abs=30)


def test_innovation_is_what_the_filter_would_have_missed_without_the_measurement() -> None:
    """The filter is run without the measurements of one step, so that its estimate of that step is a prediction."""
    record, at = records()[0], 700
    arrived = arriving(record, 0.5)
    step = next(one.taken for one in arrived if one.sensor == "acceleration" and one.taken >= at)
    predicted = estimate(record, USUAL, [one for one in arrived if one.taken != step], "reference").x[step]
    estimated = estimate(record, USUAL, arrived, "reference").x[step]
    found = residuals(record, USUAL, 0.5, "reference")
    for one in (one for one in arrived if one.taken == step):
        sensor, seen = list(SENSORS).index(one.sensor), SENSORS[one.sensor]
        number = sum(
            SETTLED_PERIODS * USUAL.rate <= other.taken < step and other.sensor == one.sensor for other in arrived
        )
        assert found.innovation[sensor][number] == pytest.approx(one.y[0] - predicted[seen], abs=1e-9)
        assert found.after[sensor][number] == pytest.approx(one.y[0] - estimated[seen], abs=1e-9)


def test_a_row_holds_the_root_mean_squares_of_its_runs() -> None:
    found = [residuals(record, USUAL, 0.5, "reference") for record in records()[:2]]
    one = study.row(records()[:2], USUAL, 0.5, "reference")
    errors = np.array([each.error for each in found])
    assert errors.shape == (2, (PERIODS - SETTLED_PERIODS) * USUAL.rate + 1, 3)
    np.testing.assert_allclose(one.error, np.sqrt(np.mean(errors**2, axis=1)))
    innovations = [[np.sqrt(np.mean(sensor**2)) for sensor in each.innovation] for each in found]
    np.testing.assert_allclose(one.innovation, innovations)
    assert one.interval == pytest.approx(0.02)


def test_where_nothing_was_measured_there_is_no_residual() -> None:
    record = records()[0]._replace(measurements=[])
    one = study.row([record, record], USUAL, 0.5, "reference")
    assert np.isnan(one.innovation).all()
    assert np.isfinite(one.error).all()


def test_history_is_one_run() -> None:
    found = study.history_at(0.5, 2, backend="reference")
    assert found.truth.shape == found.estimate.shape == found.sigma.shape == (len(found.time_s), 3)
    np.testing.assert_array_equal(found.truth, records()[2].truth)
    assert len(found.position) + len(found.acceleration) == len(arriving(records()[2], 0.5))
    within = np.abs(found.estimate - found.truth)[SETTLED_PERIODS * USUAL.rate :] < 3 * found.sigma[-1]
    assert within.mean() > 0.95


# -------------------------------------------------------------------- the claim, by three readings of "residual"


@pytest.mark.exhaust
def test_error_from_the_truth_is_more_than_doubled_at_80_percent_however_fast_one_samples() -> None:
    """The mean of so many times fewer measurements is as much worse; more than that comes from the gaps."""
    least = np.sqrt((1 - LOWEST) / (1 - CLAIMED))
    for setting in (USUAL, KEEN, Setting(rate=400)):
        assert (ratio("error", CLAIMED, setting)[:2] > least).all()
    assert (ratio("error", CLAIMED) > 2.5).all()


@pytest.mark.exhaust
def test_error_of_position_is_about_that_of_one_measurement_at_80_percent_and_explodes_beyond() -> None:
    position = {dropout: pooled(row(dropout).error)[0] / POSITION_SIGMA_M for dropout in (0.5, 0.8, 0.9, 0.98, 0.99)}
    assert position[0.5] < 0.7
    assert position[0.8] == pytest.approx(1.0, abs=0.25)
    assert position[0.9] > 2
    assert position[0.98] > 30
    assert position[0.99] > 100


def test_at_98_percent_to_say_that_nothing_moves_would_be_better() -> None:
    assert (pooled(row(0.9).error) / AMPLITUDES < row(0.9).still).all()
    assert (pooled(row(0.98).error) / AMPLITUDES > row(0.98).still).all()


@pytest.mark.exhaust
def test_innovation_of_position_rises_by_half_up_to_80_percent_and_that_of_acceleration_threefold() -> None:
    at_80, at_90 = ratio("innovation", CLAIMED), ratio("innovation", 0.9)
    assert 1.2 < at_80[0] < 1.7
    assert at_90[0] > 2.5
    assert at_80[1] > 2.5
    assert ratio("innovation", CLAIMED, Setting(rate=400))[0] < 1.15


@pytest.mark.exhaust
def test_what_is_left_after_the_update_falls_with_dropout() -> None:
    """With a gap before it a measurement is believed more, and nothing is left of it: however wrong the filter is."""
    left = np.array([pooled(row(dropout).after) for dropout in (0.1, 0.5, 0.8, 0.9, 0.98)])
    assert (np.diff(left[:, 0]) < 0).all()
    assert left[-1, 0] < 0.4 * left[0, 0]


# ------------------------------------------------------------------------------------------------ what decides it


@pytest.mark.parametrize("rate", [20, 50, 100, 200, 400])
def test_a_filter_bears_dropout_until_measurements_are_a_twentieth_of_a_period_apart(rate: int) -> None:
    """The same size of error at 0, 60, 80, 90 and 95 % dropout; less where measurements come evenly, without any."""
    dropout = study.borne(rate)
    found = study.row(records(rate)[:2], Setting(rate), dropout, "reference")
    assert found.interval == pytest.approx(study.BORNE)
    assert 0.6 < pooled(found.error)[0] / POSITION_SIGMA_M < 1.3
    assert pooled(found.error)[0] / AMPLITUDES[0] < 0.07


def test_dropout_that_is_borne() -> None:
    assert [study.borne(rate) for rate in (10, 20, 50, 100, 200, 400)] == pytest.approx([0, 0, 0.6, 0.8, 0.9, 0.95])


def test_reach_is_the_time_in_which_the_motion_leaves_its_prediction_by_a_sigma() -> None:
    """From a turning point of the velocity, where the jerk is greatest: x = sin t, predicted as t. Error t^3 / 6."""
    angle = 2 * np.pi * study.reach()
    assert angle - np.sin(angle) == pytest.approx(POSITION_SIGMA_M, rel=0.03)
    assert study.reach() == pytest.approx(0.107, abs=0.001)


def test_each_sensor_bears_its_own_loss_of_another_quantity() -> None:
    """With 90 % of the positions lost, the acceleration stays as it was; with 90 % of those lost, position loses less
    than with both."""
    no_position, no_acceleration = (row(0.9, setting) for setting in study.ONE_SENSOR)
    base = row(0.1)
    assert pooled(no_position.error)[2] < 1.05 * pooled(base.error)[2]
    assert pooled(no_acceleration.error)[2] > 4 * pooled(base.error)[2]
    for one in (no_position, no_acceleration):
        assert 1.4 * pooled(base.error)[0] < pooled(one.error)[0] < 0.5 * pooled(row(0.9).error)[0]


# --------------------------------------------------------------------------------------------- NEES, two tunings


def test_the_check_of_nees_is_passed_where_the_filter_has_the_right_model() -> None:
    own = [own_model(USUAL, seed) for seed in range(4)]
    for dropout in (0.5, 0.9):
        found = study.row(own, USUAL, dropout, "reference").consistency
        assert found.overall == pytest.approx(3.0, rel=0.1)
        assert found.inside == pytest.approx(0.95, abs=0.05)


def test_with_the_usual_tuning_the_filter_is_too_cautious_at_any_dropout() -> None:
    overall = np.array([row(dropout).consistency.overall for dropout in (0.1, 0.5, 0.8, 0.9, 0.98)])
    assert (overall < 2.6).all()
    assert (overall[2:] < 1.8).all()


def test_with_less_process_noise_it_is_nearly_consistent_up_to_80_percent_and_too_sure_beyond() -> None:
    overall = [row(dropout, KEEN).consistency.overall for dropout in (0.1, 0.5, 0.8, 0.9, 0.98)]
    assert overall[:3] == pytest.approx([3.0, 3.0, 3.0], rel=0.25)
    assert 3.5 < overall[3] < 5.0
    assert overall[4] > 6


def test_the_tuning_decides_consistency_and_hardly_the_error() -> None:
    for dropout in (0.1, 0.5, 0.8, 0.9):
        np.testing.assert_allclose(pooled(row(dropout, KEEN).error), pooled(row(dropout).error), rtol=0.3)


def test_the_study_has_all_its_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(study, "row", lambda _records, setting, dropout, _backend: (len(_records), setting, dropout))
    monkeypatch.setattr(study, "oscillation", lambda setting, seed: (setting, seed))
    monkeypatch.setattr(study, "own_model", lambda setting, seed: (setting, seed))
    seen: list[tuple[int, int]] = []
    found = study.dropout_study(lambda done, total, _what: seen.append((done, total)))
    assert (
        [dropout for _, _, dropout in found.rows] == [dropout for _, _, dropout in found.keen] == list(study.DROPOUTS)
    )
    assert {count for count, _, _ in found.rows} == {len(study.SEEDS)}
    assert {setting.rate for _, setting, _ in found.by_rate} == set(study.RATES)
    assert {(setting.rate, dropout) for _, setting, dropout in found.by_rate} == {
        (rate, dropout) for rate in study.RATES for dropout in (*study.FEW_DROPOUTS, study.borne(rate))
    }
    assert {setting.losing for _, setting, _ in found.by_sensor} == {"position", "acceleration"}
    assert seen == [(done, 4) for done in range(5)]
