"""Plots for the designer: the least speed for each L asked for, and the L achieved at each speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import log

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.placing import spread
from reports.drawing.style import GREY, INK, METHOD_LINES, PALE, SMALL_PT, TITLE_PT, WIDTH_MM, axes_at, drawing, page
from reports.steffes.curves import achieved_curve, hr_limit, knee, speed_grid
from reports.steffes.signs import OUTLINE
from reports.steffes.speeds import SPEED_UNIT, speed_ticks
from sched_sim.costs.methods import PAPER_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import Stair, staircase
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts

Design = tuple[int, int]
"""(N, M)."""

LEFT_MM, RIGHT_MM, GAP_MM, TITLE_MM, PLOT_MM, AXIS_MM, EDGE_MM = 13.0, 11.0, 21.0, 6.0, 56.0, 12.0, 2.0
CURVE_POINTS = 400
MARKER_PT = 3.5


def least_speed_figure(
    table: CostTable, designs: Sequence[Design] = ((10, 4), (100, 10)), options: Options = Options()
) -> Figure:
    """The least speed of every method against the L asked for; one plot for each (N, M), at most two.

    Costs are normalised as in the paper: the standard filter's propagate + update is 1. Where a longer wait buys
    nothing any more, the plot says at which L the correction lands already.
    Raises InputError if `table` lacks an entry that a method needs.
    """
    table = table.normalised()
    flights = {design: _flights(table, design, options) for design in designs}
    limits = _limits(flights, below=0.58)
    with drawing():
        figure, plots = _sheet(designs)
        for axes, design in zip(plots, designs, strict=True):
            N, M = design
            margin = max(0.03 * (N - M), 0.25) if N > M else 1.1
            axes.set(xlim=(M - margin, N + margin), ylim=limits)
            axes.set_xlabel("$L$ asked for (high-rate steps after $k$)", labelpad=2)
            axes.xaxis.set_major_locator(MaxNLocator(nbins=7, integer=True))
            speed_ticks(axes, "y", limits)
            levels = []
            for method, stairs in flights[design].items():
                line = METHOD_LINES[method]
                if method == "dual-rate":
                    _dual_rate_stairs(axes, stairs)
                    _mark_knee(axes, stairs)
                else:
                    levels.append(float(stairs[0].speed))
                    axes.axhline(levels[-1], color=line.colour, ls=line.dashes, lw=1.2, label=METHOD_NAMES[method])
                    axes.plot([M], levels[-1:], line.marker, color=line.colour, ms=MARKER_PT)
            _level_numbers(axes, sorted(levels), limits)
        plots[0].set_ylabel(f"least speed ({SPEED_UNIT})", labelpad=2)
        return figure


def achieved_figure(
    table: CostTable, designs: Sequence[Design] = ((10, 4), (100, 10)), options: Options = Options()
) -> Figure:
    """The L at which corrections land against the speed, for every method; one plot for each (N, M), at most two.

    A curve begins at the least speed at which anything lands. Where the dual-rate filter's HR loop overruns, the plot
    is hatched. Raises InputError if `table` lacks an entry that a method needs.
    """
    table = table.normalised()
    flights = {design: _flights(table, design, options) for design in designs}
    slowest, fastest = _limits(flights, below=0.75)
    with drawing():
        figure, plots = _sheet(designs)
        for axes, (N, M) in zip(plots, designs, strict=True):
            latest = 0
            for method, stairs in flights[N, M].items():
                costs, line = select(table, method, options), METHOD_LINES[method]
                speeds = speed_grid(slowest, fastest, CURVE_POINTS, [stair.speed for stair in stairs])
                curve = achieved_curve(costs, N, M, speeds, options)
                points = [(float(speed), L) for speed, L in zip(speeds, curve, strict=True) if L is not None]
                if not points:
                    continue
                across, up = [speed for speed, _ in points], [L for _, L in points]
                axes.step(
                    across, up, where="post", color=line.colour, ls=line.dashes, lw=1.2, label=METHOD_NAMES[method]
                )
                axes.plot(across[:1], up[:1], line.marker, color=line.colour, ms=MARKER_PT, zorder=3)
                latest = max(latest, *up)
                if isinstance(costs, DualRateCosts):
                    note = f"{across[0]:.3g}: L = {up[0]}"
                    label = axes.annotate(note, (across[0], up[0]), (5, 2), textcoords="offset points", size=SMALL_PT)
                    label.set_path_effects(OUTLINE)
                    _hatch_overrun(axes, slowest, float(hr_limit(costs, N, options)))
            axes.set(xlim=(slowest, fastest), ylim=(-0.05 * latest, 1.12 * latest))
            axes.yaxis.set_major_locator(MaxNLocator(nbins=7, integer=True))
            axes.grid(axis="y", color=PALE, lw=0.5)
            speed_ticks(axes, "x", (slowest, fastest))
            axes.set_xlabel(f"speed ({SPEED_UNIT})", labelpad=2)
        plots[0].set_ylabel("lands at $L$ (high-rate steps after $k$)", labelpad=2)
        return figure


def _flights(table: CostTable, design: Design, options: Options) -> Mapping[str, Sequence[Stair]]:
    possible = [name for name in PAPER_METHODS if METHODS[name].law(options.feedback).why_none(*design) is None]
    return {
        name: staircase(select(table, name, options), *design, options) if name in possible else []
        for name in PAPER_METHODS
    }


def _limits(flights: Mapping[Design, Mapping[str, Sequence[Stair]]], below: float) -> tuple[float, float]:
    """The speeds at the ends of the axis; below: how far it goes on under the least of them, as a factor."""
    speeds = [float(stair.speed) for of_design in flights.values() for stairs in of_design.values() for stair in stairs]
    return below * min(speeds), 1.2 * max(speeds)


def _sheet(designs: Sequence[Design]) -> tuple[Figure, list[Axes]]:
    """A page with a plot for each design side by side, and the methods' legend below."""
    legend = [line_entry(METHOD_NAMES[method], METHOD_LINES[method]) for method in PAPER_METHODS]
    across = WIDTH_MM - LEFT_MM - RIGHT_MM
    width = (across - GAP_MM * (len(designs) - 1)) / len(designs)
    legend_top = EDGE_MM + TITLE_MM + PLOT_MM + AXIS_MM
    figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
    plots = []
    for number, (N, M) in enumerate(designs):
        axes = axes_at(figure, LEFT_MM + number * (width + GAP_MM), EDGE_MM + TITLE_MM, width, PLOT_MM)
        axes.set_title(f"$N = {N}$, $M = {M}$", loc="left", size=TITLE_PT)
        axes.spines[["right", "top"]].set_visible(False)
        plots.append(axes)
    draw_legend(figure, legend, LEFT_MM, legend_top, across)
    return figure, plots


def _dual_rate_stairs(axes: Axes, stairs: Sequence[Stair]) -> None:
    line = METHOD_LINES["dual-rate"]
    asked, speeds = [stair.L for stair in stairs], [float(stair.speed) for stair in stairs]
    size = MARKER_PT if len(stairs) <= 30 else 1.8
    axes.plot(
        asked, speeds, marker=line.marker, ls="-", lw=0.6, color=line.colour, ms=size, mew=0, zorder=3,
        label=METHOD_NAMES["dual-rate"],
    )  # fmt: skip


def _level_numbers(axes: Axes, levels: Sequence[float], limits: tuple[float, float]) -> None:
    """The constant speeds in numbers, at the right end of their lines."""
    mm_per_log = PLOT_MM / log(limits[1] / limits[0])
    wished = [log(level / limits[0]) * mm_per_log for level in levels]
    for level, at in zip(levels, spread(wished, [2.6] * len(levels), 0.0, PLOT_MM, 0.4), strict=True):
        axes.text(1.015, at / PLOT_MM, f"{level:.3g}", transform=axes.transAxes, va="center", size=SMALL_PT)


def _mark_knee(axes: Axes, stairs: Sequence[Stair]) -> None:
    stair = knee(stairs)
    if stair is None:
        return
    speed, foot = float(stair.speed), axes.get_ylim()[0]
    axes.axvspan(stair.achieved, stair.latest, facecolor=METHOD_LINES["dual-rate"].colour, alpha=0.08, lw=0, zorder=0.2)
    axes.plot([stair.achieved] * 2, [foot, speed], color=INK, lw=0.7, ls=(0, (2, 1.5)), zorder=2)
    axes.plot([stair.achieved], [speed], "o", ms=6.5, mfc="none", mec=INK, mew=0.9, zorder=4)
    first, last = axes.get_xlim()
    left_half = stair.achieved < (first + last) / 2
    note = axes.annotate(
        f"{speed:.3g} already lands at L = {stair.achieved};\nwaiting longer buys nothing",
        (stair.achieved, speed),
        (10 if left_half else -10, -7),
        textcoords="offset points",
        ha="left" if left_half else "right",
        va="top",
        size=SMALL_PT,
        arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 3.5, "shrinkA": 0, "relpos": (0 if left_half else 1, 1)},
        zorder=5,
    )
    note.set_path_effects(OUTLINE)


def _hatch_overrun(axes: Axes, slowest: float, limit: float) -> None:
    if limit < 1.1 * slowest:
        return
    axes.axvspan(slowest, limit, facecolor="none", edgecolor=GREY, hatch="////", lw=0, zorder=0.5)
    axes.axvline(limit, color=GREY, lw=0.7, zorder=0.6)
    middle = (slowest * limit) ** 0.5
    label = axes.text(
        middle,
        0.5,
        "dual-rate HR loop overruns",
        transform=axes.get_xaxis_transform(),
        rotation=90,
        ha="center",
        va="center",
        size=SMALL_PT,
    )
    label.set_path_effects(OUTLINE)
