"""By how much least speeds differ from counted ones, by every source."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.charts.panels import METHOD_NAMES
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.band import band, band_entry
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import INK, PALE, SMALL_PT, TITLE_PT, WIDTH_MM, Line, axes_at, drawing, page, text_width_mm
from reports.embedded.compared import Compared
from reports.embedded.signs import beside, numbers_at
from reports.embedded.words import LINES, SOURCES
from studies.embedded.sources import FIRST

SLOT_MM, BETWEEN_MM, RIGHT_MM, GAP_MM = 1.75, 2.4, 12.0, 15.0
WITHIN = 2
"""Percent: the band in which emulated cores should be."""


def least_speed_figure(found: Sequence[Compared]) -> Figure:
    """A plot for each covariance form, a row for each method, a line of it for each source: by how much its least speed
    is above the counted one. The sign is at `FIRST`, the line goes over all designs; at the right the counted speed."""
    sources = [name for name in LINES if any(one.source == name for one in found)]
    methods = list(dict.fromkeys(one.method for one in found))
    forms = list(dict.fromkeys(one.form for one in found))
    shown = [one for one in found if one.source in sources]
    widest = 5 * ceil(20 * max(abs(one.deviation) for one in shown)) + 1
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(METHOD_NAMES[method]) for method in methods)
        across = WIDTH_MM - left - RIGHT_MM
        width = (across - GAP_MM * (len(forms) - 1)) / len(forms)
        row_mm = SLOT_MM * len(sources) + BETWEEN_MM
        height = row_mm * len(methods)
        legend = [line_entry(SOURCES[name], LINES[name]) for name in sources]
        legend.append(band_entry(f"within {WITHIN} % of counted"))
        top = EDGE_MM + TITLE_MM
        legend_top = top + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        for column, form in enumerate(forms):
            axes = axes_at(figure, left + column * (width + GAP_MM), top, width, height)
            axes.set(xlim=(-widest, widest), ylim=(height, 0), yticks=[])
            band(axes, -WITHIN, WITHIN)
            axes.axvline(0, color=INK, lw=0.7, zorder=0.6)
            for y, method in enumerate(methods):
                of_method = [one for one in shown if (one.form, one.method) == (form, method)]
                if y:
                    axes.axhline(y * row_mm, color=PALE, lw=0.5, zorder=0.5)
                if column == 0:
                    beside(axes, (y + 0.5) * row_mm, METHOD_NAMES[method], left=True)
                beside(axes, (y + 0.5) * row_mm, f"{float(_first(of_method).counted):.2f}", left=False)
                for slot, name in enumerate(sources):
                    at = y * row_mm + BETWEEN_MM / 2 + (slot + 0.5) * SLOT_MM
                    _range(axes, at, [one for one in of_method if one.source == name], SOURCES[name], LINES[name])
            axes.fmt_ydata = lambda at: METHOD_NAMES[methods[int(at / row_mm)]]
            axes.set_title(f"{form} update", loc="left", size=TITLE_PT)
            axes.annotate(
                "counted", (1, 1), (4, 3), xycoords="axes fraction", textcoords="offset points", va="bottom",
                size=SMALL_PT,
            )  # fmt: skip
            axes.set_xlabel("least speed over the counted one (%)", labelpad=2)
            step = 10 if widest < 45 else 20
            numbers_at(axes.xaxis, range(-100 * step, 101 * step, step), signed=True)
            plain(axes)
            axes.spines["left"].set_visible(False)
        draw_legend(figure, legend, left, legend_top, across)
        return figure


def _first(found: Sequence[Compared]) -> Compared:
    return next(one for one in found if one.timing == FIRST)


def _range(axes: Axes, at: float, found: Sequence[Compared], name: str, line: Line) -> None:
    over = [100 * float(one.deviation) for one in found]
    axes.plot([min(over), max(over)], [at, at], color=line.colour, lw=1.1, zorder=2, solid_capstyle="butt")
    sign = 100 * float(_first(found).deviation)
    axes.plot([sign], [at], line.marker, color=line.colour, ms=line.size, mew=0, zorder=3, label=name)
