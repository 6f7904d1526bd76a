"""The README's table of findings is what the analysis gives; what it shows of commands is run in test_examples."""

from __future__ import annotations

import re

from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from studies.steffes.tables import cells, least_speeds
from tests.docs.test_examples import ROOT


def test_the_table_of_least_speeds_is_what_the_analysis_gives() -> None:
    """Each row of "What it finds": printed, from the paper's costs, from counted operations."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (.*) \|$", readme.partition("## What it finds")[2].partition("Larsen's method")[0], re.M)
    paper, counted = load_costs("steffes2014"), load_costs("counted-9-3-3")
    cell_of = {(cell.timing, cell.method): cell for cell in cells(paper)}
    timing = None
    checked = 0
    for row in rows[2:]:
        *design, name, printed, analysed, by_counts = (part.strip(" *") for part in row.split("|"))
        timing = Timing(*map(int, design)) if design[0] else timing
        assert timing is not None
        method = {"Larsen": "larsen"}.get(name, name)
        cell = cell_of[timing, method]
        assert float(printed) == float(cell.printed)
        assert analysed in (f"{float(cell.computed.speed):.2f}", f"{float(cell.computed.speed):.3f}")
        assert by_counts == f"{float(least_speeds(counted, timing)[method].speed):.2f}"
        checked += 1
    assert checked == 7


def test_it_is_a_front_door() -> None:
    """Under 150 lines: what is longer has a page of its own."""
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) < 150
