"""The figure of the answer: what landing at the next fix costs, beside what leaving fixes out costs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.accuracy.figures import EVERY_LINES
from reports.accuracy.words import MODELS, ordinal, short_percents
from reports.drawing.axes import AXIS_MM, EDGE_MM, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import FONT_PT, PALE, SMALL_PT, axes_at, drawing, page, text_width_mm
from studies.accuracy.landing import Landing

WIDTH_MM = 110.0
"""Narrower than other figures, so that it is read on a phone too."""
ROW_MM, SHOWN = 7.2, (2, 3)
LEAST, MOST = 0.05, 400.0
LARGER = 1.5
"""Signs, than in other figures."""


def lead_figure(landings: Mapping[str, Landing]) -> Figure:
    """A row for each model: in percent over landing on arrival with every fix, on a logarithmic axis."""
    with drawing():
        legend = [line_entry("every fix, landing at the next one", EVERY_LINES[1], dashes=False)]
        legend += [line_entry(f"{ordinal(n)} fix, on arrival", EVERY_LINES[n], dashes=False) for n in SHOWN]
        left = EDGE_MM + 2.0 + max(text_width_mm(MODELS[name].name) for name in landings)
        height = ROW_MM * len(landings)
        across = WIDTH_MM - 2 * EDGE_MM
        foot = EDGE_MM + height + AXIS_MM
        figure = page(foot + legend_height(legend, across) + EDGE_MM, WIDTH_MM)
        axes = axes_at(figure, left, EDGE_MM, WIDTH_MM - left - EDGE_MM, height)
        axes.set_xscale("log")
        axes.set_xlim(LEAST, MOST)
        axes.xaxis.set_major_locator(FixedLocator([0.1, 1.0, 10.0, 100.0]))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.grid(axis="x", color=PALE, lw=0.5)
        axes.set_ylim(len(landings) - 0.5, -0.7)
        axes.set_yticks(range(len(landings)), [MODELS[name].name for name in landings], size=FONT_PT)
        axes.fmt_ydata = lambda row: MODELS[list(landings)[round(row)]].name
        axes.tick_params(axis="y", length=0)
        plain(axes)
        _signs(axes, 1, [found.waiting for found in landings.values()], "every fix, landing at the next one")
        for n in SHOWN:
            costs = [found.leaving_out(n) for found in landings.values()]
            _signs(axes, n, costs, f"{ordinal(n)} fix, on arrival")
        for row, found in enumerate(landings.values()):
            ends = [100 * found.waiting, 100 * found.leaving_out(SHOWN[-1])]
            axes.plot(ends, [row, row], color=PALE, lw=1.0, zorder=1)
        axes.set_xlabel("worst standard deviation larger by (%, logarithmic)", labelpad=2)
        draw_legend(figure, legend, EDGE_MM, foot, across)
        return figure


def _signs(axes: Axes, n: int, costs: Sequence[float], name: str) -> None:
    line = EVERY_LINES[n]
    axes.plot(
        [100 * cost for cost in costs], range(len(costs)), line.marker, color=line.colour, ms=LARGER * line.size,
        mew=0, ls="None", label=name,
    )  # fmt: skip
    for row, cost in enumerate(costs):
        axes.annotate(
            short_percents(cost), (100 * cost, row), (0, 5), textcoords="offset points", size=SMALL_PT, ha="center"
        )
