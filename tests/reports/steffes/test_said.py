"""What the report says of each claim of the paper is what its tables say."""

from __future__ import annotations

import re

import pytest

from reports.pages.machine import residue
from reports.pages.numbers import power
from studies.steffes.noise import APPROXIMATIONS, tried
from studies.steffes.noise_long import worst
from tests.reports import published
from tests.reports.steffes.page import rebuilt, said

METHODS = ("Larsen", "Recalculate")


def test_states_agree_outside_m_to_l_minus_1_as_said() -> None:
    rows = published.rows(rebuilt(), "agreement.csv")
    apart = {
        waits: [float(row[f"{method}, state"]) for row in rows if row["m to l − 1"] == waits for method in METHODS]
        for waits in ("yes", "no")
    }
    assert f"states differ by {written(max(apart['no']))} of the largest" in published.text(rebuilt())
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
        assert row["over standard"] == row["n³"]
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
    said_P, said_estimate = said(r"P wrong by up to (\d+) %, but the .*? by ([\d.]+) % at most ")
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
