"""What a notebook shows of results: tables and pictures that XML parsers take."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import pytest

from reports import gantt, method_panel
from sched_sim import CostTable, Timing, load_costs, read_scenario, run_scenario, select, simulate
from sched_sim.costs.table import Cost
from studies import run_sweep

SCENARIO = """
name = "late"
steps = 200
speed = 1
[predictor]
cost = 0.1
[[sensor]]
name = "gps"
every = 10
delay = [1, 3]
dropout = 0.1
cost = 0.5
"""


def cells(shown: Any) -> list[list[str]]:
    """The text of each row of all tables."""
    tables = ElementTree.fromstring(f"<div>{shown._repr_html_()}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in tables.iter("tr")]


def captions(shown: Any) -> list[str | None]:
    tables = ElementTree.fromstring(f"<div>{shown._repr_html_()}</div>")
    return [caption.text for caption in tables.iter("caption")]


def test_a_cost_table() -> None:
    table = load_costs("steffes2014")
    heading, first, *_ = cells(table)
    assert heading == ["method", "job", "minimum", "median", "p95"]
    assert first == ["standard", "propagate", "0.45", "0.45", "0.45"]
    assert len(cells(table)) == 1 + sum(map(len, table.costs.values()))


def test_names_are_text_and_no_markup() -> None:
    table = CostTable("<b>\x1b", "ms", {"larsen": {"<i>": Cost.of(1)}})  # type: ignore[arg-type]
    assert captions(table) == ["<b>\\x1b, in ms"]
    assert cells(table)[1][1] == "<i>"


def test_a_schedule() -> None:
    """9 x 0.63 + 0.04 + 0.03 + 0.41 + 0.56 of 10 x 0.77."""
    schedule = simulate(select(load_costs("steffes2014"), "dual-rate"), Timing(10, 4, 8), 0.77, 3)
    (caption,) = captions(schedule)
    assert caption == "30 HR periods, busy 87.1%; corrections landed: 3 at L = 8; responses in HR periods"
    found = {row[0]: row[1:] for row in cells(schedule)}
    assert found["lr_update"][:2] == ["3", "3"]
    assert float(found["hr"][2]) == pytest.approx(0.66 / 0.77, rel=1e-5)


def test_the_outcome_of_a_scenario(tmp_path: Any) -> None:
    path = tmp_path / "late.toml"
    path.write_text(SCENARIO)
    outcome = run_scenario(read_scenario(path))
    found = {row[0]: row[1:] for row in cells(outcome)}
    figures = outcome.sensors["gps"]
    assert found["predict"][:2] == ["200", "200"]
    assert found["gps"][:2] == [str(figures.taken), str(figures.dropped)]
    assert float(found["gps"][5]) == min(figures.achieved)


def test_rows_of_a_sweep() -> None:
    rows = run_sweep(N="4:6", method="dual-rate")
    assert len(cells(rows)) == 1 + 20
    assert captions(rows) == [f"the first 20 of {len(rows)} designs"]
    assert cells(run_sweep(N=3, M=1, L=3, method="dual-rate"))[1][:4] == ["0", "steffes2014", "", "dual-rate"]


def test_a_gantt_chart_is_svg() -> None:
    chart = gantt([method_panel(load_costs("steffes2014"), "dual-rate", Timing(10, 4, 8), 0.78)])
    assert ElementTree.fromstring(chart._repr_svg_()).tag.endswith("svg")  # type: ignore[attr-defined]
