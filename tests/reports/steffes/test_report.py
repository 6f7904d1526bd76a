"""The committed report is what the code makes of the cost table committed with it, byte for byte."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from reports.steffes.report import build
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import read_costs
from tests.reports import published


@cache
def committed_costs() -> CostTable:
    return read_costs(published.FOLDER / "steffes2014" / "measured.toml")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(committed_costs())


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
    other = build(replace(table, costs=slower, provenance={**table.provenance, "machine": "another"}))
    published.differs_only_where_marked(rebuilt(), other, ["costs.svg", "table4.svg"])


def test_it_names_the_machine_and_both_findings() -> None:
    text = rebuilt()["index.md"].decode()
    assert str(committed_costs().provenance["machine"]) in text
    assert "12 of the 15 cells" in text
    assert "already lands at L = 29" in text
