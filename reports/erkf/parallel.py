"""How the time of a Givens triangularisation falls with the number of processors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, decades, end_labels, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import GREY, TITLE_PT, WIDTH_MM, Line, axes_at, drawing, page
from reports.erkf.styles import WAYS

LEFT_MM, RIGHT_MM, GAP_MM, PLOT_MM = 18.0, 10.0, 24.0, 56.0
LINES = (Line(GREY, (0, (1.0, 1.2)), "<"), Line("#2f7fb8", (0, (4.0, 1.5)), ">"), WAYS["Givens"])
"""The last schedule is that of Givens rotations as they are counted elsewhere."""


def parallel_figure(times: Mapping[str, Mapping[str, Mapping[int, int]]]) -> Figure:
    """A plot for each system: its time in units against the processors P, a curve for each schedule, at most three.

    times: by system, schedule and P. At the right end of each curve stands its speed-up there.
    """
    schedules = list(dict.fromkeys(name for of_system in times.values() for name in of_system))
    lines = dict(zip(schedules, LINES, strict=False))
    longest = max(max(curve.values()) for of_system in times.values() for curve in of_system.values())
    shortest = min(min(curve.values()) for of_system in times.values() for curve in of_system.values())
    with drawing():
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        width = (across - GAP_MM * (len(times) - 1)) / len(times)
        legend = [line_entry(name, line) for name, line in lines.items()]
        legend_top = EDGE_MM + TITLE_MM + PLOT_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        for column, (system, curves) in enumerate(times.items()):
            axes = axes_at(figure, LEFT_MM + column * (width + GAP_MM), EDGE_MM + TITLE_MM, width, PLOT_MM)
            for name, curve in curves.items():
                line = lines[name]
                axes.plot(
                    list(curve), list(curve.values()), line.marker, color=line.colour, ms=line.size, mew=0,
                    ls=line.dashes, lw=1.0, label=name,
                )  # fmt: skip
            decades(axes, "y", shortest / 1.5, longest * 1.5)
            _processors(axes, sorted({P for curve in curves.values() for P in curve}))
            end_labels(
                axes,
                [list(curve.values())[-1] for curve in curves.values()],
                [f"{max(curve.values()) / min(curve.values()):.0f}×" for curve in curves.values()],
                PLOT_MM,
            )
            axes.set_title(system, loc="left", size=TITLE_PT)
            plain(axes)
            if column == 0:
                axes.set_ylabel("time (column-pair updates)", labelpad=2)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def _processors(axes: Axes, numbers: Sequence[int]) -> None:
    axes.set_xscale("log", base=2)
    axes.set_xlim(numbers[0] / 1.3, numbers[-1] * 1.3)
    axis = axes.xaxis
    axis.set_major_locator(FixedLocator(list(numbers)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0f}"))
    axes.set_xlabel("processors P", labelpad=2)
