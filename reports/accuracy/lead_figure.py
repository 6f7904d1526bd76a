"""The figure of the answer: what landing at the next fix costs, beside what leaving fixes out costs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.accuracy.figures import EVERY_LINES
from reports.accuracy.words import MODELS, ordinal, percents
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import FONT_PT, PALE, SMALL_PT, drawing
from studies.accuracy.landing import Landing

ROW_MM, SHOWN = 9.5, (2, 3)
LEAST, MOST = 0.05, 400.0
LEFT_OUT = 0.13
"""The axis begins so far to the right, for the names: a share of the width."""


def lead_figure(landings: Mapping[str, Landing]) -> Figure:
    """A row for each model: in percent over landing on arrival with every fix, on a logarithmic axis."""
    with drawing():
        legend = [line_entry("every fix, landing at the next one", EVERY_LINES[1], dashes=False)]
        legend += [line_entry(f"{ordinal(n)} fix, on arrival", EVERY_LINES[n], dashes=False) for n in SHOWN]
        figure, [[axes]] = sheet(1, 1, legend, height_mm=ROW_MM * len(landings))
        box = axes.get_position()
        axes.set_position((box.x0 + LEFT_OUT * box.width, box.y0, (1 - LEFT_OUT) * box.width, box.height))
        axes.grid(visible=False, axis="y")
        axes.set_xscale("log")
        axes.set_xlim(LEAST, MOST)
        axes.xaxis.set_major_locator(FixedLocator([0.1, 1.0, 10.0, 100.0]))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.grid(axis="x", color=PALE, lw=0.5)
        axes.set_ylim(len(landings) - 0.4, -0.6)
        axes.set_yticks(range(len(landings)), [MODELS[name].name for name in landings], size=FONT_PT)
        axes.fmt_ydata = lambda row: MODELS[list(landings)[round(row)]].name
        axes.tick_params(axis="y", length=0)
        _signs(axes, 1, [found.waiting for found in landings.values()], "landing at the next fix")
        for n in SHOWN:
            costs = [found.leaving_out(n) for found in landings.values()]
            _signs(axes, n, costs, f"{ordinal(n)} fix, on arrival")
        for row, found in enumerate(landings.values()):
            ends = [100 * found.waiting, 100 * found.leaving_out(SHOWN[-1])]
            axes.plot(ends, [row, row], color=PALE, lw=1.0, zorder=1)
        label(
            axes,
            "Every fix, later, against fewer fixes on arrival",
            "worst standard deviation above that of every fix, landing on arrival (%)",
        )
        return figure


def _signs(axes: Axes, n: int, costs: Sequence[float], name: str) -> None:
    line = EVERY_LINES[n]
    axes.plot(
        [100 * cost for cost in costs], range(len(costs)), line.marker, color=line.colour, ms=1.5 * line.size, mew=0,
        ls="None", label=name,
    )  # fmt: skip
    for row, cost in enumerate(costs):
        axes.annotate(
            f"{percents(cost)}", (100 * cost, row), (0, 5), textcoords="offset points", size=SMALL_PT, ha="center"
        )
