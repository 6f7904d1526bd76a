"""Rows of numbers, each with the sign of its source: by the source's name, a dagger behind what was measured."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from matplotlib.patheffects import AbstractPathEffect, withStroke

from reports.drawing.legend import Entry, line_entry
from reports.drawing.style import PALE, SOURCES, Line
from reports.pages.machine import marked
from sched_sim.errors import InputError

OUTLINE: list[AbstractPathEffect] = [withStroke(linewidth=2.5, foreground="white")]
"""Of text that stands on lines."""
MEASURED = "measured"
LINE_MM = 8.0
"""Of a line with its sign, in the legend."""
SHARE = 0.62
"""Of a row's height, over which its signs are spread."""


def check_sources(sources: Sequence[str]) -> None:
    """Raises InputError unless there are some, and each has a sign."""
    if not sources or not set(sources) <= set(SOURCES):
        given = ", ".join(map(repr, sources)) or "none"
        raise InputError(f"sources of numbers {given}: give some of {', '.join(map(repr, SOURCES))}")


def shown(source: str) -> str:
    """Its name as legends and tables have it."""
    return marked(source) if source == MEASURED else source


def source_entries(sources: Sequence[str]) -> list[Entry]:
    """For the legend."""
    return [line_entry(shown(source), SOURCES[source], dashes=False) for source in sources]


def hollow_entry(text: str, line: Line, size: float, *, dashes: bool = True) -> Entry:
    """For the legend: as `line_entry`, with the sign hollow."""
    width = LINE_MM if dashes else max(2.0, size / 72 * 25.4 + 0.6)

    def draw(axes: Axes, x: float, y: float) -> None:
        if dashes:
            axes.plot([x, x + width], [y, y], color=line.colour, ls=line.dashes, lw=1.2)
        axes.plot([x + width / 2], [y], line.marker, mfc="white", mec=line.colour, mew=0.9, ms=size)

    return Entry(text, width, draw)


def row_name(axes: Axes, y: float, name: str) -> None:
    """Left of the axes, with a line through the row."""
    axes.axhline(y, color=PALE, lw=0.5, zorder=0.5)
    axes.annotate(
        name, (0, y), (-4, 0), xycoords=axes.get_yaxis_transform(), textcoords="offset points", ha="right", va="center"
    )


def sign(
    axes: Axes,
    value: float,
    y: float,
    source: str,
    sources: Sequence[str],
    *,
    interval: tuple[float, float] | None = None,
    scale: float = 1.0,
) -> None:
    """A source's sign in its own lane of a row, with a bar over its interval. scale: of the sign."""
    line, lane = SOURCES[source], SHARE / len(sources)
    at = y + lane * (sources.index(source) + 0.5) - SHARE / 2
    if interval is not None and interval[0] < interval[1]:
        low, high = interval
        axes.add_patch(Rectangle((low, at - 0.2 * lane), high - low, 0.4 * lane, facecolor=line.colour, lw=0, zorder=2))
    edge = 1.3 if line.marker == "|" else 0
    axes.plot(
        [value], [at], line.marker, color=line.colour, ms=scale * line.size, mew=edge, zorder=3, label=shown(source)
    )
