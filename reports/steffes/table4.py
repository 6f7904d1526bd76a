"""Table 4 as dots: every design and method on one axis of speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from reports.charts.panels import METHOD_NAMES
from reports.drawing.axes import plain
from reports.drawing.legend import draw_legend, legend_height
from reports.drawing.style import FONT_PT, SMALL_PT, SOURCES, WIDTH_MM, axes_at, drawing, page, text_width_mm
from reports.steffes.signs import check_sources, row_name, sign, source_entries
from reports.steffes.speeds import SPEED_UNIT, speed_ticks
from sched_sim.design.timing import Timing

ROW_MM, HEAD_MM, AXIS_MM, EDGE_MM, RIGHT_MM = 5.6, 4.6, 10.5, 2.0, 18.0
SIGN_SCALE = 0.75
BAND = "analysis"
"""Whose interval goes over the whole row: what rounding leaves open to the printed figure too."""


class Speeds(NamedTuple):
    """One cell of Table 4: the least speed of a method in a design, by each source of `SOURCES` that has it, and the
    interval of those that have one; note: what is said beside it."""

    timing: Timing
    method: str
    by_source: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    note: str = ""


def table4_figure(cells: Sequence[Speeds]) -> Figure:
    """A block for each design, in it a row for each method, in it a lane for each source; bars are intervals.

    Raises InputError for a source that has no sign.
    """
    sources = list(dict.fromkeys(source for cell in cells for source in cell.by_source))
    check_sources(sources)
    designs = list(dict.fromkeys(cell.timing for cell in cells))
    head = HEAD_MM / ROW_MM
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(METHOD_NAMES[cell.method]) for cell in cells)
        across = WIDTH_MM - left - RIGHT_MM
        rows = len(cells) + head * len(designs)
        legend, legend_top = source_entries(sources), EDGE_MM + ROW_MM * rows + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        axes = axes_at(figure, left, EDGE_MM, across, ROW_MM * rows)
        reach = [end for cell in cells for end in (*cell.by_source.values(), *sum(cell.intervals.values(), ()))]
        limits = 0.93 * min(reach), 1.12 * max(reach)
        axes.set(xlim=limits, ylim=(rows - 0.5, -0.5), yticks=[])
        speed_ticks(axes, "x", limits)
        names, y = {}, -0.5
        for timing in designs:
            text = f"N = {timing.N}, M = {timing.M}, L = {timing.L}"
            axes.text(
                0.0, y + head / 2, text, transform=axes.get_yaxis_transform(), va="center", weight="bold", size=FONT_PT
            )
            y += head + 0.5
            for cell in (cell for cell in cells if cell.timing == timing):
                names[round(y, 3)] = f"{METHOD_NAMES[cell.method]}, N = {timing.N}, M = {timing.M}, L = {timing.L}"
                row_name(axes, y, METHOD_NAMES[cell.method])
                _band(axes, cell, y)
                for source, speed in cell.by_source.items():
                    interval = None if source == BAND else cell.intervals.get(source)
                    sign(axes, speed, y, source, sources, interval=interval, scale=SIGN_SCALE)
                if cell.note:
                    beside = max([*cell.by_source.values(), *sum(cell.intervals.values(), ())])
                    axes.annotate(
                        cell.note, (beside, y), (7, 0), textcoords="offset points", va="center", size=SMALL_PT
                    )
                y += 1.0
            y -= 0.5
        axes.fmt_ydata = lambda at: names[min(names, key=lambda row: abs(row - at))]
        plain(axes)
        axes.spines["left"].set_visible(False)
        axes.set_xlabel(f"least speed ({SPEED_UNIT})", labelpad=2)
        draw_legend(figure, legend, left, legend_top, across)
        return figure


def _band(axes: Axes, cell: Speeds, y: float) -> None:
    if BAND in cell.intervals:
        low, high = cell.intervals[BAND]
        colour = SOURCES[BAND].colour
        box = Rectangle((low, y - 0.42), high - low, 0.84, fc=to_rgba(colour, 0.35), ec=colour, lw=0.5, zorder=1)
        axes.add_patch(box)
