"""Achieved l against speed: the predicted staircase, what was measured, and how many cycles landed as predicted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.band import band, band_entry
from reports.drawing.legend import SWATCH_MM, Entry, draw_legend, legend_height, line_entry
from reports.drawing.sheet import label
from reports.drawing.style import INK, PALE, RED, SOURCES, WIDTH_MM, Line, axes_at, drawing, page
from studies.live.measure import Measured
from studies.live.stairs import steps
from studies.live.taken import NEAR

LEFT_MM, RIGHT_MM, UPPER_MM, LOWER_MM, BETWEEN_MM = 15.0, 4.0, 44.0, 34.0, 4.0
MEASURED = SOURCES["measured"]._replace(size=5.0)
CALM = Line(INK, "-", "o", 2.6)
ALL = Line(MEASURED.colour, "-", "s", 5.4)
UNDISTURBED: dict[str, Any] = {"facecolor": "white", "edgecolor": INK, "lw": 0.7}
"""Empty, so that its bars are not taken for shaded bands."""
PREDICTED = Line(INK, "-", "None")
LATER = Line(RED, "-", "*", 6.0)
MOST_LATER = 3
"""Steps that the axis goes beyond the latest predicted landing."""
ELSEWHERE = Line(RED, "-", "X", 4.5)
LARGEST = 6.5
"""Of a sign for all cycles of a speed, in points."""
LEAST = 5.0
"""Area of the sign of a single cycle, in square points."""


def staircase_figure(runs: Sequence[Measured], mark: str = "") -> Figure:
    """runs: at ascending speeds, of one design; mark: behind what was measured, in the legend."""
    legend = [
        line_entry("predicted l", PREDICTED),
        line_entry(f"measured l{mark}, its area the share of the cycles", MEASURED, dashes=False),
        line_entry(f"as predicted, of undisturbed cycles{mark}", CALM, dashes=False),
        line_entry(f"as predicted, of all cycles{mark}", ALL, dashes=False),
        Entry(f"undisturbed{mark}", SWATCH_MM, _undisturbed),
        band_entry(f"within {float(100 * NEAR):g} % of a step"),
    ]
    elsewhere = [l for run in runs for l in run.achieved if l is not None and l != run.predicted]
    if any(l > _top(runs) for l in elsewhere):
        legend.insert(2, line_entry(f"later than shown{mark}", LATER, dashes=False))
    if any(l <= _top(runs) for l in elsewhere):
        legend.insert(2, line_entry(f"measured elsewhere{mark}", ELSEWHERE, dashes=False))
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


def _undisturbed(axes: Axes, x: float, y: float) -> None:
    axes.add_patch(Rectangle((x, y - 1.3), SWATCH_MM, 2.6, **UNDISTURBED))


def _frame(axes: Axes, runs: Sequence[Measured]) -> None:
    """The axis of speed, shaded where a step is near."""
    speeds = [float(run.design.speed) for run in runs]
    free = 0.03 * (speeds[-1] - speeds[0]) or 0.05
    axes.set_xlim(speeds[0] - free, speeds[-1] + free)
    for step in map(float, steps(runs[0].design)):
        band(axes, step * (1 - float(NEAR)), step * (1 + float(NEAR)))


def _landings(axes: Axes, runs: Sequence[Measured]) -> None:
    design, ends = runs[0].design, axes.get_xlim()
    edges = [ends[0], *(float(step) for step in steps(design) if ends[0] < step < ends[1]), ends[1]]
    middles = [Fraction((left + right) / 2) for left, right in pairwise(edges)]
    heights = [design._replace(speed=middle).predicted or float("nan") for middle in middles]
    axes.stairs(heights, edges, color=INK, lw=1.2, baseline=None, zorder=2)
    top = _top(runs)
    for run in runs:
        for l, count in Counter(run.achieved).items():
            if l is not None and l > top:
                axes.plot([float(run.design.speed)], [top + 0.5], LATER.marker, color=RED, ms=LATER.size, mew=0)
            elif l is not None:
                size = LARGEST**2 * count / len(run.achieved)
                line = MEASURED if l == run.predicted else ELSEWHERE
                axes.scatter(
                    [float(run.design.speed)],
                    [l],
                    s=max(size, LEAST),
                    marker=line.marker,
                    color=line.colour,
                    lw=0,
                    zorder=3,
                )
    axes.yaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    predicted = [run.predicted for run in runs]
    least = min([*predicted, *(l for run in runs for l in run.achieved if l is not None)])
    axes.set_ylim(least - 0.7, top + 0.7)
    label(axes, "where corrections land", "", "achieved $l - k$ (steps)")


def _top(runs: Sequence[Measured]) -> int:
    """The latest landing that is drawn where it is."""
    landed = [l for run in runs for l in run.achieved if l is not None]
    return min(max([run.predicted for run in runs]) + MOST_LATER, max([*landed, *(run.predicted for run in runs)]))


def _shares(axes: Axes, runs: Sequence[Measured]) -> None:
    speeds = [float(run.design.speed) for run in runs]
    agreements = [run.agreement for run in runs]
    calm = [float("nan" if of.share_undisturbed is None else 100 * of.share_undisturbed) for of in agreements]
    undisturbed = [100 * of.undisturbed / of.cycles for of in agreements]
    everything = [float(100 * of.share) for of in agreements]
    low, high = axes.get_xlim()
    axes.bar(speeds, undisturbed, 0.012 * (high - low), zorder=1, **UNDISTURBED)
    for name, line, values in (("of all cycles", ALL, everything), ("of undisturbed cycles", CALM, calm)):
        axes.plot(
            speeds, values, line.marker, color=line.colour, ms=line.size, mew=0, clip_on=False, zorder=3, label=name
        )
    axes.set_ylim(0, 100)
    label(axes, "", "speed (cost units per HR period)", "% of the cycles")
