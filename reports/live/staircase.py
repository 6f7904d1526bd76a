"""Achieved l against speed: the predicted staircase, what was measured, and how many cycles landed as predicted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.sheet import label
from reports.drawing.style import INK, PALE, RED, WIDTH_MM, Line, axes_at, drawing, page
from studies.live.measure import Measured
from studies.live.stairs import NEAR, two_steps

LEFT_MM, RIGHT_MM, UPPER_MM, LOWER_MM, BETWEEN_MM = 15.0, 4.0, 44.0, 34.0, 4.0
MEASURED = Line("#11538c", "-", "o", 4.5)
CALM = Line("#11538c", "-", "o", 4.0)
ALL = Line("#dd9009", (0, (4.0, 1.5)), "s", 3.6)
SHARE = Line("#8f8f8f", (0, (1.0, 1.2)), "^", 3.8)
PREDICTED = Line(INK, "-", "None")
NEAR_STEP = Line(PALE, "-", "s", 5.0)
LARGEST = 5.5
"""Of a sign for all cycles of a speed, in points."""


def staircase_figure(runs: Sequence[Measured]) -> Figure:
    """runs: at ascending speeds, of one design."""
    legend = [
        line_entry("predicted l", PREDICTED),
        line_entry("measured l, its area the share of the cycles", MEASURED, dashes=False),
        line_entry("of undisturbed cycles", CALM),
        line_entry("of all cycles", ALL),
        line_entry("undisturbed cycles", SHARE),
        line_entry(f"within {float(100 * NEAR):g} % of a step", NEAR_STEP, dashes=False),
    ]
    with drawing():
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        top = EDGE_MM + TITLE_MM
        foot = top + UPPER_MM + BETWEEN_MM + LOWER_MM + AXIS_MM
        figure = page(foot + legend_height(legend, across) + EDGE_MM)
        upper = axes_at(figure, LEFT_MM, top, across, UPPER_MM)
        lower = axes_at(figure, LEFT_MM, top + UPPER_MM + BETWEEN_MM, across, LOWER_MM)
        for axes in (upper, lower):
            plain(axes)
            axes.grid(axis="y", color=PALE, lw=0.5)
            _frame(axes, runs)
        upper.tick_params(axis="x", labelbottom=False)
        _landings(upper, runs)
        _shares(lower, runs)
        draw_legend(figure, legend, LEFT_MM, foot, across)
        return figure


def _frame(axes: Axes, runs: Sequence[Measured]) -> None:
    """The axis of speed, shaded where a step is near."""
    speeds = [float(run.design.speed) for run in runs]
    free = 0.03 * (speeds[-1] - speeds[0]) or 0.01
    axes.set_xlim(speeds[0] - free, speeds[-1] + free)
    for step in map(float, two_steps(runs[0].design)):
        axes.axvspan(step * (1 - float(NEAR)), step * (1 + float(NEAR)), color=PALE, alpha=0.6, lw=0, zorder=0.2)


def _landings(axes: Axes, runs: Sequence[Measured]) -> None:
    low, high = axes.get_xlim()
    edges = [low, *map(float, two_steps(runs[0].design)), high]
    heights = [_predicted_between(runs, left, right) for left, right in zip(edges, edges[1:], strict=False)]
    axes.stairs(heights, edges, color=INK, lw=1.2, baseline=None, zorder=2)
    for run in runs:
        for l, count in Counter(run.achieved).items():
            if l is not None:
                size = LARGEST**2 * count / len(run.achieved)
                colour = MEASURED.colour if l == run.predicted else RED
                axes.scatter([float(run.design.speed)], [l], s=max(size, 3.0), color=colour, lw=0, zorder=3)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    predicted = [run.predicted for run in runs]
    least = min([*predicted, *(l for run in runs for l in run.achieved if l is not None)])
    most = max(l for run in runs for l in [run.predicted, *run.achieved] if l is not None)
    axes.set_ylim(least - 0.7, most + 0.7)
    label(axes, "where corrections land", "", "achieved $l - k$ (steps)")


def _predicted_between(runs: Sequence[Measured], low: float, high: float) -> float:
    between = [run.predicted for run in runs if low <= float(run.design.speed) < high]
    return float(between[0]) if between else float("nan")


def _shares(axes: Axes, runs: Sequence[Measured]) -> None:
    speeds = [float(run.design.speed) for run in runs]
    agreements = [run.agreement for run in runs]
    calm = [float("nan" if of.share_undisturbed is None else 100 * of.share_undisturbed) for of in agreements]
    shares = [
        (SHARE, [100 * of.undisturbed / of.cycles for of in agreements]),
        (ALL, [float(100 * of.share) for of in agreements]),
        (CALM, calm),
    ]
    for line, values in shares:
        axes.plot(speeds, values, color=line.colour, ls=line.dashes, marker=line.marker, ms=line.size, mew=0, lw=1.0)
    axes.set_ylim(0, 105)
    label(axes, "", "speed (cost units per HR period)", "landing as predicted (%)")
