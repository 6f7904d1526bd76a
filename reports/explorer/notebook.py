"""A schedule as HTML that is whole in itself: a chart to move about in, and its table, which needs no script."""

from __future__ import annotations

from dataclasses import replace

from reports.charts.told import rounded
from reports.pages.alive import figure, script, style
from sched_sim.schedule.outcome import Schedule
from studies.explorer.document import document
from studies.explorer.schedule import shown

MOST_SLICES = 4_000
"""Of a long schedule: each is some fifty letters of the notebook's file."""


def schedule_html(schedule: Schedule, table: str) -> str:
    """For a notebook, which needs no extension for it and asks nothing of the network. table: of the schedule, as HTML.

    Of a long schedule the first steps are drawn, and it is said how many deadlines are missed later.
    """
    steps = -(-schedule.horizon // schedule.period)
    drawn = min(steps, _most_steps(schedule))
    cut = "" if drawn == steps else f"the first {drawn:,} of {steps:,} steps"
    end = drawn * schedule.period
    kept = replace(schedule, slices=tuple(piece for piece in schedule.slices if piece.release < end))
    line = shown(kept, drawn, cut=cut)
    if later := schedule.misses - sum(line.jobs.missed):
        are = "deadline is" if later == 1 else "deadlines are"
        line = replace(line, cut=f"{cut}; {later:,} more {are} missed later")
    data = {"panels": [{"title": "", "notes": [], "schedule": rounded(document(line))}]}
    return (
        f'<div class="ss-cell"><style>{style()}</style>{figure(table, data)}'
        f'<script type="module">{script()}</script></div>'
    )


def _most_steps(schedule: Schedule) -> int:
    """Those that the first slices are of."""
    last = schedule.slices[:MOST_SLICES][-1]
    return max(last.end // schedule.period, 1) if len(schedule.slices) > MOST_SLICES else schedule.horizon
