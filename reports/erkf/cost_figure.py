"""What a step of the robust filter costs, one row for each way to compute it: counted, and timed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, decades, plain
from reports.drawing.legend import Entry, draw_legend, legend_height
from reports.drawing.style import INK, PALE, SMALL_PT, TITLE_PT, WIDTH_MM, axes_at, drawing, page, text_width_mm
from reports.erkf.styles import HOLLOW, way_line
from reports.pages.machine import marked

ROW_MM, APART_MM, GAP_MM, RIGHT_MM = 4.2, 1.5, 8.0, 4.0
COUNTS_SHARE = 0.6
"""The counts' part of the width; the times have the rest."""


class Way(NamedTuple):
    """One way to compute the step; in its name, what `way_line` knows stands before a colon. operations, seconds: by
    system; seconds: from, to; a way that is not timed has none."""

    name: str
    operations: Mapping[str, int]
    seconds: Mapping[str, tuple[float, float]] = {}


def cost_figure(ways: Sequence[Way], unknowns: Mapping[str, int], step_s: float) -> Figure:
    """Operations, and the time of the compiled code, each on a logarithmic axis; a sign for each system.

    unknowns: of the block system, by system. step_s: the HR period, a line among the times.
    """
    heights = _heights(ways)
    with drawing():
        left = EDGE_MM + 3.0 + max(text_width_mm(way.name) for way in ways)
        across = WIDTH_MM - left - RIGHT_MM - GAP_MM
        widths = [across * COUNTS_SHARE, across * (1 - COUNTS_SHARE)]
        height = heights[-1] + ROW_MM / 2
        legend = [_entry(system, f"{system} filter, N = {number}") for system, number in unknowns.items()]
        legend_top = EDGE_MM + TITLE_MM + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        counts = axes_at(figure, left, EDGE_MM + TITLE_MM, widths[0], height)
        times = axes_at(figure, left + widths[0] + GAP_MM, EDGE_MM + TITLE_MM, widths[1], height)
        for y, way in zip(heights, ways, strict=True):
            _row(counts, y, {system: (number, number) for system, number in way.operations.items()}, way.name)
            counts.annotate(
                way.name, (0, y), (-4, 0), xycoords=counts.get_yaxis_transform(), textcoords="offset points",
                ha="right", va="center",
            )  # fmt: skip
            micros_of = {system: (1e6 * low, 1e6 * high) for system, (low, high) in way.seconds.items()}
            _row(times, y, micros_of, way.name)
        for axes in (counts, times):
            axes.fmt_ydata = lambda y: ways[min(range(len(ways)), key=lambda i: abs(heights[i] - y))].name
            axes.set(ylim=(height, 0.0), yticks=[])
            axes.spines["left"].set_visible(False)
            plain(axes)
        numbers = [number for way in ways for number in way.operations.values()]
        decades(counts, "x", min(numbers) / 2, 2 * max(numbers))
        micros = [1e6 * time for way in ways for ends in way.seconds.values() for time in ends]
        decades(times, "x", min(micros) / 2, 3e6 * step_s)
        times.axvline(1e6 * step_s, color=INK, lw=0.7, ls=(0, (2, 1.5)), zorder=1)
        times.annotate(
            f"one step at {1 / step_s:g} Hz", (1e6 * step_s, ROW_MM / 2), (-3, 0), textcoords="offset points",
            ha="right", va="center", size=SMALL_PT,
        )  # fmt: skip
        counts.set_title("Operations in a step", loc="left", size=TITLE_PT)
        times.set_title(marked("Compiled code"), loc="left", size=TITLE_PT)
        counts.set_xlabel("floating-point operations", labelpad=2)
        times.set_xlabel("least time (µs)", labelpad=2)
        draw_legend(figure, legend, left, legend_top, across)
        return figure


def _heights(ways: Sequence[Way]) -> list[float]:
    """Of the rows, in mm from above, the first below a free one; those of one way stand together."""
    heights: list[float] = []
    last = ""
    for way in ways:
        name = way.name.partition(":")[0]
        heights.append((heights[-1] if heights else ROW_MM / 2) + ROW_MM + (APART_MM if name != last else 0.0))
        last = name
    return heights


def _row(axes: Axes, y: float, values: Mapping[str, tuple[float, float]], way: str) -> None:
    """A sign at the lower end of each range, and a line to the other."""
    axes.axhline(y, color=PALE, lw=0.5, zorder=0.5)
    line = way_line(way)
    for system, (low, high) in values.items():
        if high > low:
            axes.hlines(y, low, high, color=line.colour, lw=0.8, zorder=2)
        fill = "white" if HOLLOW[system] else line.colour
        axes.plot(
            [low], [y], line.marker, color=line.colour, ms=line.size + 0.4, mfc=fill, mew=0.9, zorder=3, label=system
        )


def _entry(system: str, text: str) -> Entry:
    """A sign of no way."""

    def draw(axes: Axes, x: float, y: float) -> None:
        axes.plot([x + 1], [y], "o", color=INK, mfc="white" if HOLLOW[system] else INK, ms=4.2, mew=0.9)

    return Entry(text, 2.0, draw)
