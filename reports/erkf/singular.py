"""Figures 7 and 8 of the paper: singular values of P by an inverse and by Givens rotations, and what they differ by."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, decades, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import INK, SMALL_PT, TITLE_PT, WIDTH_MM, axes_at, drawing, page
from reports.erkf.styles import WAYS as LINES
from reports.pages.machine import marked

LEFT_MM, RIGHT_MM, GAP_MM, VALUES_MM, DIFFERENCES_MM, BETWEEN_MM = 14.0, 4.0, 16.0, 44.0, 44.0, 9.0
WAYS = {"givens": "Givens", "lu": "pivoted LU", "lu without pivoting": "unpivoted LU"}
MARKED = 10
"""Signs along a curve."""


def singular_figure(curves: Mapping[str, FloatArray], systems: Mapping[str, str]) -> Figure:
    """A column for each system. Above, the largest and the smallest singular value against time; below, how far the
    largest by each way is from that by the inverse.

    curves: "time_s" and, by system, "SYSTEM largest", "SYSTEM smallest" and, by way, "SYSTEM largest WAY": its
    difference. systems: their titles.
    """
    with drawing():
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        width = (across - GAP_MM * (len(systems) - 1)) / len(systems)
        legend = [line_entry("inverse", LINES["inverse"]._replace(marker=""))]
        legend += [line_entry(name, LINES[name]._replace(dashes="-")) for name in WAYS.values()]
        second = EDGE_MM + TITLE_MM + VALUES_MM + BETWEEN_MM
        legend_top = second + DIFFERENCES_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        time_s = curves["time_s"]
        for column, (system, title) in enumerate(systems.items()):
            left = LEFT_MM + column * (width + GAP_MM)
            values = axes_at(figure, left, EDGE_MM + TITLE_MM, width, VALUES_MM)
            differences = axes_at(figure, left, second, width, DIFFERENCES_MM)
            for which in ("largest", "smallest"):
                _values(values, time_s, curves[f"{system} {which}"], which)
            shown = {way: curves[f"{system} largest {way}"] for way in WAYS}
            _differences(differences, time_s, shown)
            low, high = (limit(curves[f"{system} {which}"]) for which, limit in _ENDS)
            decades(values, "y", low / 3, high * 3, every=2)
            small = min(float(curve[curve > 0].min()) for curve in shown.values() if (curve > 0).any())
            large = max(float(np.nanmax(curve)) for curve in shown.values() if np.isfinite(curve).any())
            decades(differences, "y", small / 3, large * 5, every=2)
            values.set_title(title, loc="left", size=TITLE_PT)
            differences.set_xlabel("time (s)", labelpad=2)
            for axes in (values, differences):
                axes.set_xlim(time_s[0] - 1, time_s[-1] + 1)
                plain(axes)
            values.tick_params(axis="x", labelbottom=False)
            if column == 0:
                values.set_ylabel("singular value of $P$", labelpad=2)
                differences.set_ylabel(marked("difference of the largest"), labelpad=2)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


_ENDS = (("smallest", np.min), ("largest", np.max))


def _values(axes: Axes, time_s: FloatArray, values: FloatArray, which: str) -> None:
    """The inverse as a line, Givens as signs on it, for the two cannot be told apart."""
    axes.plot(time_s, values, color=INK, lw=0.8, label=f"{which}, inverse")
    signs = slice(len(time_s) // (2 * MARKED), None, max(len(time_s) // MARKED, 1))
    line = LINES["Givens"]
    axes.plot(time_s[signs], values[signs], line.marker, color=line.colour, ms=line.size, mew=0, ls="none")
    middle = len(time_s) // 2
    axes.annotate(
        which, (time_s[middle], values[middle]), (0, 4), textcoords="offset points", ha="center", va="bottom",
        size=SMALL_PT,
    )  # fmt: skip


def _differences(axes: Axes, time_s: FloatArray, differences: Mapping[str, FloatArray]) -> None:
    """Signs have a rim, so that their shape is seen on a curve that goes up and down."""
    for number, (way, curve) in enumerate(differences.items()):
        line = LINES[WAYS[way]]
        every = max(len(time_s) // MARKED, 1)
        positive = np.where(curve > 0, curve, np.nan)
        axes.plot(
            time_s, positive, line.marker, color=line.colour, ms=1.4 * line.size, mec="white", mew=0.6, ls="-", lw=0.7,
            markevery=(number * every // len(WAYS), every), label=WAYS[way],
        )  # fmt: skip
