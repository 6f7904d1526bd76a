"""How likely longer response times and later landings are: exact, on a logarithmic axis."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.lanes import shortened
from reports.drawing.legend import Entry, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import FILLS, RED, Line, drawing
from reports.drawing.tails import tail_axis
from sched_sim.probability.outcome import Bounds, CycleProbabilities, Floats, Tail
from sched_sim.probability.responses import period_in
from studies.probability.answer import Answer
from studies.probability.question import Question

DEEPEST, SHALLOWEST = 1e-18, 1e-2
"""Between these lies the lower end of an axis."""
BELOW = 30
"""So far below what is resolved the axis ends."""
CLEAR = 3
"""So far below the least probability it ends where all are known."""
PLOT_MM = 42.0
DEADLINE = Line(RED, "-", "None")
CURVE = Line(FILLS["HRU"].colour, "-", "None")


def tails_figure(found: Answer, rate: Fraction | None) -> Figure:
    """A plot for each kind of job and one of the landing, in the long run, or of the last cycle where there is none.

    rate: of the HR loop, in Hz. Between bounds that differ there is a band; a red line is a deadline; what samples do
    not resolve is shaded.
    """
    cycle = found.given.settled
    responses = sorted(cycle.responses.items(), key=lambda response: response[0] != "hr")
    with drawing():
        figure, rows = sheet(ceil((len(responses) + 1) / 2), 2, _legend(found), height_mm=PLOT_MM)
        plots = [axes for row in rows for axes in row]
        for axes, (kind, tail) in zip(plots, responses, strict=False):
            _response(axes, found, kind, tail, rate)
        _landing(plots[len(responses)], found, cycle)
        for axes in plots[len(responses) + 1 :]:
            axes.remove()
        return figure


def _legend(found: Answer) -> list[Entry]:
    when = "in the long run" if found.given.long_run else f"in cycle {found.question.cycles:,}"
    bounds = "" if found.given.exact else ", between bounds"
    return [line_entry(f"probability {when}, executions independent{bounds}", CURVE), line_entry("deadline", DEADLINE)]


def _response(axes: Axes, found: Answer, kind: str, tail: Tail, rate: Fraction | None) -> None:
    scale, unit = period_in(rate)
    floor = found.resolution.of(kind)
    times = np.linspace(0.0, scale * len(tail.upper) / found.given.ticks, len(tail.upper) + 1)
    lower, upper = (np.append(side, 0.0) if side[-1] else np.append(side, side[-1]) for side in tail)
    _curve(axes, times, lower, upper, floor, FILLS["LRU" if kind == "lr_update" else "HRU"].colour)
    due = _due(found.question, kind)
    high = float(times[np.flatnonzero(upper > axes.get_ylim()[0])[-1] + 1])
    if due is not None:
        axes.axvline(scale * due, color=RED, lw=1.0, zorder=4)
        high = max(high, scale * due)
    axes.set_xlim(0, 1.05 * high)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
    label(axes, shortened(kind), f"response time ({unit})", "P(longer)")


def _landing(axes: Axes, found: Answer, cycle: CycleProbabilities) -> None:
    steps = sorted(cycle.landing)
    first, last = steps[0] - 1, steps[-1]
    each = [cycle.landing.get(L, Bounds(0.0, 0.0)) for L in range(first, last + 2)]
    lower, upper = (np.append(np.cumsum([one[side] for one in each][::-1])[::-1][1:], 0.0) for side in (0, 1))
    at = np.linspace(first, last + 1, last + 2 - first)
    _curve(axes, at, lower, np.minimum(upper, 1.0), found.resolution.cycle, FILLS["LRU"].colour)
    due = found.question.due
    axes.axvline(due + 0.5, color=RED, lw=1.0, zorder=4)
    reached = float(at[np.flatnonzero(upper > axes.get_ylim()[0])[-1] + 1]) if upper.any() else float(last)
    axes.set_xlim(min(first, due) - 0.5, max(reached, due) + 1.5)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    label(axes, "landing", "$l - k$ (high-rate steps)", "P(lands later)")


def _curve(axes: Axes, at: Floats, lower: Floats, upper: Floats, floor: float, colour: str) -> None:
    """Of steps, each from where it is to the next."""
    positive = upper[upper > 0]
    end = floor / BELOW if floor else float(min(positive, default=SHALLOWEST)) / CLEAR
    tail_axis(axes, min(max(end, DEEPEST), SHALLOWEST), floor)
    low = axes.get_ylim()[0]
    least, most = (np.maximum(side, low / 10) for side in (lower, upper))
    axes.fill_between(at, least, most, step="post", color=colour, alpha=0.3, lw=0)
    for side in (least, most):
        axes.step(at, side, where="post", color=colour, lw=1.2)


def _due(asked: Question, kind: str) -> float | None:
    """From the release, in HR periods."""
    if kind == "hr":
        return 1.0
    if kind == "lr_update":
        return float(asked.timing.L - asked.timing.M + (asked.options.feedback == "same-step"))
    return next((float(task.due) for task in asked.tasks if kind == f"task:{task.name}"), None)
