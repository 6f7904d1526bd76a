"""The committed report is what the code makes of the cost table committed with it, byte for byte."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest

from reports.pages.numbers import power
from reports.steffes.report import build
from sched_sim.costs.table import Cost
from tests.reports import published
from tests.reports.steffes.page import committed_costs, ends, every, of_table_4, rebuilt, said


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("steffes2014", rebuilt())
    published.is_self_contained(rebuilt())


@pytest.mark.parametrize("name", published.names("steffes2014"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("steffes2014", name, rebuilt())


@pytest.mark.exhaust
def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other measured costs: in the tables only columns with the mark change, in the text only lines with it, and no
    figure but the two that show measured costs."""
    table = committed_costs()
    slower = {
        method: {kind: Cost.of(cost.minimum * (2 if "update" in kind else 3)) for kind, cost in kinds.items()}
        for method, kinds in table.costs.items()
    }
    other = build(replace(table, costs=slower, provenance={**table.provenance, "machine": "another"}), every())
    published.differs_only_where_marked(rebuilt(), other, ["costs.svg", "table4.svg"])


def test_what_was_measured_for_the_page_is_in_the_range_of_all_measurements() -> None:
    rows = published.rows(rebuilt(), "costs.csv")
    assert rows
    for row in rows:
        low, high = ends(row["all measurements †"])
        assert low <= float(row["measured †"]) <= high
    for row in of_table_4():
        low, high = ends(row["measured †"])
        assert low <= float(row["measured for this page †"]) <= high


def test_numbers_are_written_alike_on_the_page_and_plainly_in_the_files() -> None:
    text = published.text(rebuilt())
    assert not re.findall(r"\| \d{4,} \|", text)
    for name in ("memory.csv", "products.csv"):
        assert all("," not in cell for row in published.rows(rebuilt(), name) for cell in row.values())
    assert [power(number) for number in ("1e-11", "3e-16")] == ["10⁻¹¹", "3\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}10⁻¹⁶"]
    assert not re.findall(r"\d[Ee][-−]\d", text)


def test_cells_are_reached_where_the_interval_from_rounding_meets_the_printed_one() -> None:
    rows = published.rows(rebuilt(), "table-4.csv")
    for row in rows:
        low, high = map(float, row["from rounding"].split(" to "))
        printed = float(row["printed"])
        assert (row["reached"] == "yes") == (low <= printed + 0.005 + 1e-9 and printed - 0.005 - 1e-9 <= high)
    assert said(r"(\d+) of the (\d+) speeds of Table 4") == (
        str(sum(row["reached"] == "yes" for row in rows)),
        str(len(rows)),
    )
    for row in rows:
        if row["reached"] == "no":
            assert f"**{row['printed']}** ({row['Method']}" in published.text(rebuilt())


def test_why_a_cell_is_not_reached_is_right_arithmetic() -> None:
    text = published.text(rebuilt())
    a, b, times, step, total = map(float, said(r"make ([\d.]+) \+ ([\d.]+) \+ (\d+) × ([\d.]+) = ([\d.]+)\."))
    assert total == pytest.approx(a + b + times * step)
    hr, update, waits = map(float, said(r"\(L − M\) = ([\d.]+) \+ ([\d.]+) / (\d+)\."))
    assert "**0.64**" in text
    assert hr + update / waits == pytest.approx(0.64, abs=0.005)
    one, other, both = map(float, said(r"it alone needs ([\d.]+) \+ ([\d.]+) = ([\d.]+)\."))
    assert one + other == pytest.approx(both)


def test_deviations_are_those_of_the_table_of_costs() -> None:
    rows = published.rows(rebuilt(), "tables-1-3.csv")
    (value,) = said(r"are off Tables 1 to 3 by ([\d.]+) by counts")
    squares = [(float(row["counted"]) - float(row["printed"])) ** 2 for row in rows]
    assert float(value) == pytest.approx(math.sqrt(sum(squares) / len(squares)), abs=0.0006)


def test_measured_figures_are_ranges_over_the_measurements_that_are_listed() -> None:
    listed = published.rows(rebuilt(), "measurements.csv")
    assert [(row["machine †"], row["date †"]) for row in listed] == [
        (table.provenance["machine"], f"{table.provenance['date']}{', busy' * ('busy' in table.provenance)}")
        for table in every()
    ]
    names = {"deviation": "deviation", "Recalculate": "Recalculate", "Larsen": "Larsen", "Dual-rate": "Dual-rate"}
    over = {name: (min(of), max(of)) for name in names if (of := [float(row[f"{name} †"]) for row in listed])}
    by_method = {row["Method"]: row for row in published.rows(rebuilt(), "table-4.csv") if row["N, M, L"] == "10, 4, 8"}
    for method, row in by_method.items():
        assert ends(row["measured †"]) == over[method]
        assert float(row["p95, at most †"]) >= over[method][1]
    assert ends(*said(r"and by ([\d.]+ to [\d.]+) † measured")) == over["deviation"]
    assert said(r"by counts, ([\d.]+ to [\d.]+) † by measurements") == (by_method["Dual-rate"]["measured †"],)
    assert said(r"and ([\d.]+ to [\d.]+) †\. - ") == (by_method["Larsen"]["measured †"],)
    assert f"{len(listed)} measurements on 1 machine (AMD EPYC)" in published.text(rebuilt())
    assert "No other machine has measured yet, no Intel Xeon either" in published.text(rebuilt())


@pytest.mark.exhaust
def test_a_machine_that_is_added_widens_ranges_and_is_named() -> None:
    table = committed_costs()
    costs = {method: {kind: Cost.of(cost.minimum) for kind, cost in of.items()} for method, of in table.costs.items()}
    costs["dual-rate"]["hr_propagate"] = Cost.of(2 * costs["dual-rate"]["hr_propagate"].minimum)
    xeon = replace(table, costs=costs, provenance={**table.provenance, "machine": "Intel Xeon"})
    files = build(table, [*every(), xeon])
    for before, after in zip(*(published.rows(of, "table-4.csv") for of in (rebuilt(), files)), strict=True):
        old, new = ends(before["measured †"]), ends(after["measured †"])
        assert new[0] <= old[0] <= old[1] <= new[1]
        assert (new[1] > old[1]) == (before["Method"] == "Dual-rate")
    assert f"on 2 machines (AMD EPYC {len(every())}, Intel Xeon 1)" in published.text(files)
    assert "No other machine" not in published.text(files)


def test_misses_are_said_of_how_many_jobs_and_cycles() -> None:
    (cycles,) = map(int, said(r"simulated over (\d+) cycles"))
    for row in published.rows(rebuilt(), "simulated.csv"):
        N = int(row["N, M, L"].split(",")[0])
        jobs = cycles * (N + 2) if row["Method"] == "Dual-rate" else cycles * N
        assert row["misses"] == f"0 of {jobs}"
        assert row["misses, slower"] == f"{cycles} of {jobs}"


def test_it_names_the_machine_and_both_findings() -> None:
    text = rebuilt()["index.md"].decode()
    assert str(committed_costs().provenance["machine"]) in text
    assert "12 of the 15 cells" in text
    assert "already lands at L = 29" in text
