"""The load of every form of the covariance against n, and how far those that lie on one another are apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, SMALL_PT, Line, drawing
from reports.multirate.styles import FORM_LINES, PRINTED, PRINTED_MARKER, printed_entry
from sched_sim.design.load import utilization
from sched_sim.design.pieces import MultirateCosts
from sched_sim.design.timing import Timing
from studies.multirate.patent import LIMIT_PERCENT

PLOT_MM = 60.0
NUMBERS = (0.5, 1, 2, 5, 10, 20, 50)
MARKED = (1, 2, 3, 4, 5, 7, 10, 14, 20)
NUMBERED = (1, 2, 3, 4, 5, 7, 10, 20)


class Printed(NamedTuple):
    """A load as printed, in percent. note: what is said beside it."""

    n: int
    percent: str
    note: str


def load_figure(
    costs: Mapping[str, MultirateCosts[Fraction]], beside: int, printed: Sequence[Printed], periods: Sequence[int]
) -> Figure:
    """Left, the load at one measurement of all satellites a second against n, with the limit; right, those of the last
    `beside` forms over that of the form before them.

    costs: in seconds, by the names that the legend gives them, at most five.
    """
    with drawing():
        names = list(costs)
        lines = dict(zip(names, FORM_LINES, strict=False))
        legend = [*(line_entry(name, line) for name, line in lines.items()), printed_entry()]
        figure, [[left, right]] = sheet(1, 2, legend, height_mm=PLOT_MM, gap_mm=17.0)
        shares = {
            name: [100 * float(utilization(of_form, Timing(n, 0, n), Fraction(1))) for n in periods]
            for name, of_form in costs.items()
        }
        least = names[-beside - 1]
        for name in names[:-beside]:
            _curve(left, periods, shares[name], lines[name], name)
        for name in names[-beside:]:
            above = [100 * (share / lowest - 1) for share, lowest in zip(shares[name], shares[least], strict=True)]
            _curve(right, periods, above, lines[name], name)
        _percent_axis(left, min(map(min, shares.values())) / 1.2, max(map(max, shares.values())) * 1.35)
        left.axhline(LIMIT_PERCENT, color=INK, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
        _note(left, f"the patent's limit: {LIMIT_PERCENT} %", (periods[-1], LIMIT_PERCENT), (0, 3), "right")
        for point in printed:
            at = (point.n, float(point.percent))
            left.plot(*at, PRINTED_MARKER, color=PRINTED.colour, ms=10, mew=1.6, zorder=4)
            _note(left, f"{point.percent} %{point.note}", at, (-5, -13) if point.note else (7, -3), "left")
        for axes in (left, right):
            axes.set_xscale("log")
            axes.set_xlim(0.88, periods[-1] * 1.12)
            axes.xaxis.set_major_locator(FixedLocator([n for n in periods if n in NUMBERED]))
            axes.xaxis.set_minor_locator(NullLocator())
            axes.xaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:g}"))
        right.set_ylim(0, 1.25 * right.get_ylim()[1])
        right.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]))
        across = "$n$ (steps for each gain)"
        label(left, "Load at one measurement a second", across, "load (%)")
        label(right, f"Load above that of {_short(least)}", across, "load above it (%)")
        return figure


def _short(name: str) -> str:
    return name.partition(", without")[0]


def _curve(axes: Axes, periods: Sequence[int], percents: Sequence[float], line: Line, name: str) -> None:
    axes.plot(
        periods, percents, line.marker, color=line.colour, ms=line.size, mew=0,
        ls=line.dashes, lw=1.1, label=name, markevery=[i for i, n in enumerate(periods) if n in MARKED],
    )  # fmt: skip


def _note(axes: Axes, text: str, at: tuple[float, float], shift: tuple[float, float], side: str) -> None:
    note = axes.annotate(text, at, shift, textcoords="offset points", size=SMALL_PT, ha=side, zorder=5)
    note.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def _percent_axis(axes: Axes, low: float, high: float) -> None:
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    axes.yaxis.set_major_locator(FixedLocator([number for number in NUMBERS if low <= number <= high]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
