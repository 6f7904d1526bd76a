"""What the report on boards says is true, by its own tables."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from itertools import permutations

import pytest

from reports.charts.panels import METHOD_NAMES
from reports.embedded import tables
from reports.embedded.board_tables import memory_bytes
from reports.embedded.compared import compared
from reports.embedded.results import Results
from reports.embedded.said import ASSUMED, WITHIN, about_boards, about_memory, about_speeds, provenance
from reports.embedded.tables import per_operation
from reports.embedded.words import CORES, HERE, IN_HARDWARE, PAPERS, factor, microseconds, on_page, percent_up, signed
from reports.pages.measurements import counted_on
from sched_sim.costs.methods import KINDS
from sched_sim.costs.table import Cost
from sched_sim.processors.part_file import load_part
from studies.embedded.known_loop import INSTRUCTIONS
from studies.embedded.sources import FIRST, FORMS, METHODS
from studies.measurement.published_timings import published_timings
from tests.reports import published
from tests.reports.embedded.page import number, rebuilt, rows, stored, text


def test_emulated_least_speeds_are_the_counted_ones_within_two_percent() -> None:
    found = compared(stored())
    papers = [one for one in found if one.form == "textbook" and one.source in CORES and one.method in PAPERS]
    assert len(papers) == 6 * 4 * 3
    assert max(abs(one.deviation) for one in papers) <= WITHIN
    within = f"within {about_speeds(stored(), found)['papers']} % of the counted ones (textbook)"
    assert within in text()
    emulated = max(abs(one.deviation) for one in found if one.source in CORES)
    (said,) = re.findall(r"of all filters here within ([\d.]+) %", text())
    assert emulated <= Fraction(said) / 100 < emulated + Fraction(1, 1000)


def test_the_answer_is_short_and_what_it_says_of_order_holds_for_all_pairs_on_each_core() -> None:
    answer = text().partition("**Answer.** ")[2].partition(" ![")[0]
    assert len(re.findall(r"[^\W\d_]{2,}", answer)) <= 50
    (apart,) = re.findall(r"over (\d+) % apart", answer)
    speeds = rows("all-speeds.csv")
    by_design: dict[tuple[str, ...], list[dict[str, str]]] = {}
    for row in speeds:
        by_design.setdefault((row["update"], row["N"], row["M"], row["L"]), []).append(row)
    cores = list(speeds[0])[6:10]
    pairs = [pair for of in by_design.values() for pair in permutations(of, 2)]
    further = [
        (slow, fast) for slow, fast in pairs if float(slow["counted"]) > (1 + int(apart) / 100) * float(fast["counted"])
    ]
    assert len(further) > 150
    assert all(float(slow[core]) > float(fast[core]) for slow, fast in further for core in cores)
    assert any(
        float(slow[core]) < float(fast[core])
        for slow, fast in pairs
        for core in cores
        if float(slow["counted"]) > (1 + (int(apart) - 1) / 100) * float(fast["counted"])
    ), "nearer ones may not"


def test_within_is_never_less_than_it_is() -> None:
    assert percent_up(Fraction(10039, 100_000)) == "10.1"
    assert [factor([Fraction(of)]) for of in ("2.53", "17.34", "1.31", "1.5", "0.5")] == [
        "2.6",
        "18",
        "1.4",
        "1.5",
        "2",
    ]
    for row in rows("groups.csv"):
        ends = [float(end) for end in row["published over predicted"].split(" to ")]
        assert max(max(end, 1 / end) for end in ends) <= 1.01 * float(row["within a factor of"])


def test_the_figure_of_the_answer_is_in_its_file() -> None:
    found = {row["source"] or row["timed here †"]: row for row in rows("answer.csv")}
    groups = {row["Code"]: row["published over predicted"] for row in rows("groups.csv")}
    plain = found["plain loops"]
    assert f"{float(plain['least']):.2f} to {float(plain['most']):.2f}" == groups["plain loops, as they are counted"]
    speeds = [float(row[core]) / float(row["counted"]) for row in rows("all-speeds.csv") for core in list(row)[6:10]]
    emulated = found["four emulated cores"]
    assert [float(emulated[end]) for end in ("least", "most")] == pytest.approx([min(speeds), max(speeds)], abs=2e-4)


def test_rows_of_jobs_say_which_method_they_are_of() -> None:
    page = rebuilt()["index.md"].decode()
    assert "| Larsen: update |" in page
    assert not re.search(r"^\|  \|", page, re.MULTILINE), "no first cell is empty"


def test_methods_of_the_table_of_folders_are_in_the_order_of_the_figure() -> None:
    assert [row["Method"] for row in rows("folders.csv")] == [
        name for name in METHOD_NAMES.values() if name in {row["Method"] for row in rows("folders.csv")}
    ]


def test_tables_of_the_page_have_at_most_nine_columns() -> None:
    """More are not printed on A4 without loss."""
    widths = [line.count("|") - 1 for line in rebuilt()["index.md"].decode().splitlines() if line.startswith("| ---")]
    assert len(widths) > 10
    assert max(widths) <= 9


def test_speeds_on_the_page_are_those_of_the_file() -> None:
    for form in FORMS:
        found = tables.speeds(compared(stored()), form)
        emulated, timed = tables.without(found, HERE), tables.without(found, CORES)
        assert [*emulated[0], *timed[0][2:]] == [*found[0][:6], found[0][-1], *found[0][6:-1]]
        for table in (emulated, timed):
            assert [row[:2] for row in table] == [row[:2] for row in found]
        assert [list(row.values()) for row in published.rows(rebuilt(), f"speeds-{form}.csv")] == [
            [cell.replace("\N{MINUS SIGN}", "-") for cell in row] for row in found[1:]
        ]


def test_least_speeds_of_the_first_design() -> None:
    """To the digits of the prototype: 2.96, 1.53 to 1.52, 0.83."""
    by_method = {row["Method"]: row for row in rows("speeds-textbook.csv")}
    for method, counted, emulated in (("Recalculate", 2.93, 2.96), ("Larsen", 1.53, 1.52), ("Dual-rate", 0.83, 0.83)):
        assert float(by_method[method]["counted"]) == pytest.approx(counted, abs=0.006)
        assert float(by_method[method]["M4F, float"]) == pytest.approx(emulated, abs=0.006)


def test_the_table_of_deviations_is_of_all_speeds() -> None:
    speeds = rows("all-speeds.csv")
    assert len(speeds) == 2 * 6 * 7
    for row in rows("deviations.csv"):
        methods = set(PAPERS) if row["methods"] == "Steffes 2014" else set(METHODS[1:]) - set(PAPERS)
        of = [one for one in speeds if one["update"] == row["Update"] and one["method"] in methods]
        for heading in list(row)[2:]:
            over = [100 * (float(one[heading.removesuffix(", %")]) / float(one["counted"]) - 1) for one in of]
            assert number(row[heading]) == pytest.approx(max(over, key=abs), abs=0.11)


def test_each_measurement_has_its_least_speeds() -> None:
    """Those of this one are those of the table of least speeds."""
    listed, speeds = rows("measurements.csv"), rows("speeds-textbook.csv")
    numba = [row for row in listed if (row["Source †"], row["Update †"]) == ("numba", "textbook")]
    assert len(numba) == len(stored().measurements("numba", "textbook"))
    counted = counted_on(stored().measurements("numba", "textbook"))
    assert f"Measured of numba in the textbook form: {counted}." in text()
    here = {row["Method"]: row["numba †"].split(" (")[0] for row in speeds}
    shown = [{method: row[f"{method} †"] for method in ("Recalculate", "Larsen", "Dual-rate")} for row in numba]
    assert {method: here[method] for method in shown[0]} in shown


def test_instructions_for_each_operation() -> None:
    for form in FORMS:
        for row in rows(f"jobs-{form}.csv"):
            operations = number(row["operations"])
            ratios = [number(row[heading]) / operations for heading in ("M4F, float", "M33, float", "M7, double")]
            ends = [float(end) for end in row["for each operation"].split(" to ")]
            assert [ends[0], ends[-1]] == pytest.approx([min(ratios), max(ratios)], abs=0.051)
            assert number(row["in software"]) == pytest.approx(number(row["M4, soft double"]) / operations, abs=0.051)
    every = [ratio for of in per_operation(stored()).values() for core in IN_HARDWARE for _, ratio in of[core]]
    assert f"An operation takes {min(every):.1f} to {max(every):.1f} instructions" in text()


def test_parts_files_take_three_and_a_half() -> None:
    assert ASSUMED == 3.5
    for name in ("cortex-m4f", "cortex-m33", "cortex-m7", "cortex-m7-single"):
        assert load_part(name).logic_per_arithmetic == 2.5


def test_jobs_that_only_options_ask_for_are_left_out() -> None:
    shown = {(row["Method"], row["job"]) for row in rows("jobs-short.csv")}
    assert ("Dual-rate", "hr_propagate") in shown
    assert ("Dual-rate", "hr_propagate_sum") not in shown
    assert {kind for method, kind in shown if method == "Standard (no delay)"} == set(KINDS["standard"])


def test_published_timings_by_how_the_code_is_written() -> None:
    by_name = {row["Code"]: row for row in rows("groups.csv")}
    assert by_name["plain loops, as they are counted"]["published over predicted"] == "0.68 to 1.25"
    assert by_name["generic matrix class"]["published over predicted"] == "2.87 to 17.3"
    assert sum(int(row["timings"]) for row in by_name.values()) == len(published_timings())
    assert "up to 15 times faster than dense code" in text()


def test_all_plain_timings_lie_in_the_range_of_their_instructions() -> None:
    plain = [row for row in rows("published.csv") if row["Source"] == "KFCore"]
    assert len(plain) == about_boards(stored())["plain_number"] == 4
    for row in plain:
        least, most = map(number, row["by instructions, µs"].split(" to "))
        assert least <= number(row["published, µs"]) <= most
    assert "Of the 4 timings of plain loops on such a core all are in that range; they are 1.21 to 2.45" in " ".join(
        text().split()
    )


def test_with_fewer_instructions_a_timing_above_the_range_is_told() -> None:
    said = about_boards(changed("boards", 3, "20000"))
    assert said["inside"] == f"3 are in that range, the others up to {100 * (393 * 180 / 53000 - 1):.0f} % above it"


def test_memory() -> None:
    memory = {(row["Method"], row["precision"]): row for row in rows("memory.csv")}
    single, double = memory["Dual-rate", "single"], memory["Dual-rate", "double"]
    assert number(double["RAM, HR"]) == 2 * number(single["RAM, HR"])
    total = sum(number(single[of]) for of in ("RAM, HR", "RAM, LR", "stack, HR", "stack, LR"))
    assert float(single["RAM and stacks, KB"]) == pytest.approx(total / 1024, abs=0.005)
    assert {row["RAM, LR"] for (name, _), row in memory.items() if name == "Larsen"} == {"-"}
    said = about_memory(stored())
    assert f"{said['upper']} KB for the dual-rate filter, the most of them, is an upper bound" in text()
    assert sum(memory_bytes(stored(), "cortex-m4f", "textbook")["dual-rate"].values()) == total + number(single["code"])


def test_a_whole_folder_takes_less_ram_than_all_arguments_of_its_jobs() -> None:
    """Of the methods whose jobs were measured one by one; the others have no such bound."""
    memory = {(row["Method"], row["precision"]): row for row in rows("memory.csv")}
    folders = [row for row in rows("folders.csv") if (row["Method"], "single") in memory]
    assert len(folders) == len(METHODS)
    for row in folders:
        of = memory[row["Method"], "single"]
        arguments = sum(number(of[task]) for task in ("RAM, HR", "RAM, LR") if of[task] != "-")
        assert number(row["RAM, single"]) < arguments


def test_the_headline_of_memory_is_of_what_is_written_as_a_whole() -> None:
    folders = rows("folders.csv")
    ram = {row["Method"]: int(row["RAM, single"]) for row in folders}
    flash = sorted(int(row["code, single"]) for row in folders)
    short = text().partition("**In short.**")[2].partition("## ")[0]
    assert f"{flash[0]:,} to {flash[-1]:,} bytes of flash" in short
    assert f"and {min(ram.values()):,} bytes of RAM or more. Of {len(ram)} methods augmentation" in short
    most = sorted(ram, key=lambda method: ram[method], reverse=True)[:3]
    assert most == ["Augmentation", "Dual-rate", "Larsen"]
    first, second, third = (ram[method] for method in most)
    assert f"{first:,} bytes, then the dual-rate filter, {second:,}, then Larsen's method, {third:,}" in short


def test_the_known_loop_is_exact_on_all_cores() -> None:
    checks = rows("checks.csv")
    assert len(checks) == len(CORES)
    for row in checks:
        assert row["the loop has"] == row["counted"] == row["again"] == str(INSTRUCTIONS)
        assert row["of which differ"] == "0"
    assert f"all {sum(int(row['jobs run twice']) for row in checks)} jobs that were run a second time" in text()


# ------------------------------------------------------------------------------------------------ what it would not say


def changed(name: str, column: int, cell: str) -> Results:
    table = [list(row) for row in stored().tables[name]]
    table[1][column] = cell
    return stored()._replace(tables={**stored().tables, name: table})


def halved(name: str, method: str, *kinds: str) -> Results:
    costs = dict(stored().costs)
    for form in FORMS:
        table = costs[name, form]
        of = {kind: cost / (2 if kind in kinds else 1) for kind, cost in table.costs[method].items()}  # type: ignore[operator]
        costs[name, form] = replace(table, costs={**table.costs, method: of})
    return stored()._replace(costs=costs)


def test_claims_that_no_longer_hold_are_not_printed() -> None:
    with pytest.raises(ValueError, match="known loop"):
        provenance(changed("checks", 1, "2003"))
    with pytest.raises(ValueError, match="a second run differs"):
        provenance(changed("checks", 4, "1"))
    faster = halved("cortex-m7", "larsen", "update")
    with pytest.raises(ValueError, match="more than 2 %"):
        about_speeds(faster, compared(faster))
    with pytest.raises(ValueError, match="as many instructions an operation"):
        about_speeds(halved("cortex-m4f", "standard", "update"), compared(stored()))
    with pytest.raises(ValueError, match="take most RAM"):
        about_memory(changed("folders", 4, "9999"))
    with pytest.raises(ValueError, match="less than the least time"):
        about_boards(changed("boards", 3, "999999"))


def test_figures_as_they_are_written() -> None:
    assert [signed(of) for of in (0.0123, -0.1, 0.0001)] == ["+1.2", "−10.0", "0.0"]
    assert microseconds(Cost(*(value / 10**6 for value in (1, 2, 3)))) == "2.00 (1.00 to 3.00)"  # type: ignore[arg-type]
    assert factor([load_part("cortex-m4f").clock_hz / 168_000_000 / 2]) == "2"
    assert on_page([["a", "b"], ["x", "15, 3"], ["x", "cortex-m4f, 168 MHz, 2026-11-29"]]) == [
        ["a", "b"],
        ["x", "15,\N{NO-BREAK SPACE}3"],
        [
            "x",
            "cortex-m4f, 168~MHz, 2026-11-29".replace("-", "\N{NON-BREAKING HYPHEN}").replace(
                "~", "\N{NO-BREAK SPACE}"
            ),
        ],
    ]
    assert on_page([["inconclusive: few"]]) == [["inconclusive:\N{NO-BREAK SPACE}few"]]
    assert on_page([["Method", "job", "c"], ["x", "y", "1"]]) == [["Job", "c"], ["x: y", "1"]]


def test_the_first_design_is_in_the_caption() -> None:
    assert f"N, M, L = {FIRST.N}, {FIRST.M}, {FIRST.L}" in text()
