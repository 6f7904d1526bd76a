"""One cycle of the patent's filter as one loop does it, and as two rates do."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from reports.charts.panels import Panel, method_panel
from sched_sim.costs.table import CostTable
from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.pieces import StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing

ONE_LOOP = {"P": "SU", "U": "CG"}


def two_rates_panel(table: CostTable, n: int, hr_hz: Fraction, cycles: int = 1) -> Panel:
    """Covariance and gain in what the state updates leave of n steps.

    table: costs in seconds of the method "multirate".
    """
    return method_panel(table, "multirate", Timing(n, 0, n), 1 / hr_hz, cycles, title="Two rates")


def one_loop_panel(table: CostTable, n: int, hr_hz: Fraction, cycles: int = 1) -> Panel:
    """Covariance and gain as a part of every n-th state update, so that the next ones wait for it."""
    state, covariance = (table.entry("multirate", kind).minimum for kind in ("state_update", "covariance_gain"))
    schedule = simulate(StandardCosts(state, covariance), Timing(n, 0, n), 1 / hr_hz, cycles, keep_slices=True)
    renamed = tuple(
        piece._replace(parts=tuple((ONE_LOOP[label], work) for label, work in piece.parts)) for piece in schedule.slices
    )
    return Panel(
        title="One loop",
        schedule=replace(schedule, slices=renamed),
        notes=[f"HR period {float(1000 / hr_hz):g} ms", f"{100 * float(schedule.utilization):.0f} % busy"],
        marks=cycle_marks(Timing(n, 0, n), cycles, {}, arrives=False),
    )
