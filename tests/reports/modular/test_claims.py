"""What the report says of dropout, the rocket, costs and its schedule is what its tables say."""

from __future__ import annotations

import re

import numpy as np
import pytest

from filters.systems.rocket_filter import TUNED, sensors
from reports.modular.biases import ALL
from reports.modular.costs import OPERATIONS
from reports.modular.schedule import miss_rows_of
from reports.modular.styles import WAY_NAMES
from reports.pages.machine import MARK
from reports.pages.numbers import significant, span
from studies.modular import costs as modular_costs
from studies.modular import late_measurements
from studies.modular.rocket_schedule import LAND_BY, WAYS, compared_at, counted, scenario
from tests.reports.modular.page import interval, number, rebuilt, rows, stored, text


def test_dropout_of_80_percent_is_felt() -> None:
    """In every reading but one the residual grows; in the last it falls."""
    error, innovation, after = rows("claim.csv")
    assert all(interval(error[name])[0] > 2.5 for name in ("position", "velocity", "acceleration"))
    assert 1.3 < interval(innovation["position"])[0] < interval(innovation["position"])[1] < 1.7
    assert interval(innovation["acceleration"])[0] > 2.5
    assert interval(after["position"])[1] < 0.7
    errors = [number(row["position"]) for row in rows("dropout.csv")]
    assert errors == sorted(errors)
    of = {row["Dropout, %"]: interval(row["position"])[0] for row in rows("dropout.csv")}
    still = 100 * float(stored().records("dropout", group="usual", dropout="0.95")[0]["still"])
    assert of["80"] < 2 * 5 < of["90"] < still < of["95"]


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
        if row["Filter"] == "model true":
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


def test_position_bears_biases_as_large_as_the_noise_and_orientation_does_not() -> None:
    of = {(row["Bias of"], row["size"]): row for row in rows("biases.csv")}
    none, every, more = of["none", "-"], of["all", "1"], of["all", "3"]
    base = next(row for row in rows("rocket-errors.csv") if row["Filter"] == "unscented")
    assert [none[f"{name}, {unit}"] for name, unit in (("position", "m"), ("orientation", "°"))] == [
        base["position"], base["orientation"],
    ]  # fmt: skip
    assert {number(row["position holds, %"]) for key, row in of.items() if key != ("all", "3")} == {100}
    assert interval(more["position holds, %"])[1] < 65
    assert number(none["orientation holds, %"]) == 100 > 95 > interval(every["orientation holds, %"])[1]
    assert f"in {every['orientation holds, %']} % of the flights" in text()
    assert f"position holds in {more['position holds, %']} %, and in all from {more['position from s']} s on" in text()
    (stored_row,) = stored().records("rocket-biases", size="1", biased=ALL)
    assert 12 < float(stored_row["position worst"]) < 15
    assert f"**position holds, barely** ({stored_row['position worst']} % at worst)" in text()
    assert "with biases as large as the noise position stays below, orientation does not" in text()


def test_the_rockets_sensors_are_said_as_the_filter_is_told() -> None:
    sigmas = {sensor.name: np.sqrt(np.diagonal(sensor.corrector.R)) for sensor in sensors()}
    level, up = sigmas["GPS"][[0, 3]], sigmas["GPS"][[2, 5]]
    assert f"GPS {level[0]:g} m and {level[1]:g} m/s (upward {up[0]:g} m and {up[1]:g} m/s)" in text()
    assert f"barometer {sigmas['barometer'][0]:g} m, gyro {sigmas['gyro'][0]:g} rad/s" in text()
    assert f"accelerometer {sigmas['accelerometer'][0]:g} m/s², camera {np.degrees(sigmas['camera'][0]):g}°" in text()
    assert "of a size that the filter knows, and no biases" in text()
    assert f"densities {TUNED.jerk:g} (m/s³)²/Hz, and {TUNED.roll:g} (roll) and {TUNED.across:g} (rad/s²)²/Hz" in text()


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
    for measuring in (both, alone):
        for name in (f"{delay} late" for delay in (0, 2, 4, 6, 8, 10)):
            larsen, recalculate = (number(of[measuring, way][name]) for way in ("Larsen", "Recalculate"))
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
