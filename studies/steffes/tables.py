"""Steffes (2014), Tables 1-4: what is printed, and the same from any cost table.

Every printed figure stands for an interval of +-0.005. A cell of Table 4 is *reached* if some values within the
rounding of Tables 1-3 give, through the analysis, a value that rounds to the printed one.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from functools import cache
from importlib.resources import files
from itertools import product
from math import sqrt
from typing import Any, NamedTuple

from sched_sim.costs.table import Cost, CostTable
from sched_sim.design.least_speed import LeastSpeed, least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing

METHODS = ("recalculate", "larsen", "dual-rate")
HALF_UNIT = Fraction(5, 1000)
"""Half a unit of the last printed digit."""


class Entry(NamedTuple):
    """One printed figure of Tables 1-3 that is not zero.

    costs: by method and job kind, how often that cost is in it.
    """

    table: int
    step: str
    column: str
    printed: Fraction
    costs: Mapping[str, Mapping[str, int]]

    def value(self, table: CostTable) -> Fraction:
        """The same figure from another table of normalised costs."""
        return sum(
            (
                times * table.entry(method, kind).minimum
                for method, kinds in self.costs.items()
                for kind, times in kinds.items()
            ),
            start=Fraction(0),
        )


class Cell(NamedTuple):
    """One cell of Table 4. computed: by the analysis from the paper's costs; lowest, highest: the same from all values
    within the rounding of Tables 1-3."""

    timing: Timing
    method: str
    printed: Fraction
    computed: LeastSpeed
    lowest: Fraction
    highest: Fraction

    @property
    def reached(self) -> bool:
        return self.lowest <= self.printed + HALF_UNIT and self.printed - HALF_UNIT <= self.highest


@cache
def _published() -> dict[str, Any]:
    text = files("studies").joinpath("data/steffes2014.toml").read_text(encoding="utf-8")
    return tomllib.loads(text, parse_float=Decimal)


def entries() -> list[Entry]:
    """The printed figures of Tables 1-3, in their order, without the zeros."""
    return [Entry(**{**entry, "printed": Fraction(entry["printed"])}) for entry in _published()["entry"]]


def deviation(table: CostTable) -> float:
    """Root-mean-square deviation of a table's normalised costs from the printed figures of Tables 1-3."""
    normalised = table.normalised()
    squares = [float(entry.value(normalised) - entry.printed) ** 2 for entry in entries()]
    return sqrt(sum(squares) / len(squares))


def least_speeds(table: CostTable, timing: Timing) -> dict[str, LeastSpeed]:
    """A row of Table 4 from any cost table, normalised."""
    normalised = table.normalised()
    return {method: least_speed(select(normalised, method, Options()), timing) for method in METHODS}


def cases() -> list[Timing]:
    """The rows of Table 4."""
    return [Timing(case["N"], case["M"], case["L"]) for case in _published()["case"]]


def cells(table: CostTable) -> list[Cell]:
    """Table 4, cell by cell. table: the paper's costs."""
    corners = _corners(table)
    table_cells = []
    for case in _published()["case"]:
        timing = Timing(case["N"], case["M"], case["L"])
        for method in METHODS:
            computed = least_speed(select(table, method, Options()), timing)
            speeds = [least_speed(select(corner, method, Options()), timing).speed for corner in corners]
            table_cells.append(Cell(timing, method, Fraction(case[method]), computed, min(speeds), max(speeds)))
    return table_cells


def _corners(table: CostTable) -> Sequence[CostTable]:
    """The paper's costs with all printed figures shifted by half a unit, propagate in one way and the rest in another.

    Least speeds grow with every cost, so their extremes lie here; but the fixed part of recalculate is the printed
    2.36 less four replays, so it shrinks when propagate grows.
    """
    return [_shifted(table, *shifts) for shifts in product((-HALF_UNIT, HALF_UNIT), repeat=2)]


def _shifted(table: CostTable, propagate: Fraction, others: Fraction) -> CostTable:
    def shift(method: str, kind: str) -> Fraction:
        if kind in ("propagate", "replay"):
            return propagate
        return others - 4 * propagate if (method, kind) == ("recalculate", "update") else others

    costs = {
        method: {kind: Cost.of(cost.minimum + shift(method, kind)) for kind, cost in kinds.items()}
        for method, kinds in table.costs.items()
    }
    return CostTable(table.name, table.unit, costs)
