"""One cycle of the patent's filter as one loop does it, and as two rates do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from reports.charts.panels import Panel, busy, method_panel
from reports.pages.pictures import Frame
from sched_sim.costs.table import CostTable
from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.pieces import StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import bars

ONE_LOOP = {"P": "SU", "U": "CG"}
RATES_HZ = tuple(map(Fraction, (1, 2, 4, 5, 6, 8, 10, 15, 20, 24, 25)))
"""From where one loop is fast enough to where two rates are too slow, at the patent's n on its processor."""


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
        notes=[f"HR period {float(1000 / hr_hz):.4g} ms", busy(schedule.utilization)],
        marks=cycle_marks(Timing(n, 0, n), cycles, {}, arrives=False),
    )


def frames_over_rate(table: CostTable, n: int, rates_hz: Sequence[Fraction] = RATES_HZ) -> list[Frame]:
    """One loop above two rates, for each of these measurements a second."""
    frames = []
    for hz in rates_hz:
        loop, rates = one_loop_panel(table, n, hz), two_rates_panel(table, n, hz)
        frames.append(Frame(_label(hz, loop.schedule.misses, rates.schedule.misses), [loop, rates]))
    return frames


def _label(hz: Fraction, loop: int, rates: int) -> str:
    if not loop and not rates:
        return f"{float(hz):g} Hz: neither misses a deadline"
    return f"{float(hz):g} Hz: one loop misses {loop}, two rates {rates or 'none'}"


def schedule_rows(panels: Sequence[Panel], hr_hz: Fraction) -> list[list[Any]]:
    """The pieces of work that are drawn, in ms; the first row is the heading."""
    rows: list[list[Any]] = [["schedule", "row", "work", "step", "start_ms", "end_ms", "late"]]
    for panel in panels:
        schedule = panel.schedule
        for bar in bars(schedule):
            start, end = (f"{float(1000 * Fraction(at, schedule.period) / hr_hz):.6g}" for at in (bar.start, bar.end))
            late = "no" if bar.overdue is None else "yes"
            rows.append([panel.title, bar.row.name, bar.style, bar.step, start, end, late])
    return rows
