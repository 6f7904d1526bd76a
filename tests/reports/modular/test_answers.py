"""The report's answer, what its figures show and what the poster leaves to the future, against its tables."""

from __future__ import annotations

import re
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

from reports.modular.oscillator import NOISES
from reports.modular.schedule import miss_rows_of
from reports.modular.schedule_gantt import clocks_shown, fix_panels
from studies.modular.rocket_readings import chord
from studies.modular.rocket_schedule import LAND_BY, PERIOD_MS, compared_at, counted
from studies.modular.shared_code import PARTS, POINTS, code_lines
from tests.reports.modular.page import interval, number, rebuilt, rows, stored, text

RATES = ("usual", "rate 20", "rate 50", "rate 200", "rate 400")
"""The groups of stored rows that `rates.svg` shows."""
REPRODUCED = Path(__file__).parents[3] / "docs" / "reproduced.md"


def test_the_answer_is_short_and_its_numbers_are_in_the_tables() -> None:
    answer = re.search(r"\*\*Answer\.\*\* (.*?)\n\n", rebuilt()["index.md"].decode(), re.DOTALL)
    assert answer
    assert len(answer[1].split()) <= 50
    (holds,) = (row["all, from s"] for row in rows("readings.csv") if row["Residual"].startswith("position"))
    assert answer[1].endswith(f"its sensors unbiased, errs under 15 % of its distance after {holds} s.")
    of = {row["In a period"]: interval(row["error at 80 %"]) for row in rows("rates.csv")}
    still = 100 * float(stored().records("dropout", group="usual", dropout="0.8")[0]["still"])
    assert "the poster's 80 % dropout with 100 measurements per period of motion, not with 20, as 20 must" in answer[1]
    assert of["100"][1] < 1.2 * 5 < still < of["20"][0]
    assert {row["In a period"]: row["borne, %"] for row in rows("rates.csv")}["20"] == "0"
    least, most = ends_at_the_gap()
    assert f"Then position errs by {least:.1f} to {most:.1f} % of its amplitude." in answer[1]


def ends_at_the_gap() -> tuple[float, float]:
    """Least and greatest error in percent where 20 measurements in a period get through, of all rates of the figure."""
    there = [row for group in RATES for row in stored().records("dropout", group=group) if row["interval"] == "0.0500"]
    assert [(row["rate"], row["dropout"]) for row in there] == [
        ("100", "0.8"), ("20", "0.0"), ("50", "0.6"), ("200", "0.9"), ("400", "0.95"),
    ]  # fmt: skip
    errors = [100 * float(row["error m"]) for row in there]
    return min(errors), max(errors)


def test_what_is_said_of_equal_gaps_is_so_at_every_rate() -> None:
    least, most = ends_at_the_gap()
    said = re.search(r"the error goes from ([\d.]+) \([^)]*\) % .* to ([\d.]+) \([^)]*\) % \(400 sampled", text())
    assert said
    assert (float(said[1]), float(said[2])) == (pytest.approx(least), pytest.approx(most))
    by_gap: defaultdict[str, list[float]] = defaultdict(list)
    for group in RATES:
        for row in stored().records("dropout", group=group):
            by_gap[row["interval"]].append(float(row["error m"]))
    apart = max(max(errors) / min(errors) for errors in by_gap.values())
    assert f"the errors of all rates are within a factor of {apart:.1f}" in text()
    assert apart < 2
    assert "within a factor of two of one another" in text()


def test_what_the_gap_decides() -> None:
    """Up to a twentieth of a period the error is near a measurement's, or below, at any rate; beyond it is not."""
    noise = float(NOISES["position"])
    for group in RATES:
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
    of = {(row["Truth"], row["noise of"]): row for row in rows("covariances.csv")}
    for truth, part in (("own model", "position"), ("own model", "jerk"), ("oscillator", "position")):
        low, high = map(float, of[truth, part]["nine fits in ten"].split(" to "))
        assert 0.95 < low < high < 1.05
    low, high = map(float, of["own model", "acceleration"]["nine fits in ten"].split(" to "))
    assert 0.7 < low < 0.9
    assert 1.1 < high < 1.25
    assert interval(of["own model", "acceleration"]["median of the fits"])[0] > 0.9
    assert interval(of["oscillator", "acceleration"]["median of the fits"])[1] < 0.55
    assert interval(of["oscillator", "jerk"]["median of the fits"])[1] < 0.34
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
    assert of["less noise", "95"] > 3 > of["usual", "95"]


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


def test_what_the_slider_shows_is_in_the_data_beside_it() -> None:
    """Of each clock from the slowest that does for one way to the slowest that does for all, the drawn one among them:
    work of all three ways, and in the loop a late one on the one that is drawn."""
    misses = miss_rows_of(stored().records("schedule-misses"))
    clocks, found = clocks_shown(misses), rows("one-fix.csv")
    assert [clocks[0], clocks[-1]] == [74, 640]
    assert f"clocks of {clocks[0]} to {clocks[-1]} MHz" in text()
    assert {(row["clock, MHz"], row["late fix"]) for row in found} == {
        (str(clock), panel.title) for clock in clocks for panel in fix_panels(counted(), clock)
    }
    late = {(row["clock, MHz"], row["late fix"].rpartition(": ")[2]) for row in found if row["ends late"] == "yes"}
    at = str(compared_at(misses))
    assert [urgency for clock, urgency in late if clock == at] == ["in the loop"]


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


def test_no_percentage_has_digits_that_say_nothing() -> None:
    """From 100 % of the amplitude on a filter is lost, and 1,000 % are as good as any."""
    for name in ("dropout.csv", "rates.csv", "sensors.csv", "stiffness.csv", "residual-time.csv"):
        cells = [cell for row in rows(name) for cell in row.values() if " (" in cell]
        large = [cell.partition(" (")[0].replace(",", "") for cell in cells if number(cell) >= 100]
        assert all(len(value.rstrip("0")) <= 2 for value in large), large
    worst = [row["worst, %"] for row in rows("readings.csv")]
    assert all(cell == "over 1,000" or float(cell) <= 1000 for cell in worst)


def test_tables_are_narrow_enough_for_paper() -> None:
    tables = re.findall(r"(?:^\|.*\n)+", rebuilt()["index.md"].decode(), re.MULTILINE)
    assert tables
    for table in tables:
        assert table.splitlines()[0].count("|") - 1 <= 9


def test_what_is_said_to_be_reproduced_of_the_poster_has_the_same_numbers() -> None:
    said = REPRODUCED.read_text(encoding="utf-8").partition("MacCormack")[2]
    error, innovation, _ = rows("claim.csv")
    (bridged,) = (row for row in rows("stiffness.csv") if row["Lost, %"] == "80")
    least, most = ends_at_the_gap()
    biased = next(row for row in rows("biases.csv") if (row["Bias of"], row["size"]) == ("all", "1"))
    own = [int(row["its own lines"]) for row in rows("systems.csv")]
    aware, unaware = (bridged[name].partition(" (")[0] for name in ("stiffness as a state", "no spring"))
    for words in (
        f"not of the error: {error['position'].partition(' (')[0]} times",
        f"innovation of position, {innovation['position'].partition(' (')[0]} times",
        f"at 80 % dropout {aware} % error instead of {unaware} %",
        f"position errs by {least:.1f} to {most:.1f} %, by the sampling rate",
        f"position still is, orientation in {number(biased['orientation holds, %']):.0f} % of the flights",
        f"{code_lines(*PARTS)} for predictors and correctors of all three kinds",
        f"{code_lines(*POINTS)} for sigma points",
        f"a system adds {min(own)} to {max(own)}",
    ):
        assert words in said
    gain = re.search(r"by some (\d+) times over Python, (\d+) over NumPy calls", said)
    assert gain
    unscented = next(row for row in rows("compiled.csv") if row["Predictor"] == "unscented")
    for times, head in zip(gain.groups(), ("times faster than Python †", "than NumPy †"), strict=True):
        ends = [float(end) for end in unscented[head].split(" to ")]
        assert 0.9 * ends[0] < float(times) < 1.1 * ends[-1]


def test_what_15_percent_of_a_quaternion_are() -> None:
    """A rotation by this angle is so far from none."""
    said = re.search(r"but there (\d+) % are (\d+)°", text())
    assert said
    half = np.radians(float(said[2])) / 2
    turned, still = np.array([np.cos(half), np.sin(half), 0.0, 0.0]), np.eye(4)[0]
    assert 100 * chord(turned, still) == pytest.approx(float(said[1]), abs=0.5)
