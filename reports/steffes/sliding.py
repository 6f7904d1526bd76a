"""The schedules of Fig. 3 for every L that can be asked for, and at speeds at which the correction lands elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from reports.charts.panels import Panel, method_panel
from reports.pages.pictures import Frame
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.timing import Timing

SPEEDS = tuple(Fraction(percent, 100) for percent in range(65, 125, 5))
"""From one at which the high-rate loop overruns to one at which the correction lands as soon as it may."""


def frames_over_l(table: CostTable, N: int, M: int) -> list[Frame]:
    """Larsen's method, and the dual-rate filter for each L from M + 1 to N, each at its own least speed."""
    larsen = _at_least_speed(table, "larsen", Timing(N, M, N))
    stairs = staircase(select(table, "dual-rate"), N, M)
    return [
        Frame(f"L = {stair.L}: speed {float(stair.speed):.3g}", [larsen, _dual_rate(table, N, M, stair.L, stair.speed)])
        for stair in stairs
    ]


def frames_over_speed(table: CostTable, N: int, M: int, speeds: Sequence[Fraction] = SPEEDS) -> list[Frame]:
    """The dual-rate filter with the longest wait, L = N, at each of these speeds, and where its correction lands."""
    costs = select(table, "dual-rate")
    landed = [(speed, achieved_l(costs, Timing(N, M, N), speed)) for speed in speeds]
    return [Frame(_label(speed, at), [_dual_rate(table, N, M, N, speed)]) for speed, at in landed]


def _label(speed: Fraction, landed: int | None) -> str:
    where = "too slow, nothing lands" if landed is None else f"lands at L = {landed}"
    return f"speed {float(speed):.2f}: {where}"


def _dual_rate(table: CostTable, N: int, M: int, L: int, speed: Fraction) -> Panel:
    return method_panel(table, "dual-rate", Timing(N, M, L), speed)


def _at_least_speed(table: CostTable, method: str, timing: Timing) -> Panel:
    return method_panel(table, method, timing, least_speed(select(table, method), timing).speed)
