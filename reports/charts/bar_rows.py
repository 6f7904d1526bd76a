"""What a Gantt chart shows, as a table."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from reports.charts.panels import Panel
from reports.pages.stored import Rows
from sched_sim.schedule.intervals import bars


def bar_rows(panels: Sequence[Panel]) -> Rows:
    """What runs when, in HR periods from the start of the first step shown; what a panel shows not is left out."""
    rows: Rows = [["Method", "work", "of step", "from", "to"]]
    for panel in panels:
        period = panel.schedule.period
        for bar in bars(panel.schedule):
            if panel.first * period <= bar.start and bar.end <= panel.end * period:
                when = [f"{float(Fraction(instant, period) - panel.first):.4f}" for instant in (bar.start, bar.end)]
                rows.append([panel.title, bar.style, bar.step - panel.first, *when])
    return rows
