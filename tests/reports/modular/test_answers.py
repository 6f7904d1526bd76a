"""The report's answer, what its figures show and what the poster leaves to the future, against its tables."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from reports.modular.oscillator import NOISES
from reports.modular.schedule import miss_rows_of
from reports.modular.schedule_gantt import fix_panels
from studies.modular.rocket_readings import chord
from studies.modular.rocket_schedule import LAND_BY, PERIOD_MS, compared_at, counted
from tests.reports.modular.page import interval, number, rebuilt, rows, stored, text

REPRODUCED = Path(__file__).parents[3] / "docs" / "reproduced.md"


def test_the_answer_is_short_and_its_numbers_are_in_the_tables() -> None:
    answer = re.search(r"\*\*Answer\.\*\* (.*?)\n\n", rebuilt()["index.md"].decode(), re.DOTALL)
    assert answer
    assert len(answer[1].split()) <= 50
    times = number(rows("claim.csv")[0]["position"])
    (holds,) = (row["all, from s"] for row in rows("readings.csv") if row["Residual"].startswith("position"))
    assert f"the error {times:.1f} times that at 10 %" in answer[1]
    assert f"from {holds} s on" in answer[1]
    at_the_gap = [
        row
        for group in ("usual", "rate 200", "rate 400")
        for row in stored().records("dropout", group=group)
        if float(row["interval"]) == pytest.approx(1 / 20)
    ]
    assert [float(row["dropout"]) for row in at_the_gap] == [0.8, 0.9, 0.95]
    assert "while 20 in a period get through, at 80 or 95 % dropout" in answer[1]
    for row in at_the_gap:
        assert float(row["error high m"]) < 1.2 * float(NOISES["position"])


def test_what_the_gap_decides() -> None:
    """Up to a twentieth of a period the error is near a measurement's, or below, at any rate; beyond it is not."""
    noise = float(NOISES["position"])
    for group in ("usual", "rate 20", "rate 50", "rate 200", "rate 400"):
        for row in stored().records("dropout", group=group):
            if float(row["interval"]) <= 0.05:
                assert float(row["error high m"]) < 1.2 * noise
            if float(row["interval"]) >= 0.1:
                assert float(row["error low m"]) > 1.5 * noise


def test_residuals_settle_within_a_period_up_to_80_percent_and_later_at_99() -> None:
    *settling, lost = rows("residual-time.csv")
    for row in settling:
        early, late = (interval(row[f"error after {when}"]) for when in ("1 period", "10 periods"))
        assert number(row["error at the start"]) > 2 * late[1]
        assert early[0] < late[1]
        assert late[0] < early[1]
        assert 5 * 0.97 < number(row["innovation after 10"]) < 5 * 1.4
    assert interval(lost["error after 10 periods"])[0] > 2 * interval(lost["error after 1 period"])[0] > 200
    low, high = interval(lost["innovation after 10"])
    assert low < number(lost["error after 10 periods"]) < high
    errors = [float(row["error"]) for row in stored().records("residual-course", dropout="0.99")]
    of_period = np.mean(np.reshape(errors, (10, -1)), axis=1)
    assert of_period[0] < 0.5 * of_period[1] < 0.5 * of_period[2]
    np.testing.assert_allclose(of_period[3:], of_period[3:].mean(), rtol=0.25)


def test_uncertain_parameters_do_not_mislead_a_filter_that_knows_none() -> None:
    for row in rows("uncertain.csv"):
        if row["spread, %"] != "0":
            low, high = interval(row["times"])
            assert low <= 1.0 <= high
            assert low > 0.98
            assert high < 1.02
            assert interval(row["1 in 20 above"])[1] < 1.5
        if row["System"].startswith("rocket"):
            assert number(row["hold, %"]) == 100


def test_the_stiffness_as_a_state_bears_dropout() -> None:
    found = rows("stiffness.csv")
    for row in found:
        assert interval(row["stiffness as a state"])[1] < 0.3 * interval(row["no spring"])[0]
    of = {row["Lost, %"]: row for row in found}
    assert interval(of["80"]["NEES"])[1] < 3 < interval(of["99"]["NEES"])[0]
    assert float(of["80"]["stiffness off by, %"].split(" (")[0]) < 0.1


def test_covariances_are_found_where_the_model_is_true_the_accelerometer_s_less_closely() -> None:
    of = {(row["The truth is"], row["noise of"]): row for row in rows("covariances.csv")}
    for truth, part in (("filter", "position"), ("filter", "jerk"), ("oscillator", "position")):
        (row,) = (row for (said, what), row in of.items() if truth in said and what == part)
        low, high = map(float, row["nine fits in ten"].split(" to "))
        assert 0.95 < low < high < 1.05
    low, high = map(float, of["the filter's own model", "acceleration"]["nine fits in ten"].split(" to "))
    assert 0.7 < low < 0.9
    assert 1.1 < high < 1.25
    assert interval(of["the filter's own model", "acceleration"]["median of the fits"])[0] > 0.9
    assert interval(of["the oscillator", "acceleration"]["median of the fits"])[1] < 0.55
    assert interval(of["the oscillator", "jerk"]["median of the fits"])[1] < 0.34
    model, oscillator = stored().records("covariances")
    assert 0.99 < float(model["times low"]) <= float(model["times high"]) < 1.01
    assert float(oscillator["times high"]) < 1.02
    assert float(oscillator["usual nees high"]) < 3 < 5 < float(oscillator["nees low"])


def test_nearly_all_errors_that_are_drawn_are_within_the_band() -> None:
    flight, run = stored().columns("flight"), stored().columns("oscillator")
    for name in ("height", "climb", "acceleration", "tilt"):
        assert np.mean(np.abs(flight[f"{name} error"]) <= 2 * flight[f"{name} sigma"]) > 0.95
    for name in ("position", "velocity", "acceleration"):
        error = run[f"{name} estimate"] - run[f"{name} true"]
        assert np.mean(np.abs(error) <= 2 * run[f"{name} sigma"]) > 0.95


def test_only_acceleration_at_thrust_onset_is_far_from_three() -> None:
    for row in stored().records("rocket-nees", case="unscented"):
        if row["of"] != "all":
            surprised = (row["phase"], row["of"]) == ("thrust onset", "acceleration")
            assert (abs(float(row["mean"]) - 3) > 1) == surprised


def test_with_dropout_the_rockets_filter_is_surprised_by_thrust_and_cautious_afterwards() -> None:
    course = stored().columns("rocket-nees-course")
    later = course["time_s"] > 6
    for dropout in ("50 %", "80 %", "95 %"):
        assert course[dropout].max() > 10 * 15
        assert np.median(course[dropout][later]) < 12
    assert 11 < course["0 %"][course["time_s"] > 0.5].min() <= course["0 %"][course["time_s"] > 0.5].max() < 15.5


def test_less_process_noise_makes_a_filter_that_is_lost_and_does_not_know() -> None:
    of = {(row["Filter"], row["dropout, %"]): number(row["NEES"]) for row in rows("consistency.csv")}
    assert of["less process noise", "95"] > 3 > of["usual", "95"]


def test_position_keeps_to_the_claim_unless_nearly_all_is_lost() -> None:
    row = next(row for row in rows("lost.csv") if row["Residual"].startswith("position"))
    assert [number(row[f"dropout {dropout} %"]) for dropout in (0, 50, 80)] == [100] * 3
    assert number(row["dropout 95 %"]) < 90


def test_what_the_accelerometer_stands_in_for() -> None:
    of = {row["Filter"]: row for row in rows("rocket-errors.csv")}
    assert number(of["no accelerometer"]["velocity"]) > 10 * number(of["unscented"]["velocity"])
    assert number(of["no accelerometer"]["position"]) < 1.5 * number(of["unscented"]["position"])


def test_one_late_fix_delays_the_loop_only_if_it_is_replayed_within_it() -> None:
    at = compared_at(miss_rows_of(stored().records("schedule-misses")))
    preempted, in_the_loop, larsen = (panel.schedule for panel in fix_panels(counted(), at))
    assert preempted.misses == larsen.misses == 0
    assert in_the_loop.misses > 1


def test_larsen_lands_as_fixes_arrive_and_unscented_replays_land_late_too() -> None:
    found = stored().columns("schedule-landings")
    beyond = found["l - k"] > LAND_BY
    np.testing.assert_allclose(found["GPS, larsen, extended, preempted"], found["arrivals"], atol=0.3)
    assert found["GPS, recalculate, unscented, preempted"][beyond].sum() > 10
    assert found["GPS, recalculate, extended, preempted"][beyond].sum() == 0


def test_in_the_loop_about_one_step_in_ten_responds_late() -> None:
    found = stored().columns("schedule-responses")
    for predictor in ("unscented", "extended"):
        late = found[f"loop, recalculate, {predictor}, in the loop"] > PERIOD_MS
        assert 0.05 < found["share"][late].max() < 0.2
        assert found[f"loop, recalculate, {predictor}, in the loop"].max() > 3 * PERIOD_MS
        assert found[f"loop, recalculate, {predictor}, preempted"].max() < PERIOD_MS


def test_tables_are_narrow_enough_for_paper() -> None:
    tables = re.findall(r"(?:^\|.*\n)+", rebuilt()["index.md"].decode(), re.MULTILINE)
    assert tables
    for table in tables:
        assert table.splitlines()[0].count("|") - 1 <= 9


def test_what_is_said_to_be_reproduced_of_the_poster_has_the_same_numbers() -> None:
    said = REPRODUCED.read_text(encoding="utf-8").partition("MacCormack")[2]
    error, innovation, _ = rows("claim.csv")
    (bridged,) = (row for row in rows("stiffness.csv") if row["Lost, %"] == "80")
    aware, unaware = (bridged[name].partition(" (")[0] for name in ("stiffness as a state", "no spring"))
    for words in (
        f"not of the error: {error['position'].partition(' (')[0]} times",
        f"innovation of position, {innovation['position'].partition(' (')[0]} times",
        f"at 80 % dropout {aware} % error instead of {unaware} %",
    ):
        assert words in said


def test_what_15_percent_of_a_quaternion_are() -> None:
    """A rotation by this angle is so far from none."""
    said = re.search(r"but there (\d+) % are (\d+)°", text())
    assert said
    half = np.radians(float(said[2])) / 2
    turned, still = np.array([np.cos(half), np.sin(half), 0.0, 0.0]), np.eye(4)[0]
    assert 100 * chord(turned, still) == pytest.approx(float(said[1]), abs=0.5)
