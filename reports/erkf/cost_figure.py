"""What a step of the robust filter costs, one row for each way to compute it: counted, and timed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, decades, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import (
    INK,
    PALE,
    SMALL_PT,
    SOURCE_LINES,
    TITLE_PT,
    WIDTH_MM,
    axes_at,
    drawing,
    page,
    text_width_mm,
)
from reports.pages.machine import marked

ROW_MM, GAP_MM, RIGHT_MM = 4.8, 8.0, 4.0
COUNTS_SHARE = 0.6
"""The counts' part of the width; the times have the rest."""


class Way(NamedTuple):
    """One way to compute the step. operations, seconds: by system; seconds: from, to; a way that is not timed has
    none."""

    name: str
    operations: Mapping[str, int]
    seconds: Mapping[str, tuple[float, float]] = {}


def cost_figure(ways: Sequence[Way], step_s: float) -> Figure:
    """Operations, and the time of the compiled code, each on a logarithmic axis; a sign for each system.

    step_s: the HR period, a line among the times.
    """
    systems = list(dict.fromkeys(system for way in ways for system in way.operations))
    with drawing():
        left = EDGE_MM + 3.0 + max(text_width_mm(way.name) for way in ways)
        across = WIDTH_MM - left - RIGHT_MM - GAP_MM
        widths = [across * COUNTS_SHARE, across * (1 - COUNTS_SHARE)]
        height = ROW_MM * (len(ways) + 1)
        legend = [line_entry(name, line, dashes=False) for name, line in zip(systems, SOURCE_LINES[1:], strict=False)]
        legend_top = EDGE_MM + TITLE_MM + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        counts = axes_at(figure, left, EDGE_MM + TITLE_MM, widths[0], height)
        times = axes_at(figure, left + widths[0] + GAP_MM, EDGE_MM + TITLE_MM, widths[1], height)
        for y, way in enumerate(ways, start=1):
            _row(counts, y, {system: (number, number) for system, number in way.operations.items()}, systems, way.name)
            micros_of = {system: (1e6 * low, 1e6 * high) for system, (low, high) in way.seconds.items()}
            _row(times, y, micros_of, systems)
        for axes in (counts, times):
            axes.fmt_ydata = lambda y: ways[round(y) - 1].name
            axes.set(ylim=(len(ways) + 0.6, -0.4), yticks=[])
            axes.spines["left"].set_visible(False)
            plain(axes)
        numbers = [number for way in ways for number in way.operations.values()]
        decades(counts, "x", min(numbers) / 2, 2 * max(numbers))
        micros = [1e6 * time for way in ways for ends in way.seconds.values() for time in ends]
        decades(times, "x", min(micros) / 2, 3e6 * step_s)
        times.axvline(1e6 * step_s, color=INK, lw=0.7, ls=(0, (2, 1.5)), zorder=1)
        times.annotate(
            f"one step at {1 / step_s:g} Hz", (1e6 * step_s, 0), (-3, 0), textcoords="offset points", ha="right",
            va="center", size=SMALL_PT,
        )  # fmt: skip
        counts.set_title("Operations in a step", loc="left", size=TITLE_PT)
        times.set_title(marked("Compiled code"), loc="left", size=TITLE_PT)
        counts.set_xlabel("floating-point operations", labelpad=2)
        times.set_xlabel("time (µs), minimum to p95", labelpad=2)
        draw_legend(figure, legend, left, legend_top, across)
        return figure


def _row(axes: Axes, y: int, values: Mapping[str, tuple[float, float]], systems: Sequence[str], name: str = "") -> None:
    """A sign at the lower end of each range, and a line to the other."""
    axes.axhline(y, color=PALE, lw=0.5, zorder=0.5)
    if name:
        axes.annotate(
            name, (0, y), (-4, 0), xycoords=axes.get_yaxis_transform(), textcoords="offset points", ha="right",
            va="center",
        )  # fmt: skip
    for system, line in zip(systems, SOURCE_LINES[1:], strict=False):
        if system in values:
            low, high = values[system]
            if high > low:
                axes.hlines(y, low, high, color=line.colour, lw=0.8, zorder=2)
            axes.plot([low], [y], line.marker, color=line.colour, ms=line.size + 0.6, mew=0, zorder=3, label=system)
