"""Figures on what the multirate gain costs: its load against n, and its schedule beside that of one loop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.charts.panels import Panel, method_panel
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import INK, PALE, SMALL_PT, SOURCE_LINES, WIDTH_MM, Line, axes_at, drawing, page
from sched_sim.costs.table import CostTable
from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.load import utilization
from sched_sim.design.pieces import MultirateCosts, StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing

EDGE_MM, LEFT_MM, RIGHT_MM, PLOT_MM, AXIS_MM = 2.0, 13.0, 15.0, 64.0, 11.0
NUMBERS = (0.5, 1, 2, 3, 4, 5, 7, 10, 15, 20, 30, 50, 70, 100)
MARKER_EVERY = 3
ONE_LOOP = {"P": "SU", "U": "CG"}


def load_figure(
    costs: Mapping[str, MultirateCosts[Fraction]], printed: Mapping[int, Sequence[str]], periods: Sequence[int]
) -> Figure:
    """The load at one measurement of all satellites a second against n, with the highest rate that it leaves.

    costs: in seconds, by the names that the legend gives them, at most five; printed: percentages as printed, by n.
    """
    with drawing():
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        legend = [line_entry(name, line) for name, line in zip(costs, SOURCE_LINES, strict=False)]
        legend_top = EDGE_MM + PLOT_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        axes = axes_at(figure, LEFT_MM, EDGE_MM, across, PLOT_MM)
        shares = {
            name: [100 * float(utilization(of_form, Timing(n, 0, n), Fraction(1))) for n in periods]
            for name, of_form in costs.items()
        }
        for number, ((name, percents), line) in enumerate(zip(shares.items(), SOURCE_LINES, strict=False)):
            _curve(axes, periods, percents, line, name, first_marker=number % MARKER_EVERY)
        for n, texts in printed.items():
            for text in texts:
                axes.plot([n], [float(text)], "o", ms=9, mfc="none", mec=INK, mew=0.9, zorder=4)
                note = axes.annotate(
                    f"printed: {text} %", (n, float(text)), (7, 6), textcoords="offset points", size=SMALL_PT
                )
                note.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
        low, high = min(map(min, shares.values())) / 1.2, max(map(max, shares.values())) * 1.35
        axes.set(xlim=(0.3, max(periods) + 0.7))
        axes.set_xlabel("$n$: measurements for each computation of covariance and gain", labelpad=2)
        axes.xaxis.set_major_locator(FixedLocator([n for n in periods if n <= 3 or n % 5 == 0]))
        axes.grid(axis="y", color=PALE, lw=0.5)
        _percent_axis(axes, low, high)
        axes.set_ylabel("load at 1 measurement a second (%)", labelpad=2)
        rates = axes.twinx()
        _percent_axis(rates, low, high, of_rate=True)
        rates.set_ylabel("highest measurement rate (Hz)", labelpad=3)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def _curve(
    axes: Axes, periods: Sequence[int], percents: Sequence[float], line: Line, name: str, first_marker: int
) -> None:
    """With a marker on every third n, each curve on others, as some lie on one another."""
    axes.plot(
        periods,
        percents,
        line.marker,
        color=line.colour,
        ms=line.size,
        mew=1.3 if line.marker == "|" else 0,
        ls=line.dashes,
        lw=1.0,
        label=name,
        markevery=(first_marker, MARKER_EVERY),
    )


def _percent_axis(axes: Axes, low: float, high: float, *, of_rate: bool = False) -> None:
    """Logarithmic, in percent at 1 Hz; of_rate: with the rate that makes it 100 percent as the number."""
    ticks = [100 / number if of_rate else number for number in NUMBERS]
    axes.set_yscale("log")
    axes.set_ylim(low, high)
    axes.yaxis.set_major_locator(FixedLocator([tick for tick in ticks if low <= tick <= high]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 / value if of_rate else value:g}"))
    axes.spines["top"].set_visible(False)


def two_rates_panel(table: CostTable, n: int, hr_hz: Fraction, cycles: int = 2) -> Panel:
    """Covariance and gain in what the state updates leave of n steps.

    table: costs in seconds of the method "multirate".
    """
    return method_panel(table, "multirate", Timing(n, 0, n), 1 / hr_hz, cycles, title="Two rates")


def one_loop_panel(table: CostTable, n: int, hr_hz: Fraction, cycles: int = 2) -> Panel:
    """Covariance and gain as a part of every n-th state update, so that the next ones wait for it."""
    state, covariance = (table.entry("multirate", kind).minimum for kind in ("state_update", "covariance_gain"))
    schedule = simulate(StandardCosts(state, covariance), Timing(n, 0, n), 1 / hr_hz, cycles, keep_slices=True)
    renamed = tuple(
        piece._replace(parts=tuple((ONE_LOOP[label], work) for label, work in piece.parts)) for piece in schedule.slices
    )
    return Panel(
        title="One loop",
        schedule=replace(schedule, slices=renamed),
        notes=[f"HR period {float(1000 / hr_hz):g} ms", f"{100 * float(schedule.utilization):.0f} % busy"],
        marks=cycle_marks(Timing(n, 0, n), cycles, {}, arrives=False),
    )
