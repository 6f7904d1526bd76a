"""The committed report is what the code makes of the cost table committed with it, byte for byte."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache

import pytest

from reports.pages.machine import residue
from reports.steffes.report import build
from reports.steffes.rows import power
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import read_costs
from studies.machines.store import kept
from studies.steffes.noise import APPROXIMATIONS, tried
from studies.steffes.noise_long import worst
from tests.reports import published

METHODS = ("Larsen", "Recalculate")


@cache
def committed_costs() -> CostTable:
    return read_costs(published.FOLDER / "steffes2014" / "measured.toml")


@cache
def every() -> tuple[CostTable, ...]:
    """All that have been measured."""
    return kept("measured-9-3-3")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(committed_costs(), every())


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


def said(pattern: str) -> tuple[str, ...]:
    """What stands in the text in place of the groups; it must stand there once or always the same."""
    (found,) = set(re.findall(pattern, published.text(rebuilt())))
    return (found,) if isinstance(found, str) else found


def test_the_answer_is_short_and_that_of_table_4() -> None:
    answer = published.text(rebuilt()).partition("**Answer.**")[2].partition(" ![")[0]
    assert len(answer.split()) <= 50
    least = {
        row["Method"]: float(row["analysis"])
        for row in published.rows(rebuilt(), "table-4.csv")
        if row["N, M, L"] == "10, 4, 8"
    }
    assert f"least speed {least['Dual-rate']:.2f} against {least['Larsen']:.2f}" in answer
    assert f"{100 * least['Dual-rate'] / least['Larsen']:.0f} % of Larsen's" in answer


def test_the_first_figure_is_low_enough_for_the_first_screen() -> None:
    (height,) = re.findall(r'<svg[^>]* height="([\d.]+)pt"', rebuilt()["fig3.svg"].decode())
    assert float(height) / 72 * 25.4 < 95


def test_cells_are_reached_where_the_interval_from_rounding_meets_the_printed_one() -> None:
    rows = published.rows(rebuilt(), "table-4.csv")
    for row in rows:
        low, high = map(float, row["from rounding"].split(" to "))
        printed = float(row["printed"])
        assert (row["reached"] == "yes") == (low <= printed + 0.005 + 1e-9 and printed - 0.005 - 1e-9 <= high)
    assert said(r"(\d+) of (\d+) cells of") == (str(sum(row["reached"] == "yes" for row in rows)), str(len(rows)))
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
    (value,) = said(r"Operation counts of the real filters come within ([\d.]+)")
    squares = [(float(row["counted"]) - float(row["printed"])) ** 2 for row in rows]
    assert float(value) == pytest.approx(math.sqrt(sum(squares) / len(squares)), abs=0.0006)


def ends(cell: str) -> tuple[float, float]:
    """Of a range, or of one number."""
    numbers = [float(number) for number in cell.split(" to ")]
    return numbers[0], numbers[-1]


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
    assert ends(*said(r"compiled code by ([\d.]+ to [\d.]+) †")) == over["deviation"]
    assert said(r"by counts, ([\d.]+ to [\d.]+) † by these") == (by_method["Dual-rate"]["measured †"],)
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
        assert row["misses, one tick slower"] == f"{cycles} of {jobs}"


def test_states_agree_outside_m_to_l_minus_1_as_said() -> None:
    rows = published.rows(rebuilt(), "agreement.csv")
    apart = {
        waits: [float(row[f"{method}, state"]) for row in rows if row["m to l − 1"] == waits for method in METHODS]
        for waits in ("yes", "no")
    }
    assert f"differ by {written(max(apart['no']))} of the largest" in published.text(rebuilt())
    low, high = said(r"states differ by (\d+) % to (\d+) %")
    assert (low, high) == (f"{100 * min(apart['yes']):.0f}", f"{100 * max(apart['yes']):.0f}")
    of_P = [float(row[f"{method}, P"]) for row in rows for method in METHODS if row[f"{method}, P"]]
    assert f"P<sub>k⁻</sub> than {written(max(of_P))}." in published.text(rebuilt())


def written(value: float) -> str:
    """A rounding residue as the text has it, spaces being all alike."""
    return " ".join(power(residue(value)).split())


def test_products_and_memory_are_those_of_their_tables() -> None:
    products = published.rows(rebuilt(), "products.csv")
    for row in products:
        assert row["more than standard"] == row["n³"]
        assert int(row["saved by Q′"]) == 2 * int(row["n³"])
        assert row["Larsen"] == row["Dual-rate"]
        assert row["Dual-rate, Q′"] == row["Dual-rate, Q″"]
    assert said(r"for n = ([\d, ]+); Larsen's") == (", ".join(row["n"] for row in products),)
    larsen, dual = published.rows(rebuilt(), "memory.csv")
    (factor,) = said(r"([\d.]+) times Larsen's memory")
    numbers = [int(row["numbers in all"].replace(",", "")) for row in (dual, larsen)]
    assert float(factor) == pytest.approx(numbers[0] / numbers[1], abs=0.005)
    assert said(r"It keeps (\d) matrices of n × n instead of (\d)") == (dual["n × n kept"], larsen["n × n kept"])


@pytest.mark.parametrize("source", ["printed", "counted"])
def test_the_work_of_a_cycle_is_the_sum_of_the_tables_of_costs(source: str) -> None:
    """With N = 10 and M = 4: Larsen's method accumulates in the steps k + 2 to m; an HR restart is at k + 1."""
    cost = {
        (row["Table"], row["Step"], row["Work"]): float(row[source])
        for row in published.rows(rebuilt(), "tables-1-3.csv")
    }
    larsen = 7 * cost["2", "other", "propagate"] + 3 * cost["2", "m", "propagate"] + cost["2", "m", "update"]
    dual = 9 * cost["3", "other", "HR propagate"] + sum(
        cost["3", *job]
        for job in (
            ("k + 1", "HR propagate"),
            ("l", "HR update"),
            ("one LR period", "LR propagate"),
            ("one LR period", "LR update"),
        )
    )
    words = {
        "printed": r"is ([\d.]+) standard steps of work for the dual-rate filter, (\d+) % more than Larsen's ([\d.]+),",
        "counted": r"by counts ([\d.]+), (\d+) % more than ([\d.]+)\. It",
    }
    of_dual, more, of_larsen = map(float, said(words[source]))
    assert (of_dual, of_larsen) == (pytest.approx(dual, abs=0.01), pytest.approx(larsen, abs=0.01))
    assert more == pytest.approx(100 * (dual / larsen - 1), abs=0.6)


def test_least_speed_depends_on_l_minus_m_alone_as_said() -> None:
    rows = published.rows(rebuilt(), "waiting.csv")
    on = [row for row in rows if int(row["M"]) >= 2]
    speeds = {row["L − M"]: row["least speed"] for row in on}
    assert all(row["least speed"] == speeds[row["L − M"]] for row in on)
    count, first, floor, enough = said(
        r"all (\d+) such designs .*? of ([\d.]+) for one step down to ([\d.]+) from (\d+)"
    )
    assert int(count) == len(on)
    assert float(first) == float(speeds["1"])
    assert {speeds[waits] for waits in speeds if int(waits) >= int(enough)} == {f"{float(floor):.4f}"}
    assert float(speeds[str(int(enough) - 1)]) > float(floor)
    assert said(r"The (\d+) designs with M = 1 do not") == (str(len(rows) - len(on)),)
    stairs = published.rows(rebuilt(), "stairs.csv")
    (waste,) = [row for row in stairs if (row["N"], row["Method"], row["L"]) == ("100", "Dual-rate", "80")]
    assert said(r"already lands at L = (\d+)") == (waste["lands at L"],)


def test_processors_gain_and_switches_are_those_of_their_tables() -> None:
    one, early, two, both = published.rows(rebuilt(), "processors.csv")
    assert said(r"each needs ([\d.]+) instead of ([\d.]+)") == (two["least speed"], one["least speed"])
    assert said(r"lands at L = (\d+) instead of (\d+)") == (two["lands there at L"], one["lands there at L"])
    assert said(r"on one processor ([\d.]+) do, and L = (\d+)") == (early["least speed"], early["lands there at L"])
    assert [*both.values()][1:] == [*two.values()][1:]  # "Both together gain nothing"
    switches = published.rows(rebuilt(), "switches.csv")
    by_cost = {float(row["context switch"]): (float(row["Larsen"]), float(row["Dual-rate"])) for row in switches}
    low, high = map(float, said(r"least speed from ([\d.]+) to ([\d.]+), for"))
    assert (low, high) == (by_cost[0][1], by_cost[0.01][1])
    (even,) = map(float, said(r"takes more than ([\d.]+) of a standard step"))
    assert all((dual > larsen) == (cost > even) for cost, (larsen, dual) in by_cost.items())


def test_errors_by_approximate_noise_are_those_of_their_table() -> None:
    rows = published.rows(rebuilt(), "noise.csv")
    most = {heading: 100 * max(float(row[heading]) for row in rows) for heading in rows[0] if heading != "System"}
    assert said(r"to (\d+) % with Q′") == (f"{most['P wrong, Q′']:.0f}",)
    assert said(r"true standard deviation grows by ([\d.]+) % at the most") == (f"{most['σ larger, Q′']:.1f}",)
    assert said(r"to (\d+) % with Q″") == (f"{most['P wrong, Q″']:.0f}",)
    assert said(r"with Q″ by ([\d.]+) %") == (f"{most['σ larger, Q″']:.2f}",)
    assert said(r"this share from [\d.]+ % to (\d+) %") == (f"{most['share of Q in P']:.0f}",)


def test_many_cycles_bound_what_approximate_noise_is_said_to_cost() -> None:
    summed, euler = (worst()[noise] for noise in APPROXIMATIONS)
    said_P, said_estimate = said(r"P wrong by up to (\d+) %, but the .*? by ([\d.]+) % at most\.")
    assert (said_P, said_estimate) == (f"{100 * summed.covariance:.0f}", f"{100 * summed.estimate:.2f}")
    text = published.text(rebuilt())
    assert f"P is wrong by {said_P} % at the most ({100 * euler.covariance:.0f} % with Q″)" in text
    assert f"the deviation {said_estimate} % larger ({100 * euler.estimate:.2f} %)" in text


def test_p_is_the_more_wrong_the_larger_the_share_of_noise_in_each_system() -> None:
    rows = published.rows(rebuilt(), "noise.csv")
    for name, system in tried().items():
        of = [row for row in rows if row["System"] == name]
        for heading in ("share of Q in P", "P wrong, Q′", "P wrong, Q″"):
            values = [float(row[heading]) for row in of]
            assert values == sorted(values)
        assert f"{system.cycles} {'cycles (turning)' if name == 'turning' else '(inertial)'}" in published.text(
            rebuilt()
        )


def test_every_equation_is_listed_with_its_line() -> None:
    text = rebuilt()["index.md"].decode()
    items = re.findall(r"^- \*\*\((\d+)\)\*\* .+<br>(.+)$", text, re.MULTILINE)
    assert [int(number) for number, _ in items] == list(range(5, 25))
    assert [number for number, run in items if not run.startswith("`")] == ["7", "22"]


def test_it_names_the_machine_and_both_findings() -> None:
    text = rebuilt()["index.md"].decode()
    assert str(committed_costs().provenance["machine"]) in text
    assert "12 of the 15 cells" in text
    assert "already lands at L = 29" in text
