"""Plots in rows and columns on one page, with a legend below."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.legend import Entry, draw_legend, legend_height
from reports.drawing.style import PALE, TITLE_PT, WIDTH_MM, axes_at, page

LEFT_MM, RIGHT_MM, GAP_MM, PLOT_MM = 15.0, 4.0, 15.0, 50.0
STACKED_MM = 4.0
"""Between rows that share the axis below them."""


class Sheet(NamedTuple):
    """plots: by row, from above."""

    figure: Figure
    plots: list[list[Axes]]


def sheet(
    rows: int,
    columns: int,
    legend: Sequence[Entry],
    *,
    height_mm: float = PLOT_MM,
    gap_mm: float = GAP_MM,
    right_mm: float = RIGHT_MM,
    stacked: bool = False,
    width_mm: float = WIDTH_MM,
) -> Sheet:
    """Empty plots.

    height_mm: of each; width_mm: of the page; stacked: rows have one axis of x, below the last of them.
    """
    across = width_mm - LEFT_MM - right_mm
    width = (across - gap_mm * (columns - 1)) / columns
    down = height_mm + (STACKED_MM if stacked else AXIS_MM + TITLE_MM)
    legend_top = EDGE_MM + TITLE_MM + down * (rows - 1) + height_mm + AXIS_MM
    figure = page(legend_top + legend_height(legend, across) + EDGE_MM, width_mm)
    plots = [
        [
            axes_at(figure, LEFT_MM + column * (width + gap_mm), EDGE_MM + TITLE_MM + row * down, width, height_mm)
            for column in range(columns)
        ]
        for row in range(rows)
    ]
    for row in plots:
        for axes in row:
            axes.grid(axis="y", color=PALE, lw=0.5)
            plain(axes)
            axes.tick_params(axis="x", labelbottom=not stacked or row is plots[-1])
    draw_legend(figure, legend, LEFT_MM, legend_top, across)
    return Sheet(figure, plots)


def label(axes: Axes, title: str = "", across: str = "", up: str = "") -> None:
    """Title, and names of the axes with their units; "" leaves one out."""
    if title:
        axes.set_title(title, loc="left", size=TITLE_PT)
    if across:
        axes.set_xlabel(across, labelpad=2)
    if up:
        axes.set_ylabel(up, labelpad=2)
