"""Tables as the page of the report on the multirate gain shows them: they can be read on paper and on a phone."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from reports.multirate import shown
from reports.multirate.costs import patents_form
from reports.multirate.tables import NO_SQRT, limit_by_form
from reports.pages.markdown import markdown_table
from sched_sim.processors.part_file import load_part

PROCESSORS: list[list[Any]] = [
    ["Processor", "MHz", "precision", "Filter", "n", "runs", "needs, MHz", "load, %", "slack, %", "highest, Hz"],
    ["cortex-m7-single", "216", "single", "conventional", 1, "yes", "3", "0.90", "99.10", "8,860"],
    ["cortex-m7-single", "216", "single", "conventional", 5, "yes", "1", "0.27", "99.73", "37,500"],
    ["cortex-m7-single", "216", "single", "square-root", 5, "yes", "1", "0.25", "99.75", "47,000"],
    ["rad750", "200", "double", "conventional", 1, "yes", "3", "0.90", "99.10", "8,140"],
    ["rad750", "200", "double", "conventional", 5, "yes", "1", "0.29", "99.71", "34,400"],
    ["rad750", "200", "double", "square-root", 5, NO_SQRT, "-", "-", "-", "-"],
]


def test_all_rates_of_processors_are_aligned_as_numbers_and_have_their_unit() -> None:
    rows = shown.processors(PROCESSORS)
    assert rows[0] == ["Processor", "MHz", "precision", "load, %", "n = 1, Hz", "n = 5, Hz", "square-root, Hz"]
    assert rows[2] == ["rad750", "200", "double", "0.29", "8,140", "34,400", "-"]
    assert markdown_table(rows).splitlines()[1] == "| --- | ---: | --- | ---: | ---: | ---: | ---: |"


def test_a_system_a_formula_and_a_time_stay_on_one_line() -> None:
    terms = [["Cycle", "Term"], ["state update", "y - H x"], ["covariance and gain", "(I - K H) P"]]
    assert not any(" " in row[1] for row in shown.terms(terms))
    heading, row = shown.systems([["Steps with a gain each"], ["random walk 0.0001"]])
    assert " " in heading[0]
    assert " " not in row[0]
    assert shown.cases([["Case"], ["trucks, tanks: a cycle in 4 s"]])[1][0].endswith("4\N{NO-BREAK SPACE}s")
    assert shown.cases([["Case", "≥ U-D"]]) == [["Case", "≥\N{NO-BREAK SPACE}U-D"]]


def test_loads_without_their_square_roots_are_told_as_lower_bounds() -> None:
    form = patents_form()
    counts = form.table.operations[form.method]
    with_roots = {**counts, "covariance_gain": {**counts["covariance_gain"], "sqrt": 4}}
    asking = form._replace(table=replace(form.table, operations={form.method: with_roots}))
    names = [row[0] for row in limit_by_form([form, asking], load_part("patent"))[1:]]
    assert names == [form.name, f"≥ {form.name}"]
