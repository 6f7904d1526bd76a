"""When the dual-rate filter needs less processing power than other methods (Steffes 2014, Secs III.C and V)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.methods import select
from sched_sim.design.pieces import DualRateCosts, LarsenCosts
from sched_sim.design.timing import Timing
from studies.accuracy.scale import EXACT

NAMED = ("recalculate", "larsen", "augmentation")
"""Exact methods that Sec. I of the paper names."""
ADDED = tuple(Fraction(half, 2) for half in (0, 1, 2, 4, 8))
"""Standard steps: what converts a measurement before the update."""
RATES = (10, 100, 1000)


class Needed(NamedTuple):
    """speed: the least, in the table's units; lands: the L at which its corrections land then."""

    method: str
    speed: Fraction
    lands: int


class Heavier(NamedTuple):
    """Least speeds where each update takes `added` more; dual_rate: by L."""

    added: Fraction
    larsen: Fraction
    dual_rate: Mapping[int, Fraction]


def needed(table: CostTable, timing: Timing) -> list[Needed]:
    """Of all methods with the same estimate once they have landed, the cheapest first."""
    found = []
    for method in EXACT:
        costs = select(table, method)
        speed = least_speed(costs, timing).speed
        lands = achieved_l(costs, timing, speed)
        assert lands is not None
        found.append(Needed(method, speed, lands))
    return sorted(found, key=lambda one: one.speed)


def heavier(table: CostTable, timing: Timing, lands: Sequence[int]) -> list[Heavier]:
    """lands: each L asked of the dual-rate filter."""
    larsen, dual_rate = select(table, "larsen"), select(table, "dual-rate")
    assert isinstance(larsen, LarsenCosts)
    assert isinstance(dual_rate, DualRateCosts)
    return [
        Heavier(
            added,
            least_speed(replace(larsen, update=larsen.update + added), timing).speed,
            {
                L: least_speed(replace(dual_rate, lr_update=dual_rate.lr_update + added), replace(timing, L=L)).speed
                for L in lands
            },
        )
        for added in ADDED
    ]


def by_rate(table: CostTable, timing: Timing) -> dict[int, tuple[Fraction, Fraction]]:
    """By N, with M and L as they are: the least speeds of Larsen's method and of the dual-rate filter."""
    larsen, dual_rate = (select(table, method) for method in ("larsen", "dual-rate"))
    return {
        N: (
            least_speed(larsen, replace(timing, N=N)).speed,
            least_speed(dual_rate, replace(timing, N=N)).speed,
        )
        for N in RATES
    }
