"""How the robust step is scheduled: its least speed against L, and Gantt charts of each way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from reports.charts.panels import Panel, busy
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, decades, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import TITLE_PT, WIDTH_MM, axes_at, drawing, page
from reports.erkf.styles import WAYS
from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.pieces import RobustCosts, StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing

LEFT_MM, RIGHT_MM, GAP_MM, PLOT_MM = 15.0, 4.0, 16.0, 56.0
IN_ONE = {"P": "IP", "U": "RS"}


def speed_figure(costs: Mapping[str, Mapping[str, RobustCosts[Fraction]]], N: int, hr_hz: int) -> Figure:
    """A plot for each system: millions of operations a second against L, a curve for each way.

    costs: in operations, by system and way. At the left end, L = 1, a curve is at what the whole step in one HR
    period needs.
    """
    ways = list(dict.fromkeys(way for of_system in costs.values() for way in of_system))
    lines = {way: WAYS[way] for way in ways}
    speeds = {
        (system, way): [millions(least_speed(of_way, Timing(N, 0, L)).speed, hr_hz) for L in range(1, N + 1)]
        for system, of_system in costs.items()
        for way, of_way in of_system.items()
    }
    with drawing():
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        width = (across - GAP_MM * (len(costs) - 1)) / len(costs)
        legend = [line_entry(way, line) for way, line in lines.items()]
        legend_top = EDGE_MM + TITLE_MM + PLOT_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        for column, (system, of_system) in enumerate(costs.items()):
            axes = axes_at(figure, LEFT_MM + column * (width + GAP_MM), EDGE_MM + TITLE_MM, width, PLOT_MM)
            for way in of_system:
                line = lines[way]
                axes.plot(
                    range(1, N + 1), speeds[system, way], line.marker, color=line.colour, ms=0.75 * line.size, mew=0,
                    ls=line.dashes, lw=0.8, markevery=3, label=way,
                )  # fmt: skip
            every = [speed for of_curve in speeds.values() for speed in of_curve]
            decades(axes, "y", min(every) / 1.6, 1.6 * max(every))
            axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
            axes.set_xlim(0, N + 1)
            axes.xaxis.set_major_locator(FixedLocator([1, *range(N // 8, N + 1, N // 8)]))
            axes.xaxis.set_minor_locator(NullLocator())
            axes.set_xlabel("$L$: steps until the result must be in use", labelpad=2)
            axes.set_title(system, loc="left", size=TITLE_PT)
            plain(axes)
            if column == 0:
                axes.set_ylabel(f"million operations a second at {hr_hz} Hz", labelpad=2)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def millions(speed: Fraction, hr_hz: int) -> float:
    """Operations per HR period as millions a second."""
    return float(speed * hr_hz / 10**6)


def two_rates(
    costs: RobustCosts[Fraction], timing: Timing, speed: Fraction, title: str, pace: str, cycles: int = 1
) -> Panel:
    """The robust step in what the inertial propagation leaves of L steps. pace: what the title says of the speed."""
    schedule = simulate(costs, timing, speed, cycles, keep_slices=True)
    landed = achieved_l(costs, timing, speed)
    lands = "no result lands" if landed is None else f"lands at $l = k+{landed}$"
    return Panel(
        title=title,
        schedule=schedule,
        notes=[pace, lands, busy(schedule.utilization)],
        marks=cycle_marks(timing, cycles, {} if landed is None else {0: landed}, arrives=False),
    )


def one_period(costs: RobustCosts[Fraction], N: int, speed: Fraction, title: str, pace: str, cycles: int = 1) -> Panel:
    """The robust step as part of the HR job of every N-th step, so that the next ones wait for it."""
    whole = StandardCosts(costs.inertial, costs.robust_step)
    schedule = simulate(whole, Timing(N, 0, N), speed, cycles, keep_slices=True)
    renamed = tuple(
        piece._replace(parts=tuple((IN_ONE[label], work) for label, work in piece.parts)) for piece in schedule.slices
    )
    return Panel(
        title=title,
        schedule=replace(schedule, slices=renamed),
        notes=[pace, busy(schedule.utilization)],
        marks=cycle_marks(Timing(N, 0, N), cycles, {}, arrives=False),
    )
