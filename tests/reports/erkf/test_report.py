"""The committed report is what the code makes of the results stored in it, byte for byte, and what it says is true."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from reports.erkf import counts as ways
from reports.erkf import tables
from reports.erkf.counts import all_counts, parallel
from reports.erkf.report import build
from reports.erkf.results import TABLES, Results, read
from reports.pages.stored import Rows
from sched_sim.costs.methods import ROBUST_METHODS
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.fit import fit
from sched_sim.design.least_speed import least_speed
from sched_sim.design.pieces import StandardCosts
from sched_sim.design.timing import Timing
from sched_sim.processors.part_file import load_part, shipped_parts
from studies.robust.costs import HR_HZ, SYSTEMS, N, between_fixes
from tests.command_line import Run
from tests.reports import published

pytestmark = pytest.mark.exhaust  # the study takes a quarter of a minute; `studies/robust` has its tests

PUBLISHED = published.FOLDER / "erkf"


@cache
def stored() -> Results:
    return read(PUBLISHED)


@cache
def rebuilt() -> dict[str, bytes]:
    return build(stored())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("erkf", rebuilt())
    published.is_self_contained(rebuilt())


@pytest.mark.parametrize("name", published.names("erkf"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("erkf", name, rebuilt())


@pytest.mark.exhaust
def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other times, other residues: in tables and text only what has the mark changes, and no figure but those two."""

    def slower(table: CostTable) -> CostTable:
        costs = {
            method: {kind: Cost.of(cost.minimum * (2 + number)) for kind, cost in kinds.items()}
            for number, (method, kinds) in enumerate(table.costs.items())
        }
        return replace(table, costs=costs, provenance={**table.provenance, "machine": "another"})

    heading, *body = stored().tables["agreement"]
    others = [[f"{3 * float(cell):.2g}" if 2 <= n < 7 else cell for n, cell in enumerate(row)] for row in body]
    other = build(
        Results(
            {name: slower(table) for name, table in stored().measured.items()},
            {**stored().tables, "agreement": [heading, *others], "singular-values": _other_residues()},
        )
    )
    published.differs_only_where_marked(rebuilt(), other, ["costs.svg", "singular-values.svg"])


def _other_residues() -> Rows:
    """Differences of singular values, three times as large."""
    heading, *body = stored().tables["singular-values"]
    residues = [number for number, head in enumerate(heading) if len(str(head).split()) > 2]
    assert residues
    return [heading, *([f"{3 * float(v or 'nan'):g}" if n in residues else v for n, v in enumerate(r)] for r in body)]


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.erkf.results.results", lambda _thorough, _progress: stored())
    monkeypatch.setattr("reports.erkf.report.build", lambda found: rebuilt() if found is stored() else {})
    published.is_written("erkf", rebuilt(), sched_sim, tmp_path)


def test_what_is_stored_is_read_back() -> None:
    assert set(stored().tables) == set(TABLES)
    for name, content in stored().files().items():
        assert content == (PUBLISHED / name).read_bytes()
    course = stored().columns("drive")
    np.testing.assert_allclose(course["time_s"], np.arange(1000) / 10)
    assert not any(np.isnan(values).any() for values in course.values())


# ------------------------------------------------------------------------------------------ what the text claims


def test_the_verdict_on_givens() -> None:
    counts = all_counts()
    for system in SYSTEMS:
        assert counts.ratio(ways.REPEATED, ways.PER_COLUMN, system) == pytest.approx(2.26, abs=0.03)
        assert counts.ratio(ways.GIVENS, ways.INVERSE, system) == pytest.approx(1.21, abs=0.01)
        for penalty in ("infinite", "finite"):
            assert counts.ratio(ways.GIVENS_ORDERED, ways.LU_ORDERED, system, penalty) > 5
            assert counts.ratio(ways.LU_ORDERED, ways.CLOSED, system, penalty) > 1.2
    assert "(2.26 and 2.25 times fewer operations)" in text()


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
    for row in rows("speeds.csv"):
        assert row["in one period"] == row["L = 1"]
        assert row["lands at"] == str(N)


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
        needed[way] = f"{100 * float(found.needed):.2f}"
        assert needed[way] == leon3[way]["in one period, %"]
        assert found.fits == (way in ("pivoted LU", "closed form"))
    inverse, givens, lu, closed = needed.values()
    assert (inverse, givens, lu, closed) == ("1955.65", "116.44", "23.72", "16.74")
    claim = (
        f"With a robust step in every 400 Hz step the inverse needs {inverse} % of the leon3's speed, Givens {givens} "
        f"%, LU {lu} % and the closed form {closed} %: the processor is too slow for explicit inverse and Givens."
    )
    assert claim in text()
    assert f"{inverse} % of the leon3's speed by the inverse, {givens} % by Givens, {lu} % by LU and" in text()
    assert "**These filters take a robust step in every 400 Hz step**" in text()
    assert "with one in every period only desktop" in text()


def test_a_step_without_a_measurement_is_compared_with_one_that_has_it() -> None:
    shares = between_fixes("position")
    assert shares["inverse"] < shares["closed"] < 0.5 < shares["givens"] < 1 < shares["lu"]
    assert "0.40 times the operations by the inverse, 0.98 by Givens, 1.52 by LU and 0.47 in closed form" in text()


def test_givens_and_pivoted_lu_agree_with_the_inverse_and_unpivoted_lu_does_not() -> None:
    for record in stored().records("agreement"):
        if record["way"] == "lu without pivoting":
            assert (record["fails_in_step"] == "1") == ("inf" in record["case"])
        else:
            assert record["fails_in_step"] == ""
            assert max(float(record["largest"]), float(record["smallest"])) < 1e-10


def test_lu_without_pivoting_fails_where_mu_is_infinite_and_the_page_counts_them() -> None:
    unpivoted = [row for row in rows("agreements.csv") if row["Way"] == "LU, no pivoting"]
    failing = [row for row in unpivoted if row["fails in"] != "-"]
    assert failing == [row for row in unpivoted if "mu=inf" in row["Filter"]]
    assert f"fails in step 1 in {len(failing)} of {len(unpivoted)} filters, those with μ = ∞" in text()


def test_measured_figures_are_ranges_from_minimum_to_p95() -> None:
    step = stored().measured["position"].entry("robust-inverse", "robust_step")
    low, high = (f"{1e6 * float(time):.1f}" for time in (step.minimum, step.p95))
    assert f"{low} to {high}" in rebuilt()["costs.csv"].decode()
    assert f"even the slowest, {low} to {high} µs, takes" in text()
    for row in rows("speeds.csv"):
        least, most = map(float, row["load, % †"].split(" to "))
        assert least < most
    alone = {name: one_number(table) for name, table in stored().measured.items()}
    assert " to " not in str(tables.cost_rows(all_counts(), alone))


def one_number(table: CostTable) -> CostTable:
    """The table by its least costs alone."""
    costs = {
        method: {kind: Cost.of(cost.minimum) for kind, cost in kinds.items()} for method, kinds in table.costs.items()
    }
    return replace(table, costs=costs)


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
        (row["Scale error"], row["Filter"]): float(row["yaw"].split(" ± ")[0]) for row in rows("attitude-errors.csv")
    }
    assert yaw["10 %", "ERKF mu=1e4, gyro row"] < 0.65 * yaw["10 %", "EKF"]
    assert yaw["10 %", "KF with I/mu only, mu=1e4"] == pytest.approx(yaw["10 %", "ERKF mu=1e4, gyro row"], rel=0.05)
    assert yaw["2 %", "ERKF mu=1e4, gyro row"] > yaw["2 %", "EKF"]
    for rows_said in ("gyro row", "bias row", "all rows"):
        assert yaw["2 %", f"ERKF mu=inf, {rows_said}"] > 4 * yaw["2 %", "EKF"]


def test_a_device_of_more_units_is_faster() -> None:
    for system in SYSTEMS:
        times = [float(row["step, ms"]) for row in rows("device.csv") if row["System"] == system]
        assert times == sorted(times, reverse=True)
        assert Fraction(str(times[0])) > 0
