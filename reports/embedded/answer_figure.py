"""What counted operations predict, and what they do not: the figure of the answer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.drawing.axes import AXIS_MM, EDGE_MM, plain
from reports.drawing.style import INK, PALE, SOURCES, Line, axes_at, drawing, page, text_width_mm
from reports.embedded.compared import Compared
from reports.embedded.published_figure import LINES as WAYS
from reports.embedded.signs import beside, numbers_at
from reports.embedded.words import CORES, HERE, LINES, as_ratio
from reports.embedded.words import SOURCES as NAMES
from reports.pages.numbers import span
from studies.measurement.published_timings import PublishedTiming, Written

WIDTH_MM = 110.0
"""Narrower than other figures, so that it is read on a phone too."""
ROW_MM, RIGHT_MM, BAR_PT = 4.3, 20.0, 2.0
LOW, HIGH = 0.05, 25.0
WAYS_OF: Mapping[Written, str] = {
    "plain loops": "plain loops",
    "with more around it": "more around the job",
    "generic matrix class": "generic matrix class",
    "zeros left out": "zeros left out",
    "left out of both": "zeros left out of both",
}
"""How code is written, shorter than in tables."""


class Row(NamedTuple):
    """over: all that a source says, over what counts say."""

    name: str
    line: Line
    over: Sequence[Fraction]

    @property
    def ends(self) -> tuple[Fraction, Fraction]:
        return min(self.over), max(self.over)


def rows_of(found: Sequence[Compared], timings: Sequence[PublishedTiming]) -> dict[str, list[Row]]:
    """Below the heading of each half: least speeds by each kind of source, published times by how code is written."""
    by_name = {name: [1 + one.deviation for one in found if one.source == name] for name in (*CORES, *HERE)}
    emulated = [over for name in CORES for over in by_name[name]]
    speeds = [Row("four emulated cores", SOURCES["emulated"], emulated)]
    speeds += [Row(f"{NAMES[name]}, timed here", LINES.get(name, SOURCES["measured"]), by_name[name]) for name in HERE]
    times = [
        Row(name, WAYS[written], [over for timing in timings if timing.written == written for over in timing.ratios])
        for written, name in WAYS_OF.items()
    ]
    return {"Least speed of a filter": [row for row in speeds if row.over], "Time of a job on a board": times}


def answer_figure(halves: Mapping[str, Sequence[Row]]) -> Figure:
    """A bar for each row, from the least to the greatest over what counts say, on one logarithmic axis."""
    every = [row for rows in halves.values() for row in rows]
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(row.name) for row in every)
        across = WIDTH_MM - left - RIGHT_MM
        height = ROW_MM * (len(every) + len(halves))
        figure = page(EDGE_MM + height + AXIS_MM, WIDTH_MM)
        axes = axes_at(figure, left, EDGE_MM, across, height)
        axes.set(xscale="log", xlim=(LOW, HIGH), ylim=(len(every) + len(halves) - 0.5, -0.5), yticks=[])
        axes.axvline(1, color=INK, lw=0.8, zorder=0.6)
        at = 0
        names: dict[int, str] = {}
        for heading, rows in halves.items():
            axes.text(
                (EDGE_MM - left) / across, at, heading, transform=axes.get_yaxis_transform(), weight="bold",
                va="center",
            )  # fmt: skip
            for row in rows:
                at += 1
                names[at] = row.name
                _bar(axes, at, row)
            at += 1
        axes.fmt_ydata = lambda y: names.get(round(y), "")
        axes.grid(axis="x", color=PALE, lw=0.5)
        numbers_at(axes.xaxis, (0.1, 0.2, 0.5, 1, 2, 5, 10, 20))
        axes.set_xlabel("times what counts say (logarithmic)", labelpad=2)
        plain(axes)
        axes.spines["left"].set_visible(False)
        return figure


def _bar(axes: Axes, at: int, row: Row) -> None:
    ends, line = [float(end) for end in row.ends], row.line
    beside(axes, at, row.name, left=True)
    beside(axes, at, span(*map(as_ratio, row.ends)), left=False)
    axes.plot(ends, [at, at], color=line.colour, lw=BAR_PT, zorder=2, solid_capstyle="butt")
    axes.plot(ends, [at, at], line.marker, color=line.colour, ms=1.2 * line.size, mew=0, ls="None", label=row.name)
