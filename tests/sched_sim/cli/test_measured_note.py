"""How far measured costs reach, and that the machine was busy, stands in a line below a table and in every row."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from pyarrow import parquet

from sched_sim.cli.measured_note import range_note
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs, write_costs
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.tasks import Task
from tests.command_line import Run

PAPER = load_costs("steffes2014")
DESIGNS = {"larsen": Timing(10, 4, 8), "dual-rate": Timing(10, 4, 8)}


def spread(table: CostTable, unit: str = "standard step", scale: Fraction = Fraction(1)) -> CostTable:
    """Costs whose p95 is a tenth more than their minimum."""
    costs = {
        method: {
            kind: Cost(scale * cost.minimum, scale * cost.minimum, scale * cost.minimum * Fraction(11, 10))
            for kind, cost in kinds.items()
        }
        for method, kinds in table.costs.items()
    }
    return replace(table, unit=unit, costs=costs)


def test_the_least_speed_by_either_end() -> None:
    said = (
        "least speed from minimum to p95 costs: larsen 1.47 to 1.62, dual-rate 0.77 to 0.847; another machine may lie"
    )
    assert range_note(spread(PAPER), DESIGNS, Options()).startswith(said)


@pytest.mark.parametrize(
    ("unit", "scale"), [("second", Fraction(1, 10**6)), ("ms", Fraction(1, 1000)), ("us", Fraction(1))]
)
def test_times_are_in_microseconds(unit: str, scale: Fraction) -> None:
    note = range_note(spread(PAPER, unit, scale), DESIGNS, Options())
    assert "p95 costs, us an HR period: larsen 1.47 to 1.62, dual-rate 0.77 to 0.847" in note


def test_nothing_where_costs_are_single_numbers_or_it_takes_a_simulation() -> None:
    assert range_note(PAPER, DESIGNS, Options()) == ""
    assert range_note(spread(PAPER), {}, Options()) == ""
    assert range_note(spread(PAPER), DESIGNS, Options(context_switch=Fraction(1, 100))) == ""
    assert (
        range_note(spread(PAPER), DESIGNS, Options(), [Task("control", Fraction(1), Fraction(1, 10), priority=1)]) == ""
    )


IDLE: Mapping[str, Any] = {"backend": "compiled", "protocol": {"rounds": 61}}
BUSY: Mapping[str, Any] = {**IDLE, "busy": "the timing had 63 % of its processor"}
OF_MACHINE = [(BUSY, True), (IDLE, False), ({}, None)]


def timed(folder: Path, about: Mapping[str, Any]) -> None:
    write_costs(replace(spread(PAPER, "us"), name="mine", provenance=about), folder / "mine.toml")


def rows_in(out: str) -> list[dict[str, Any]]:
    """Of JSON, wherever they are in it."""
    document = json.loads(out)
    if isinstance(document, list):
        return document
    return [*document["methods"], *document["best"]] if "best" in document else [document]


@pytest.mark.parametrize(
    "line",
    [
        "minimum -N 10 -M 4 -L 8 --costs mine.toml",
        "minimum -N 10 -M 4 -L 8 --costs mine.toml --hr-hz 400",
        "simulate -N 10 -M 4 --costs mine.toml",
        "sweep -N 10 -M 4 --costs mine.toml --results s.sqlite",
    ],
)
@pytest.mark.parametrize(("about", "busy"), OF_MACHINE)
def test_every_row_says_whether_the_machine_was_busy(
    sched_sim: Run, tmp_path: Path, line: str, about: Mapping[str, Any], busy: bool | None
) -> None:
    timed(tmp_path, about)
    rows = rows_in(sched_sim(f"{line} --format json").out)
    assert [row["measured_on_busy_machine"] for row in rows] == [busy] * len(rows)
    (tmp_path / "s.sqlite").unlink(missing_ok=True)
    of_csv = list(csv.DictReader(io.StringIO(sched_sim(f"{line} --format csv").out)))
    assert {row["measured_on_busy_machine"] for row in of_csv} == {"" if busy is None else str(busy)}
    assert "measured_on_busy_machine" not in sched_sim(line).out


@pytest.mark.parametrize(("about", "busy"), OF_MACHINE)
def test_exported_rows_say_it_too(sched_sim: Run, tmp_path: Path, about: Mapping[str, Any], busy: bool | None) -> None:
    timed(tmp_path, about)
    sched_sim("sweep -N 10 -M 4 --costs mine.toml --results s.sqlite --export s.csv --export s.parquet")
    with (tmp_path / "s.csv").open(newline="") as file:
        said = {row["measured_on_busy_machine"] for row in csv.DictReader(file)}
    assert said == {{True: "true", False: "false", None: ""}[busy]}
    found = parquet.read_table(tmp_path / "s.parquet")["measured_on_busy_machine"]
    assert str(found.type) == "bool"
    assert set(found.to_pylist()) == {busy}


def test_what_is_counted_was_measured_on_no_machine_whatever_else_the_table_was(sched_sim: Run) -> None:
    counts = load_costs("counted-9-3-3")
    both = replace(counts, provenance={**counts.provenance, **BUSY})
    assert both.measured_on_busy_machine is True
    assert on_part(both, load_part("leon3")).measured_on_busy_machine is None
    out = sched_sim("processors -N 10 -M 4 --hr-hz 400 --processor leon3 --format json").out
    (row,) = json.loads(out)
    assert row["measured_on_busy_machine"] is row["min_speed_least"] is row["min_speed_most"] is None


@pytest.mark.parametrize(("rate", "second"), [("", 1.0), ("--hr-hz 400", 1e-6)])
@pytest.mark.parametrize("statistic", ["minimum", "p95"])
def test_a_row_has_the_range_that_a_person_sees(
    sched_sim: Run, tmp_path: Path, rate: str, second: float, statistic: str
) -> None:
    timed(tmp_path, IDLE)
    line = f"minimum -N 10 -M 4 -L 8 --costs mine.toml --method dual-rate {rate} --statistic {statistic} --format json"
    (row,) = json.loads(sched_sim(line).out)
    assert row["min_speed_least"] == pytest.approx(0.77 * second)
    assert row["min_speed_most"] == pytest.approx(0.847 * second)
    assert row["min_speed"] == row["min_speed_least" if statistic == "minimum" else "min_speed_most"]


@pytest.mark.parametrize("line", ["--costs steffes2014", "--costs mine.toml --context-switch 0.01"])
def test_a_row_without_a_range_has_the_columns_all_the_same(sched_sim: Run, tmp_path: Path, line: str) -> None:
    timed(tmp_path, IDLE)
    (row,) = json.loads(sched_sim(f"minimum -N 10 -M 4 {line} --method larsen --format json").out)
    assert row["min_speed_least"] is row["min_speed_most"] is None


@pytest.mark.parametrize(
    "line",
    [
        "minimum -N 10 -M 4",
        "minimum -N 10 -M 4 --processor cortex-m7",
        "simulate -N 10 -M 4",
        "gantt -N 10 -M 4",
        "processors -N 10 -M 4 --hr-hz 10",
        "sweep -N 10 -M 4",
    ],
)
def test_a_figure_that_is_none_of_its_own_is_said_to_change_nothing(sched_sim: Run, line: str) -> None:
    said = "Note: --statistic p95 changes nothing: each cost is one figure, counted or stated, not measured\n"
    assert said in sched_sim(f"{line} --statistic p95").err
    assert "--statistic" not in sched_sim(line).err


def test_of_measured_costs_it_changes_something(sched_sim: Run, tmp_path: Path) -> None:
    write_costs(spread(PAPER), tmp_path / "c.toml")
    for line in ("minimum -N 10 -M 4 --costs c.toml", "sweep -N 10 -M 4 --costs c.toml"):
        assert "changes nothing" not in sched_sim(f"{line} --statistic p95").err
        assert "changes nothing" in sched_sim(f"{line} --statistic median").err
