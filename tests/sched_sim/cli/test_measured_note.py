"""How far measured costs reach stands in a line below a table."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from sched_sim.cli.measured_note import range_note
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task

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
