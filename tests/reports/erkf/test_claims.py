"""What the report on the robust filter says is true, by its own tables."""

from __future__ import annotations

import csv
import re
from fractions import Fraction
from inspect import signature

import numpy as np
import pytest

from filters.systems.attitude import attitude, attitude_uncertainty
from filters.systems.position import position, position_uncertainty
from reports.erkf import counts as ways
from reports.erkf import tables
from reports.erkf.counts import all_counts, parallel
from reports.erkf.drive import windowed_rms, wrapped_deg
from reports.erkf.results import CURVES
from reports.pages.numbers import power, span
from sched_sim.costs.methods import ROBUST_METHODS
from sched_sim.costs.table_file import load_costs
from sched_sim.design.fit import fit
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.pieces import StandardCosts
from sched_sim.design.timing import Timing
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.robust import drive
from studies.robust.costs import HR_HZ, SYSTEMS, N, between_fixes
from studies.robust.counts import PENALTIES, filled
from studies.robust.drive import SETTLED_S
from tests.reports.erkf.page import costs_of, rebuilt, rows, stored, text

pytestmark = pytest.mark.exhaust  # the study takes a quarter of a minute; `studies/robust` has its tests


def test_the_verdict_on_givens() -> None:
    counts = all_counts()
    for system in SYSTEMS:
        assert counts.ratio(ways.REPEATED, ways.PER_COLUMN, system) == pytest.approx(2.26, abs=0.03)
        assert counts.ratio(ways.GIVENS, ways.INVERSE, system) == pytest.approx(1.21, abs=0.01)
        for penalty in ("infinite", "finite"):
            assert counts.ratio(ways.GIVENS_ORDERED, ways.LU_ORDERED, system, penalty) > 5
            assert counts.ratio(ways.LU_ORDERED, ways.CLOSED, system, penalty) > 1.2
    assert "(2.26 and 2.25 times fewer operations)" in text()


def test_the_answer_is_short_and_its_times_are_those_of_the_figure() -> None:
    answer = text().partition("**Answer.** ")[2].partition("![")[0]
    assert len(answer.split()) <= 50
    milliseconds = {(row["System"], row["Way"]): float(row["from fix to result, ms"]) for row in rows("ways.csv")}
    for way, words in (
        ("closed form", "in closed form ({} ms on a 100 MHz processor"),
        ("pivoted LU", "by pivoted LU ({} ms)"),
        ("Givens", "Givens rotations take {} ms, too long for each 2.5 ms period"),
    ):
        assert words.format(f"{milliseconds['position', way]:#.3g}") in answer
    in_time = {way for (system, way), time in milliseconds.items() if system == "position" and time <= 2.5}
    assert in_time == {"pivoted LU", "closed form"}
    assert max(milliseconds.values()) < 100


def test_the_inverse_of_the_answer_is_the_dense_one_and_the_others_skip_zeros() -> None:
    """As the caption of the first figure says: a leon3's times follow the operations of these ways."""
    milliseconds = {row["Way"]: float(row["from fix to result, ms"]) for row in rows("ways.csv")}
    assert milliseconds["inverse"] > 10 * milliseconds["Givens"]
    assert costs_of(ways.INVERSE_SKIPPING, "position") < 4 * costs_of(ways.GIVENS_ORDERED, "position")
    assert costs_of(ways.INVERSE, "position") > 15 * costs_of(ways.GIVENS_ORDERED, "position")
    assert "The inverse is dense, the other ways skip zeros." in text()


def test_the_matrix_is_sparse_and_its_inversion_nearly_all_of_the_inverse() -> None:
    shares = [100 * filled(system, penalty) for system in SYSTEMS for penalty in PENALTIES]
    assert f"{min(shares):.0f} to {max(shares):.0f} % are not zero" in text()
    counts = all_counts()
    for system in SYSTEMS:
        N, inverse = counts.unknowns[system], costs_of(ways.INVERSE, system)
        assert round(100 * (2 * N**3 - N**2 + N) / inverse) == 98
    assert "operations 98 % are the inversion" in text()


def test_reflections_beat_rotations_but_in_the_natural_order_where_mu_is_infinite() -> None:
    skipped = {}
    for column in ("attitude, μ = ∞", "position, μ = ∞", "attitude", "position"):
        skipped[column] = costs_of(ways.HOUSEHOLDER_NATURAL, column) / costs_of(ways.GIVENS_NATURAL, column)
        assert (skipped[column] > 1) == ("∞" in column)
        assert costs_of(ways.HOUSEHOLDER_ORDERED, column) < costs_of(ways.GIVENS_ORDERED, column)
        assert costs_of(ways.HOUSEHOLDER, column) < costs_of(ways.GIVENS, column)
    of_attitude, of_position, finite_attitude, finite_position = (f"{ratio:.2f}" for ratio in skipped.values())
    assert f"reflections take {of_attitude} and {of_position} times the operations of the rotations" in text()
    assert f"with finite μ {finite_attitude} and {finite_position}." in text()


def test_faddeevs_algorithm_takes_what_lu_does_and_givens_several_times_that() -> None:
    over_lu, under_givens = [], []
    for system in SYSTEMS:
        faddeev = costs_of(ways.FADDEEV_ORDERED, system)
        over_lu.append(f"{faddeev / costs_of(ways.LU_ORDERED, system):.2f}")
        under_givens.append(f"{costs_of(ways.GIVENS_ORDERED, system) / faddeev:.1f}")
        assert faddeev == pytest.approx(costs_of(ways.LU_ORDERED, system), rel=0.06)
    assert f"it takes {' and '.join(over_lu)} times what LU does" in text()
    assert f"Givens {' and '.join(under_givens)} times as many." in text()


def test_position_gains_nothing_by_robustness_and_loses_by_some_rows() -> None:
    """With the accelerometers' scale as wrong as the gyros', too."""
    of = {
        (record["scale_error"], record["accelerometer_error"], record["method"]): record
        for record in stored().records("position")
    }
    cases = dict.fromkeys((gyros, accelerometers) for gyros, accelerometers, _ in of)
    assert list(cases) == [("0.02", "0.002"), ("0.1", "0.002"), ("0.02", "0.02"), ("0.1", "0.1")]
    for case in cases:
        plain, robust = of[*case, "EKF"], of[*case, "ERKF mu=1e8, accelerometer row"]
        assert not any(tables.differ(plain, robust, name) for name in tables.OF_POSITION)
    plain = of["0.1", "0.1", "EKF"]
    for worse in ("ERKF mu=1e8, bias row", "ERKF mu=1e8, accelerometer row of 10 %"):
        assert float(of["0.1", "0.1", worse]["outage_end_m"]) > 2 * float(plain["outage_end_m"])
        assert tables.differ(of["0.1", "0.1", worse], plain, "outage_end_m")
    for (*case, method), record in of.items():
        if tuple(case) == ("0.1", "0.002"):
            assert not any(tables.differ(record, of["0.02", "0.002", method], name) for name in tables.OF_POSITION)
    table = rows("position-errors.csv")
    assert list(dict.fromkeys(row["Scale errors"] for row in table)) == ["2 % / 0.2 %", "2 % / 2 %", "10 % / 10 %"]
    shown = {row["Filter"]: row["GPS out, end, m"] for row in table if row["Scale errors"] == "10 % / 10 %"}
    said = (
        f"ten seconds without GPS end at {shown['EKF']} m (EKF), {shown['ERKF μ = 10⁸, accelerometer row']} m (that "
        f"row) and {shown['EKF with I/μ only, μ = 10⁸']} m (I/μ alone). The row of the biases makes it "
        f"{shown['ERKF μ = 10⁸, bias row']} m"
    )
    assert said in text()
    assert "roll and pitch get worse, and at 2 % yaw too. Position gains nothing." in text()


def test_the_page_says_what_noises_are_simulated_and_given_to_the_filters() -> None:
    of_attitude, of_position = (
        {name: parameter.default for name, parameter in signature(model).parameters.items()}
        for model in (attitude, position)
    )
    for words in (
        f"{of_attitude['gyro_sigma']} rad/s of the gyros, {of_position['accelerometer_sigma']} m/s² of the",
        f"{of_attitude['tilt_sigma']} rad of the unit's angles, {of_position['velocity_sigma']} m/s of GPS speeds",
        f"of {of_attitude['bias_sigma']} rad/s ({of_attitude['correlation_s']:g} s) and {of_position['bias_sigma']}"
        f" m/s² ({of_position['correlation_s']:g} s)",
        f"the filter takes it for {of_attitude['yaw_sigma']} rad",
    ):
        assert words in text()
    stated = [
        signature(rows_of).parameters["scale_error"].default for rows_of in (attitude_uncertainty, position_uncertainty)
    ]
    assert f"±{100 * stated[0]:g} % of the gyros' scale and ±{100 * stated[1]:g} % of the accelerometers'" in text()
    assert stated == [drive.EKF.stated, drive.POSITION_EKF.stated]


def test_what_the_figures_of_one_drive_are_said_to_show() -> None:
    course = stored().columns("drive")
    rms = {
        (name, angle): windowed_rms(wrapped_deg(course[f"{name} 10 % {angle}"] - course[f"true {angle}"]))[1:]
        for name in ("EKF", "ERKF")
        for angle in ("pitch", "yaw")
    }
    assert (rms["ERKF", "pitch"] > rms["EKF", "pitch"]).all()
    said = f"yaw error goes up to {rms['ERKF', 'yaw'].max():.2f} degrees, the EKF's to {rms['EKF', 'yaw'].max():.2f};"
    assert said in text()
    assert "pitch error is larger throughout" in text()
    assert np.ptp(course["true up"]) > 1
    assert "the inertial unit's drifts away by 8 degrees" in text()
    settled = course["time_s"] >= SETTLED_S
    off = [
        np.abs(wrapped_deg(course[f"{name} 10 % yaw"] - course["true yaw"])[settled]).max() for name in ("EKF", "ERKF")
    ]
    assert f"The yaw of both filters stays within {max(off):.1f} degrees of the true one" in text()


def test_the_schedules_of_the_figure_are_in_its_file() -> None:
    """In one period the robust step runs over the next ones; with two rates it ends at L."""
    robust = [row for row in rows("deadlines.csv") if row["work"] == "RS"]
    ends = {row["Method"]: float(row["to"]) for row in robust}
    assert ends["Two rates, L = 10"] == pytest.approx(10, abs=2e-4)
    assert 9 < ends["In one period, at the same speed"] < 10
    assert "with the step in one period the 9 propagations behind it miss theirs" in text()
    (takes,) = {
        float(row["to"]) - float(row["from"])
        for row in rows("deadlines.csv")
        if row["Method"] == "Two rates, L = 10" and row["work"] == "IP" and row["of step"] == "1"
    }
    assert f"A propagation takes {100 * takes:.1f} % of a period here" in text()


def test_the_page_says_which_filters_figures_7_and_8_show() -> None:
    attitude, position = CURVES
    assert (attitude.name, position.name) == ("attitude, gyro row, mu=1e5", "position, bias row, mu=1e8")
    assert "attitude, gyro row, μ = 10⁵, and position, bias row, μ = 10⁸" in text()


def test_the_table_of_processors_is_that_of_all_its_verdicts() -> None:
    of = {(row["Processor"], row["Way"]): row for row in rows("processors.csv") if row["System"] == "position"}
    heading, *body = tables.part_rows(load_costs("erkf-position"), [load_part(name) for name in shipped_parts()])
    assert len(body) == 10
    for name, *cells in body:
        for way, cell in zip(heading[1:], cells, strict=True):
            at_fixes, in_each = cell.split(" / ")
            assert (at_fixes == "no") == (of[name, way]["fits"] == "no")
            assert (in_each == "no") == (float(of[name, way]["in one period, %"]) > 100)


def test_sparsity_against_processors() -> None:
    """One processor that skips zeros is about as fast as 16 that do not, and 16 faster than 1024 that do not."""
    dense, _, ordered = ways.SCHEDULES
    for system in SYSTEMS:
        times = parallel(system).times
        assert times[ordered][1] == pytest.approx(times[dense][16], rel=0.05)
        assert times[ordered][16] < times[dense][1024]
        assert times[ordered][64] < 1.25 * times[ordered][1024]


def test_in_one_period_is_what_l_1_asks_for() -> None:
    for system in SYSTEMS:
        for method in ROBUST_METHODS:
            costs = tables.robust_costs_of(load_costs(f"erkf-{system}"), method)
            serial = least_speed(StandardCosts(costs.inertial, costs.robust_step), Timing(N, 0, N)).speed
            assert serial == least_speed(costs, Timing(N, 0, 1)).speed
            assert achieved_l(costs, Timing(N, 0, N), least_speed(costs, Timing(N, 0, N)).speed) == N


def test_every_processor_has_a_verdict_on_every_way() -> None:
    of = rows("processors.csv")
    assert [row["Processor"] for row in of] == [n for _ in SYSTEMS for n in shipped_parts() for _ in tables.WAYS]
    assert {row["fits"] for row in of} == {"yes", "no", "no sqrt"}
    for row in of:
        assert (row["fits"] == "no sqrt") == (row["load, %"] == "-")
        assert (row["fits"] == "yes") == (row["in use at l"] != "-")
    slow = {row["Processor"] for row in of if row["System"] == "position" and row["fits"] == "no"}
    assert slow == {"cortex-m0plus", "rp2040"}
    said = "8 of these 10 run every way with one robust step for each fix, not cortex-m0plus and rp2040;"
    assert said in text()


def test_the_filter_of_the_drive_is_not_the_one_that_is_scheduled_and_the_page_says_what_it_would_take() -> None:
    """A robust step in every period, N = 1, takes the whole speed that a step in one period does."""
    leon3 = {
        row["Way"]: row for row in rows("processors.csv") if (row["System"], row["Processor"]) == ("position", "leon3")
    }
    part, needed = load_part("leon3"), {}
    for method, way in tables.WAYS.items():
        costs = tables.on(load_costs("erkf-position"), part, method)
        assert costs is not None
        found = fit(costs, Timing(1, 0, 1), Fraction(HR_HZ))
        needed[way] = float(found.needed)
        assert f"{100 * needed[way]:.2f}" == leon3[way]["in one period, %"]
        assert found.fits == (way in ("pivoted LU", "closed form"))
    inverse, givens, lu, closed = needed.values()
    claim = (
        f"{inverse:.1f} times the leon3's speed by the inverse, {givens:.2f} times it by Givens, {100 * lu:.1f} % of "
        f"it by pivoted LU and {100 * closed:.1f} % of it in closed form"
    )
    assert claim in text()
    assert "in it: the processor is too slow for inverse and Givens." in text()
    assert "**These filters take a robust step in every 400 Hz step**" in text()
    assert "with one in every period only desktop" in text()


def test_a_step_without_a_measurement_is_compared_with_one_that_has_it() -> None:
    shares = between_fixes("position")
    assert shares["inverse"] < shares["closed"] < 0.5 < shares["givens"] < 1 < shares["lu"]
    assert (
        "0.40 times the operations by the inverse, 0.98 by Givens, 1.52 by pivoted LU and 0.47 in closed form" in text()
    )


def test_givens_and_pivoted_lu_agree_with_the_inverse_and_unpivoted_lu_does_not() -> None:
    for record in stored().records("agreement"):
        if record["way"] == "lu without pivoting":
            assert (record["fails_in_step"] == "1") == ("inf" in record["case"])
        else:
            assert record["fails_in_step"] == ""
            assert max(float(record["largest"]), float(record["smallest"])) < 1e-10


def test_lu_without_pivoting_fails_where_mu_is_infinite_and_the_page_counts_them() -> None:
    unpivoted = [row for row in rows("agreements.csv") if row["Way"] == "unpivoted LU"]
    failing = [row for row in unpivoted if row["fails in"] != "-"]
    assert failing == [row for row in unpivoted if "μ = ∞" in row["Filter"]]
    of = f"in {len(failing)} of {len(unpivoted)} filters"
    assert f"Only LU without pivoting fails, {of}." in text()
    assert f"It meets a zero pivot in step 1 {of}, those with μ = ∞." in text()


def test_measured_figures_are_ranges_over_the_measurements_that_are_listed() -> None:
    listed = {system: rows(f"measurements-{system}.csv") for system in SYSTEMS}
    assert {len(of) for of in listed.values()} == {len(stored().measurements["position"])}
    assert f"{len(listed['position'])} measurements on 1 machine (AMD EPYC)" in text()
    assert "No other machine has measured yet, no Intel Xeon either" in text()
    least = {
        (system, way): sorted((row[f"{way}, µs †"].split(" to ")[0] for row in of), key=float)
        for system, of in listed.items()
        for way in tables.WAYS.values()
    }
    shown = [cell for line in csv.reader(rebuilt()["costs.csv"].decode().splitlines()) for cell in line[3::3]]
    for times in least.values():
        assert span(times[0], times[-1]) in shown
    low, *_, high = least["position", "inverse"]
    share = span(*(f"{float(micros) * HR_HZ / 1e4:.1f}" for micros in (low, high)))
    assert f"Even the slowest, {low} to {high} µs, takes {share} % of a period" in text()
    alone = {name: [table] for name, table in stored().measured.items()}
    assert " to " not in str(tables.cost_rows(all_counts(), alone))
    loads = [[float(end) for end in row["load, % †"].split(" to ")] for row in rows("speeds.csv")]
    assert all(load == sorted(load) for load in loads)


def test_by_each_measurement_the_times_are_in_the_order_that_is_said() -> None:
    """Inverse, Givens, pivoted LU, closed form; of each system, by least times."""
    for system in SYSTEMS:
        for table in stored().measurements[system]:
            times = [table.entry(method, "robust_step").minimum for method in tables.WAYS]
            assert times == sorted(times, reverse=True)


def test_differences_that_are_said_are_those_of_the_table() -> None:
    """Of both ways where states are in radians, and of the two filters that are drawn."""
    agreed = [row for row in rows("agreements.csv") if row["Way"] in ("Givens", "pivoted LU")]
    radians = [row for row in agreed if "radians" in row["Filter"]]
    most = max(float(row["min, rel. †"]) for row in radians)
    assert f"smallest singular value differs by {100 * most:.0f} % †" in text()
    drawn = [
        row
        for row in agreed
        if row["Way"] == "Givens" and row["Filter"] in [tables.spoken(case.name) for case in CURVES]
    ]
    assert len(drawn) == 2
    most = max(float(row[heading]) for row in drawn for heading in ("max, abs. †", "min, abs. †"))
    assert f"of these two filters, they differ by {' '.join(power(f'{most:.0e}').split())} † at most" in text()


def test_what_is_only_rounding_has_one_digit() -> None:
    (heading, *body) = (line for line in rebuilt()["agreements.csv"].decode().splitlines())
    assert heading.count("†") == 4
    assert body
    assert all(re.fullmatch(r"-|\de-\d\d", row[head]) for row in rows("agreements.csv") for head in row if "†" in head)


def test_at_a_large_scale_error_the_price_of_a_better_yaw_is_said() -> None:
    """Roll and pitch of the robust filter are worse than the EKF's, by more than the errors of both."""
    of = {row["method"]: row for row in stored().records("attitude") if row["scale_error"] == "0.1"}
    robust, plain = of["ERKF mu=1e4, gyro row"], of["EKF"]
    for angle in ("roll_deg", "pitch_deg"):
        assert float(robust[angle]) > float(plain[angle])
        assert tables.differ(robust, plain, angle)
        assert f"{100 * (float(robust[angle]) / float(plain[angle]) - 1):.0f} %" in text()


def test_where_robustness_pays() -> None:
    yaw = {
        (row["Scale error"], row["Filter"]): float(row["yaw, °"].split(" ± ")[0]) for row in rows("attitude-errors.csv")
    }
    assert yaw["10 %", "ERKF μ = 10⁴, gyro row"] < 0.65 * yaw["10 %", "EKF"]
    assert yaw["10 %", "EKF with I/μ only, μ = 10⁴"] == pytest.approx(yaw["10 %", "ERKF μ = 10⁴, gyro row"], rel=0.05)
    assert "In simulation, process noise helps yaw as much as robustness does." in text()
    assert yaw["2 %", "ERKF μ = 10⁴, gyro row"] > yaw["2 %", "EKF"]
    assert "roll and pitch get worse, and at 2 % yaw too" in text()
    for rows_said in ("gyro row", "bias row", "all rows"):
        assert yaw["2 %", f"ERKF μ = ∞, {rows_said}"] > 4 * yaw["2 %", "EKF"]


def test_a_device_of_more_units_is_faster() -> None:
    for system in SYSTEMS:
        times = [float(row["step, ms"]) for row in rows("device.csv") if row["System"] == system]
        assert times == sorted(times, reverse=True)
        assert Fraction(str(times[0])) > 0
