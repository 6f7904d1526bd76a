"""The figure of the answer: what computing the gain less often saves, and what it costs, both against n."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, MultipleLocator

from reports.drawing.axes import end_labels
from reports.drawing.legend import SWATCH_MM, Entry, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, NARROW_MM, SMALL_PT, WIDTH_MM, drawing
from reports.multirate.ratio_axis import GROUND, LEAST, ratio_axis
from reports.multirate.styles import FORM_LINES, PRINTED, PRINTED_MARKER, VEHICLE_LINES, printed_entry
from reports.pages.numbers import significant
from sched_sim.design.load import utilization
from sched_sim.design.pieces import MultirateCosts
from sched_sim.design.timing import Timing
from studies.multirate.patent import LIMIT_PERCENT

PLOT_MM, RIGHT_MM = 56.0, 19.0
COUNTED = "the patent's counts"
RING_PT = 7.0


def lead_figure(
    costs: MultirateCosts[Fraction],
    printed: Mapping[int, str],
    least_n: int,
    ratios: Mapping[str, Mapping[int, float]],
    *,
    narrow: bool = False,
) -> Figure:
    """The load at one measurement of all satellites a second, and the ratio in steady state; rings at least_n, with
    their numbers. The one left of the other, or above it where it is to be narrow.

    costs: the patent's, in seconds; printed: loads as printed, by n; least_n: from there on the load is within the
    limit; ratios: by vehicle and n, from n = 1 on.
    """
    with drawing():
        legend = [
            line_entry(COUNTED, FORM_LINES[0]),
            printed_entry(),
            Entry(f"the answer's $n$ = {least_n}", SWATCH_MM / 2, _ringed),
        ]
        rows, columns, width_mm = (2, 1, NARROW_MM) if narrow else (1, 2, WIDTH_MM)
        figure, plots = sheet(rows, columns, legend, height_mm=PLOT_MM, right_mm=RIGHT_MM, width_mm=width_mm)
        left, right = (axes for row in plots for axes in row)
        periods = list(next(iter(ratios.values())))
        _load(left, costs, printed, least_n, periods)
        ratio_axis(right, 1.6 * max(max(of.values()) for of in ratios.values()))
        for vehicle, of_vehicle in ratios.items():
            line = VEHICLE_LINES[vehicle]
            losses = {n: ratio - 1 for n, ratio in of_vehicle.items() if ratio - 1 > LEAST}
            right.plot(
                list(losses), list(losses.values()), line.marker, color=line.colour, ls=line.dashes, ms=line.size,
                mew=0, lw=1.1, label=vehicle,
            )  # fmt: skip
            at = of_vehicle[least_n]
            if at - 1 > LEAST:
                _ring(right, least_n, at - 1, f"×{significant(at)}", (5, -4), "top")
        right.set_xlim(left.get_xlim())
        end_labels(right, [of[periods[-1]] - 1 for of in ratios.values()], list(ratios), PLOT_MM)
        label(right, "What it costs: position variance over the optimum", "$n$ (steps for each gain)")
        for axes in (left, right):
            axes.xaxis.set_major_locator(FixedLocator(periods))
        return figure


def _load(
    axes: Axes, costs: MultirateCosts[Fraction], printed: Mapping[int, str], least_n: int, periods: Sequence[int]
) -> None:
    shares = {n: 100 * float(utilization(costs, Timing(n, 0, n), Fraction(1))) for n in periods}
    line = FORM_LINES[0]
    axes.plot(
        list(shares), list(shares.values()), line.marker, color=line.colour, ls=line.dashes, ms=line.size, mew=0,
        lw=1.1, label=COUNTED,
    )  # fmt: skip
    axes.axhline(LIMIT_PERCENT, color=INK, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
    axes.axhspan(0, LIMIT_PERCENT, facecolor=GROUND, lw=0, zorder=0.2)
    for n, text in printed.items():
        axes.plot([n], [float(text)], PRINTED_MARKER, color=PRINTED.colour, ms=10, mew=1.6, zorder=4)
        under = float(text) < LIMIT_PERCENT
        shift, side = ((2, -12), "center") if under else ((7, -3), "left")
        _note(axes, f"{text} %", (n, float(text)), shift, side, GROUND if under else "white")
    _ring(axes, least_n, shares[least_n], f"{shares[least_n]:.2f} %", (2, 6), "bottom")
    axes.set(xlim=(0.5, periods[-1] + 0.5), ylim=(0, 1.1 * max(shares.values())))
    axes.yaxis.set_major_locator(MultipleLocator(5))
    axes.annotate(
        f"the patent allows {LIMIT_PERCENT} %: from n = {least_n} on", (0.5, 0.2), (4, 2), textcoords="offset points",
        size=SMALL_PT,
    )  # fmt: skip
    label(axes, "What it saves: load of the patent's processor", "$n$ (steps for each gain)", "load (%)")


def _note(axes: Axes, text: str, at: tuple[float, float], shift: tuple[float, float], side: str, ground: str) -> None:
    note = axes.annotate(text, at, shift, textcoords="offset points", size=SMALL_PT, ha=side, zorder=5)
    note.set_path_effects([withStroke(linewidth=2.5, foreground=ground)])


def _ring(axes: Axes, n: int, at: float, text: str, shift: tuple[float, float], side: str) -> None:
    axes.plot([n], [at], "o", ms=RING_PT, mfc="none", mec=INK, mew=0.9, zorder=4)
    axes.annotate(text, (n, at), shift, textcoords="offset points", size=SMALL_PT, va=side, zorder=5)


def _ringed(axes: Axes, x: float, y: float) -> None:
    axes.plot([x + SWATCH_MM / 4], [y], "o", ms=RING_PT, mfc="none", mec=INK, mew=0.9)
