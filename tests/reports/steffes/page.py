"""The report as it is made of what is stored with it, and what it says."""

from __future__ import annotations

import re
from functools import cache

from reports.steffes.report import build
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import read_costs
from studies.machines.store import kept
from tests.reports import published


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


def said(pattern: str) -> tuple[str, ...]:
    """What stands in the text in place of the groups; it must stand there once or always the same."""
    (found,) = set(re.findall(pattern, published.text(rebuilt())))
    return (found,) if isinstance(found, str) else found


def ends(cell: str) -> tuple[float, float]:
    """Of a range, or of one number."""
    numbers = [float(number) for number in cell.split(" to ")]
    return numbers[0], numbers[-1]


def of_table_4() -> list[dict[str, str]]:
    return published.rows(rebuilt(), "table-4.csv")
