"""The committed report is what the code makes of the results stored in it, byte for byte, and what it says is true."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from reports.modular.costs import OPERATIONS
from reports.modular.oscillator import NOISES
from reports.modular.report import build
from reports.modular.results import TABLES, Results, read
from reports.modular.schedule import miss_rows_of
from reports.modular.schedule_gantt import fix_panels
from reports.modular.styles import WAY_NAMES
from reports.pages.machine import MARK
from reports.pages.numbers import significant, span
from studies.machines.parts import Micros, PartTimes
from studies.modular import costs as modular_costs
from studies.modular import late_measurements
from studies.modular.rocket_readings import chord
from studies.modular.rocket_schedule import LAND_BY, PERIOD_MS, WAYS, compared_at, counted, scenario
from tests.command_line import Run
from tests.reports import published

REPRODUCED = Path(__file__).parents[3] / "docs" / "reproduced.md"


@cache
def stored() -> Results:
    return read(published.FOLDER / "modular")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(stored())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def number(cell: str) -> float:
    """Without its interval."""
    return float(re.split(r" \(| ± ", cell)[0].replace(",", ""))


def interval(cell: str) -> tuple[float, float]:
    """Of "3.2 (3.1 to 3.4)", or "none (≤ 0.4)"."""
    if none := re.fullmatch(r"none \(≤ (.*)\)", cell):
        return 0.0, float(none[1])
    low, high = re.fullmatch(r".* \((.*) to (.*)\)", cell).groups()  # type: ignore[union-attr]
    return float(low.replace(",", "")), float(high.replace(",", ""))


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("modular", rebuilt())
    published.is_self_contained(rebuilt())


def test_the_page_is_not_too_large() -> None:
    assert len(rebuilt()["index.html"]) < 1_200_000


@pytest.mark.parametrize("name", published.names("modular"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("modular", name, rebuilt())


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.modular.results.results", lambda _thorough, _progress: stored())
    monkeypatch.setattr("reports.modular.report.build", lambda found: rebuilt() if found is stored() else {})
    published.is_written("modular", rebuilt(), sched_sim, tmp_path)


def test_what_is_stored_is_read_back() -> None:
    assert set(stored().tables) == set(TABLES)
    for name, content in stored().files().items():
        assert content == (published.FOLDER / "modular" / name).read_bytes()


# ---------------------------------------------------------------------------------------------- what the text claims


def test_dropout_of_80_percent_is_felt() -> None:
    """In every reading but one the residual grows; in the last it falls."""
    error, innovation, after = rows("claim.csv")
    assert all(interval(error[name])[0] > 2.5 for name in ("position", "velocity", "acceleration"))
    assert 1.3 < interval(innovation["position"])[0] < interval(innovation["position"])[1] < 1.7
    assert interval(innovation["acceleration"])[0] > 2.5
    assert interval(after["position"])[1] < 0.7
    errors = [number(row["position"]) for row in rows("dropout.csv")]
    assert errors == sorted(errors)


def test_what_decides_is_the_time_between_measurements() -> None:
    of = {row["In a period"]: row for row in rows("rates.csv")}
    still = 100 * float(stored().records("dropout", group="usual", dropout="0.8")[0]["still"])
    assert interval(of["20"]["error at 80 %"])[0] > still
    assert interval(of["400"]["error at 80 %"])[1] < 3
    assert all(interval(row["times"])[0] > 2.1 for row in of.values())
    assert of["100"]["borne, %"] == "80"


def test_no_figure_of_the_oscillator_stands_without_its_interval() -> None:
    errors = "position|velocity|acceleration|both|error|times|1 run"
    for name in ("claim.csv", "dropout.csv", "rates.csv", "sensors.csv"):
        cells = [cell for row in rows(name) for head, cell in row.items() if re.search(errors, head) and cell != "-"]
        assert cells
        for cell in cells:
            low, high = interval(cell)
            assert low <= number(cell) <= high


def test_without_the_accelerometer_position_is_said_to_err_by_the_most_of_its_column() -> None:
    most = max((row["acceleration only"] for row in rows("sensors.csv")), key=number)
    assert f"acceleration alone is lost, position errs by {most} % at most" in text()


def test_where_its_model_is_true_the_filter_is_as_accurate_as_it_says() -> None:
    for row in rows("consistency.csv"):
        if row["Filter"] == "usual, its own model true":
            assert float(row["inside, %"]) > 90
            assert number(row["NEES"]) == pytest.approx(3, abs=0.15)
        if row["Filter"] == "usual":
            assert number(row["NEES"]) < 2.54


def test_the_run_that_is_drawn_is_half_dropped() -> None:
    run = stored().columns("oscillator")
    for name in ("position", "acceleration"):
        assert np.isnan(run[f"{name} measured"]).mean() == pytest.approx(0.5, abs=0.08)


def test_position_keeps_to_the_claim_on_the_rocket_and_each_axis_does_not() -> None:
    of = {row["Residual"]: row for row in rows("readings.csv")}
    assert float(of["position / distance from the pad"]["all, from s"]) < 0.6
    share = {name: row["hold, %"] for name, row in of.items()}
    assert number(share["position / distance from the pad"]) == 100
    assert number(share["orientation / all turned"]) == 100
    assert interval(share["position / distance from the pad"])[0] < 100  # of so many flights
    assert interval(share["worst axis / its coordinate"])[1] < 75
    assert number(share["orientation / net turn"]) < 100
    assert number(share["nose / turn of the nose"]) < 100


def test_the_extended_predictor_does_as_well() -> None:
    of = {row["Filter"]: row for row in rows("rocket-errors.csv")}
    for one, other in (("unscented", "extended"), ("dropout 95 %", "extended, dropout 95 %")):
        for name in ("position", "velocity", "acceleration", "turn rate", "orientation"):
            assert number(of[one][name]) == pytest.approx(number(of[other][name]), rel=0.01)


def test_the_filter_is_surprised_by_thrust_alone() -> None:
    means = {row["Phase"]: number(row["dropout 0 %"]) for row in rows("rocket-nees.csv")}
    assert all(12 < mean < 17.5 for mean in means.values())
    onset = stored().records("rocket-nees", case="unscented", phase="thrust onset", of="acceleration")
    assert [float(row["mean"]) > 4 for row in onset] == [True]


def test_what_ignoring_a_delay_costs() -> None:
    of = {(row["Sensors"], row["Way"]): row for row in rows("late.csv")}
    both, alone = "both", "position"
    assert number(of[both, "Fuse as fresh"]["10 late"]) > 6 * number(of[both, "Recalculate"]["10 late"])
    assert number(of[alone, "Fuse as fresh"]["2 late"]) < number(of[alone, "Recalculate"]["2 late"])
    for sensors in (both, alone):
        for name in (f"{delay} late" for delay in (0, 2, 4, 6, 8, 10)):
            larsen, recalculate = (number(of[sensors, way][name]) for way in ("Larsen", "Recalculate"))
            assert larsen == pytest.approx(recalculate, rel=0.01)
    assert len({of[alone, "Dual-rate"][f"{delay} late"] for delay in (0, 2, 4, 6, 8)}) == 1


def test_linear_and_extended_cost_the_same() -> None:
    of = {(row["Filter"], row["Part"]): row for row in rows("parts.csv")}
    for part in ("predict", "correct"):
        for n in (3, 6, 9, 15):
            linear, extended, unscented = (
                int(of[kind, part][f"n = {n}"].replace(",", "")) for kind in ("linear", "extended", "unscented")
            )
            assert extended == pytest.approx(linear, rel=0.06)
            assert 1.3 < unscented / extended < 3


def test_the_stored_counts_are_those_of_the_code() -> None:
    counted = {key: str(number) for key, number in modular_costs.operations().items()}
    assert {(r["kind"], r["states"], r["part"]): r[OPERATIONS] for r in stored().records("parts")} == counted
    for row in stored().records("late"):
        work = late_measurements.work(row["sensors"], row["way"], int(row["delay"]))
        assert (row["mean"], row["longest"]) == (f"{work.mean:.1f}", str(work.longest))


@pytest.mark.exhaust
def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other times: in tables and text only what has the mark changes, and no figure but the one that shows times."""
    here = stored().measured
    slower = {
        key: Micros(*(time * (2 + at % 3) for time in micros)) for at, (key, micros) in enumerate(here.parts.items())
    }
    another = PartTimes({**here.provenance, "machine": "another"}, slower)
    other = build(Results(stored().tables, another, stored().stored))
    published.differs_only_where_marked(rebuilt(), other, ["parts.svg"])


def test_measured_figures_are_ranges_over_the_measurements_that_are_listed() -> None:
    every, listed = stored().measurements, rows("measurements.csv")
    assert [(row["machine †"], row["date †"]) for row in listed] == [
        (one.provenance["machine"], f"{one.provenance['date']}{', busy' * ('busy' in one.provenance)}")
        for one in sorted(every, key=lambda one: str(one.provenance["date"]))
    ]
    assert f"the least times of {len(every)} measurements on 1 machine (AMD EPYC)" in text()
    assert "No other machine has measured yet, no Intel Xeon either" in text()
    shown = {
        (row["Filter"], str(n), row["Part"]): row[f"n = {n}, µs †"].split(" to ")
        for row in rows("parts.csv")
        for n in (3, 6, 9, 15)
    }
    assert shown.keys() == every[0].parts.keys()
    for key, (low, high) in shown.items():
        times = [one.parts[key].least for one in every]
        assert (float(low), float(high)) == (min(times), max(times))
    slowest = [row["predict, n = 15, µs †"].split(" to ")[0] for row in listed]
    assert f"takes {min(slowest, key=float)} to {max(slowest, key=float)} µs" in text()


def test_timed_unscented_over_extended_is_the_range_over_all_measurements() -> None:
    for part in ("predict", "correct"):
        said = []
        for n in ("3", "15"):
            ratios = [
                one.parts["unscented", n, part].least / one.parts["extended", n, part].least
                for one in stored().measurements
            ]
            said.append(span(significant(min(ratios), 2), significant(max(ratios), 2)))
            assert min(ratios) > 1
        assert " and ".join(said) in text()


def test_a_processor_holds_only_where_the_interval_and_the_landings_say_so() -> None:
    """Landings beyond the deadline are the misses of the table, and at most 1 % where a way is said to hold."""
    misses = miss_rows_of(stored().records("schedule-misses"))
    at = compared_at(misses)
    found = stored().columns("schedule-landings")
    ways = {name: way for way, name in WAY_NAMES.items()}
    for row in rows("processors.csv"):
        way = ways[row["Late fix"]]
        gps = [m for m in misses if (m.way, m.urgency, m.job) == (way, row["correction"], "GPS")]
        for held in (m for m in misses if (m.way, m.urgency) == (way, row["correction"])):
            if row["from, MHz"] != "-" and held.clock_mhz >= int(row["from, MHz"]):
                assert held.interval[1] <= 0.01
        (there,) = (m for m in gps if m.clock_mhz == at)
        landed = found[f"GPS, {way}, {row['correction']}"]
        beyond = landed[found["l - k"] > LAND_BY].sum()
        assert beyond == pytest.approx(100 * there.probability, abs=0.5)


def test_no_probability_of_a_miss_rests_on_measured_samples() -> None:
    """The schedule is the same on every machine: none of it is marked, and no samples are stored."""
    section = rebuilt()["index.md"].decode().partition("## When corrections land")[2].partition("\n## ")[0]
    assert section
    assert MARK not in section
    assert not [name for name in rebuilt() if name.startswith("samples")]
    assert "Execution times are stated, not measured" in section


def test_recalculating_in_the_loop_is_late_on_an_idle_processor() -> None:
    of = {(row["Late fix"], row["correction"]): row for row in rows("processors.csv")}
    busy = "busy, %"
    loop = of["Recalculate, extended", "in the loop"]
    assert float(loop[busy]) < 50
    assert interval(loop["loop, %"])[0] > 1
    assert interval(of["Recalculate, extended", "preempted"]["loop, %"])[1] < 1
    clocks = [
        int(of[case]["from, MHz"])
        for case in (
            ("Larsen, extended", "preempted"),
            ("Recalculate, extended", "preempted"),
            ("Recalculate, extended", "in the loop"),
        )
    ]
    assert clocks == sorted(set(clocks))


def test_each_sensor_of_the_schedule_loses_what_the_text_says() -> None:
    workload = scenario(counted(), WAYS[0], "preempted", 190)
    assert {float(sensor.dropout) for sensor in workload.sensors} == {0.1}
    assert "Each sensor loses 10 % of its measurements" in text()


# ----------------------------------------------------------------------------------------- answers, figures, future


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
