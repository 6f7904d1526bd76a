"""Figures 3 and 4 of the paper on a simulated drive: the route in three dimensions, and the time between fixes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import GREY, INK, SMALL_PT, TITLE_PT, WIDTH_MM, axes_at, drawing, page
from reports.erkf.drive import BETWEEN_MM, filter_entry, style_axes
from reports.erkf.styles import FILTERS, GPS, TRUE, WIDTHS

Columns = Mapping[str, FloatArray]

LEFT_MM, RIGHT_MM, ROUTE_MM, GAP_MM, ROW_MM = 4.0, 4.0, 78.0, 18.0, 30.0
HEIGHT_TIMES = 10.0
"""Heights are drawn so many times as large as what is level."""
EAST, NORTH = np.array([0.94, -0.34]), np.array([0.62, 0.50])
"""Where a metre of each goes on the page; up goes up."""
STEM_EVERY = 50
"""Samples between the lines that join the route to the ground."""


def route_figure(drive: Columns, close_up: Columns, error: str) -> Figure:
    """Left, the route from above and aside with its fixes; right, one second of it: along the way and across it.

    error: which scale error, as in the columns' names.
    """
    with drawing():
        height = 2 * ROW_MM + BETWEEN_MM
        legend = [
            line_entry("true", TRUE),
            line_entry("GPS fixes, 10 Hz, held until the next", GPS),
            *(filter_entry(name, f"{name}, 400 Hz") for name in FILTERS),
        ]
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        legend_top = EDGE_MM + TITLE_MM + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        _route(axes_at(figure, LEFT_MM, EDGE_MM + TITLE_MM, ROUTE_MM, height + AXIS_MM - 2), drive, error)
        left = LEFT_MM + ROUTE_MM + GAP_MM
        _close_up(figure, drive, close_up, error, left, WIDTH_MM - RIGHT_MM - left)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def projected(east: FloatArray, north: FloatArray, up: FloatArray) -> FloatArray:
    """On the page (2, any), from metres."""
    directions = np.column_stack([EAST, NORTH, [0.0, HEIGHT_TIMES]])
    on_page: FloatArray = directions @ np.array([east, north, up])
    return on_page


def _route(axes: Axes, drive: Columns, error: str) -> None:
    def of(what: str) -> FloatArray:
        return projected(drive[f"{what} east"], drive[f"{what} north"], drive[f"{what} up"])

    ground = float(np.floor(drive["true up"].min())) - 2.0
    below = projected(drive["true east"], drive["true north"], np.full_like(drive["true up"], ground))
    axes.plot(*below, color=GREY, lw=0.6, ls=(0, (2, 1.5)))
    axes.vlines(below[0, ::STEM_EVERY], below[1, ::STEM_EVERY], of("true")[1, ::STEM_EVERY], color=GREY, lw=0.4)
    axes.plot(*of("gps")[:, ::2], GPS.marker, color=GPS.colour, ms=2.6, mew=0)
    for name, line in FILTERS.items():
        axes.plot(*of(f"{name} {error}"), color=line.colour, lw=WIDTHS[name])
    axes.plot(*of("true")[:, :1], "o", ms=5, mfc="none", mec=INK, mew=0.9)
    _directions(axes, of("true").mean(axis=1) - np.array([40.0, 50.0]))
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xticks=[], yticks=[])
    axes.axis("off")
    axes.set_title(f"The route; heights {HEIGHT_TIMES:g} times", loc="left", size=TITLE_PT)


def _directions(axes: Axes, origin: FloatArray) -> None:
    """60 m east and north, and 5 m up, from this point of the page."""
    for step, text, align, beside in (
        ((60.0, 0.0, 0.0), "60 m east", "left", (3, -3)),
        ((0.0, 60.0, 0.0), "60 m north", "left", (3, -1)),
        ((0.0, 0.0, 5.0), "5 m up", "left", (-2, 3)),
    ):
        end = origin + projected(*np.transpose([step]))[:, 0]
        axes.plot(*np.transpose([origin, end]), color=INK, lw=0.9, solid_capstyle="round")
        axes.annotate(
            text, (end[0], end[1]), beside, textcoords="offset points", ha=align, va="baseline", size=SMALL_PT
        )


def _close_up(figure: Figure, drive: Columns, close_up: Columns, error: str, left: float, width: float) -> None:
    time_s = close_up["time_s"]
    start = np.array([close_up["true north"][0], close_up["true east"][0]])
    way = np.array([close_up["true north"][-1], close_up["true east"][-1]]) - start
    way /= np.linalg.norm(way)
    sides = {"along the way (m)": way, "right of it (m)": np.array([-way[1], way[0]])}
    fixes = (drive["time_s"] >= time_s[0]) & (drive["time_s"] <= time_s[-1])

    def along(columns: Columns, what: str, side: FloatArray) -> FloatArray:
        there: FloatArray = (np.array([columns[f"{what} north"], columns[f"{what} east"]]).T - start) @ side
        return there

    for row, (name, side) in enumerate(sides.items()):
        axes = axes_at(figure, left, EDGE_MM + TITLE_MM + row * (ROW_MM + BETWEEN_MM), width, ROW_MM)
        for of_filter, line in FILTERS.items():
            axes.plot(
                time_s, along(close_up, f"{of_filter} {error}", side), color=line.colour, lw=WIDTHS[of_filter],
                label=of_filter,
            )  # fmt: skip
        axes.plot(time_s, along(close_up, "true", side), color=INK, lw=0.6, label="true")
        at, seen = drive["time_s"][fixes], along(drive, "gps", side)[fixes]
        axes.step(at, seen, where="post", color=GPS.colour, lw=0.7, zorder=1)
        axes.plot(at, seen, GPS.marker, color=GPS.colour, ms=6.0, mew=0, label="GPS")
        style_axes(axes, "One second, every 400 Hz step" if row == 0 else "", "time (s)" if row else "", name)
        axes.tick_params(axis="x", labelbottom=row == 1)
