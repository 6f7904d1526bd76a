"""A band of an axis, such as where numbers should be: shaded, with dotted edges that are seen on any page."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from reports.drawing.legend import SWATCH_MM, Entry
from reports.drawing.style import GREY

SHADE = "#e3edf5"
EDGE: dict[str, Any] = {"color": GREY, "lw": 0.7, "ls": (0, (1.0, 1.2))}


def band(axes: Axes, low: float, high: float) -> None:
    """Over all the height of the axes, under all that is drawn."""
    axes.axvspan(low, high, color=SHADE, lw=0, zorder=0)
    for edge in (low, high):
        axes.axvline(edge, zorder=0.4, **EDGE)


def band_entry(text: str) -> Entry:
    """For the legend."""

    def draw(axes: Axes, x: float, y: float) -> None:
        axes.add_patch(Rectangle((x, y - 1.3), SWATCH_MM, 2.6, facecolor=SHADE, lw=0))
        for edge in (x, x + SWATCH_MM):
            axes.plot([edge, edge], [y - 1.3, y + 1.3], **EDGE)

    return Entry(text, SWATCH_MM, draw)
