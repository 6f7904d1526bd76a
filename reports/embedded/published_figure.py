"""Published timings over what counts predict."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure

from reports.drawing.axes import AXIS_MM, EDGE_MM, plain
from reports.drawing.band import band, band_entry
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import GREY, INK, PALE, WIDTH_MM, Line, axes_at, drawing, page, text_width_mm
from reports.embedded.signs import beside, numbers_at
from reports.embedded.words import WRITTEN, as_ratio
from reports.pages.numbers import span
from studies.measurement.published_timings import PublishedTiming, Written

ROW_MM, LOW, HIGH, RIGHT_MM = 4.6, 0.05, 25.0, 20.0
LINES: Mapping[Written, Line] = {
    "plain loops": Line(INK, "-", "o", 4.2),
    "with more around it": Line(GREY, "-", "D", 3.8),
    "generic matrix class": Line("#b3382f", "-", "^", 4.4),
    "zeros left out": Line("#6b5b1e", "-", "s", 4.0),
    "left out of both": Line("#7b5fc4", "-", "v", 4.4),
}


def published_figure(timings: Mapping[str, PublishedTiming], within: float) -> Figure:
    """A row for each timing, by its name: published over predicted by counts, on a logarithmic axis, and in numbers
    beside; grouped by how the code is written.

    within: the factor within which plain loops are, which is shaded.
    """
    with drawing():
        left = EDGE_MM + 2.0 + max(map(text_width_mm, timings))
        across = WIDTH_MM - left - RIGHT_MM
        height = ROW_MM * len(timings) + 1.0
        legend = [line_entry(WRITTEN[written], line, dashes=False) for written, line in LINES.items()]
        legend.append(band_entry(f"within a factor of {within:.2g}"))
        figure = page(EDGE_MM + height + AXIS_MM + legend_height(legend, across) + EDGE_MM)
        axes = axes_at(figure, left, EDGE_MM, across, height)
        axes.set(xscale="log", xlim=(LOW, HIGH), ylim=(len(timings) - 0.4, -0.6), yticks=[])
        band(axes, 1 / within, within)
        axes.axvline(1, color=INK, lw=0.7, zorder=0.6)
        for y, (name, timing) in enumerate(grouped(timings)):
            line, ends = LINES[timing.written], [float(ratio) for ratio in timing.ratios]
            axes.axhline(y, color=PALE, lw=0.5, zorder=0.5)
            beside(axes, y, name, left=True)
            axes.plot(ends, [y, y], color=line.colour, lw=1.1, zorder=2)
            axes.plot(ends, [y, y], line.marker, color=line.colour, ms=line.size, mew=0, ls="none", zorder=3)
            beside(axes, y, span(*map(as_ratio, timing.ratios)), left=False)
        numbers_at(axes.xaxis, (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20))
        axes.set_xlabel("published over predicted time (logarithmic); right of 1 the board is slower", labelpad=2)
        plain(axes)
        axes.spines["left"].set_visible(False)
        draw_legend(figure, legend, left, EDGE_MM + height + AXIS_MM, across)
        return figure


def grouped(timings: Mapping[str, PublishedTiming]) -> Sequence[tuple[str, PublishedTiming]]:
    """By how the code is written, in the order of `LINES`."""
    return sorted(timings.items(), key=lambda item: list(LINES).index(item[1].written))
