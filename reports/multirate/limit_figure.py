"""What many measurements tend to: Eqs. (4) to (6) of the patent."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, SMALL_PT, drawing
from reports.multirate.styles import OPTIMAL, READING_LINES
from reports.multirate.words import EACH_GAIN, READING_NAMES
from studies.multirate.limit import Tending

PLOT_MM = 58.0
NAMES = (EACH_GAIN, READING_NAMES["averaged"], READING_NAMES["sampled"])


def limit_figure(more: Sequence[Tending], faster: Sequence[Tending]) -> Figure:
    """Gains per second over that of the continuous filter. Left, against n with one interval between gains; right,
    against the rate of measurements with one n."""
    with drawing():
        lines = (OPTIMAL, READING_LINES["averaged"], READING_LINES["sampled"])
        legend = [line_entry(name, line) for name, line in zip(NAMES, lines, strict=True)]
        figure, [[left, right]] = sheet(1, 2, legend, height_mm=PLOT_MM)
        for axes, rows, places in (
            (left, more, [float(row.n) for row in more]),
            (right, faster, [1 / row.period_s for row in faster]),
        ):
            columns = ([row.optimal for row in rows], [row.averaged for row in rows], [row.sampled for row in rows])
            for name, line, column in zip(NAMES, lines, columns, strict=True):
                axes.plot(
                    places, column, line.marker, color=line.colour, ls=line.dashes, ms=line.size, lw=1.1,
                    mew=0, label=name,
                )  # fmt: skip
            _across(axes, places)
            axes.set_ylim(0, 1.12)
            axes.axhline(1, color=INK, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
            axes.annotate(
                "continuous filter", (places[0], 1), (0, 2), textcoords="offset points", size=SMALL_PT, va="bottom"
            )
        up = "gain per second over the continuous one"
        label(left, f"More measurements in {more[0].n * more[0].period_s:g} s", "$n$ (measurements for each gain)", up)
        label(right, f"Faster measurements, $n$ = {faster[0].n}", "measurements per second")
        return figure


def _across(axes: Axes, places: Sequence[float]) -> None:
    axes.set_xscale("log")
    axes.set_xlim(places[0] / 1.15, places[-1] * 1.15)
    axes.xaxis.set_major_locator(FixedLocator(places))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
