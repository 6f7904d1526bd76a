"""The least speeds of one design as bars, few and large enough for the first screen of a phone."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.axes import plain
from reports.drawing.style import GREY, METHOD_LINES, axes_at, drawing, page
from reports.pages.stored import Rows
from sched_sim.design.timing import Timing

LARGE_PT = 9.0
SHEET_MM, LEFT_MM, RIGHT_MM, ROW_MM, TOP_MM, AXIS_MM, EDGE_MM = 115.0, 40.0, 4.0, 8.5, 5.5, 11.0, 1.0
"""Narrower than a page, and so larger on one and on a phone."""
BAR = 0.62
"""Of a row's height."""
LEVEL = "standard"
"""The method that is a line, for what the others need is measured by it."""


def answer_figure(speeds: Mapping[str, Fraction], timing: Timing) -> Figure:
    """A bar for each method, and below its name when its correction lands; a line for the filter without delay, which
    no number stands on.

    speeds: the least of each, by method.
    """
    bars = [method for method in speeds if method != LEVEL]
    body, level = ROW_MM * len(bars), float(speeds[LEVEL])
    with drawing():
        figure = page(EDGE_MM + TOP_MM + body + AXIS_MM + EDGE_MM, SHEET_MM)
        axes = axes_at(figure, LEFT_MM, EDGE_MM + TOP_MM, SHEET_MM - LEFT_MM - RIGHT_MM, body)
        axes.set(xlim=(0, 1.17 * float(max(speeds.values()))), ylim=(len(bars) - 0.5, -0.5), yticks=[])
        for row, method in enumerate(bars):
            speed = float(speeds[method])
            axes.barh([row], [speed], BAR, color=METHOD_LINES[method].colour)
            axes.annotate(
                f"{speed:.2f}",
                (max(speed, level), row),
                (4, 0),
                textcoords="offset points",
                va="center",
                weight="bold",
                size=LARGE_PT,
            )
            for text, up, weight in ((METHOD_NAMES[method], 1, "bold"), (_lands(method, timing), -1, "normal")):
                axes.annotate(
                    text, (0, row), (-5, 5.5 * up), xycoords=axes.get_yaxis_transform(), textcoords="offset points",
                    ha="right", va="center", weight=weight, size=LARGE_PT,
                )  # fmt: skip
        axes.axvline(level, color=METHOD_LINES[LEVEL].colour, lw=1.0, ls=(0, (3.0, 1.5)), zorder=0.5)
        axes.annotate(
            f"{METHOD_NAMES[LEVEL]}: {level:.0f}", (level, -0.5), (0, 3), textcoords="offset points", ha="center",
            size=LARGE_PT, color=GREY,
        )  # fmt: skip
        plain(axes)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=4, integer=True))
        axes.tick_params(labelsize=LARGE_PT)
        axes.set_xlabel("least processor speed", labelpad=2, size=LARGE_PT)
        return figure


def answer_rows(speeds: Mapping[str, Fraction], timing: Timing) -> Rows:
    """What is drawn."""
    rows: Rows = [["Method", "lands at L", "least speed"]]
    for method, speed in speeds.items():
        rows.append([METHOD_NAMES[method], _steps(method, timing), f"{float(speed):.3f}"])
    return rows


def _steps(method: str, timing: Timing) -> int:
    """From the measurement to its correction."""
    return {LEVEL: 0, "dual-rate": timing.L}.get(method, timing.M)


def _lands(method: str, timing: Timing) -> str:
    later = _steps(method, timing) - timing.M
    return "corrects on arrival" if later == 0 else f"corrects {later} steps later"
