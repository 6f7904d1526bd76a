"""How long after a fix each way has the result of its robust step, on one processor, and by when it has to."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.drawing.axes import AXIS_MM, EDGE_MM, decades, plain
from reports.drawing.legend import SWATCH_MM, Entry, draw_legend, legend_height
from reports.drawing.style import INK, SMALL_PT, axes_at, drawing, page, text_width_mm
from reports.erkf.styles import HOLLOW, way_line
from sched_sim.design.pieces import RobustCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import jobs

ACROSS_MM, WAY_MM, BAR_MM, RIGHT_MM, HEAD_MM = 115.0, 7.0, 2.9, 6.0, 6.0
LEAST_MS = 0.1
"""Where bars begin; the axis is logarithmic."""
SAID = {"inverse": "dense inverse"}
"""Of a way that does not skip zeros, as all others here do."""


class Response(NamedTuple):
    """seconds: from the fix to the result of the robust step, with the inertial propagation in between."""

    system: str
    way: str
    seconds: float


def response_s(costs: RobustCosts[Fraction], timing: Timing, hr_hz: int) -> float:
    """Of a robust step that starts at the fix. costs: in seconds.

    Raises:
        ValueError: the step is not done before the next fix.
    """
    schedule = simulate(costs, timing, Fraction(1, hr_hz), 1, keep_slices=True)
    (step,) = (job for job in jobs(schedule) if job.row.name == "LR")
    if step.finish is None:
        raise ValueError("the robust step is not done before the next fix")
    began = step.step * schedule.period
    return (step.finish - began) / (schedule.period * hr_hz)


def ways_figure(responses: Sequence[Response], deadlines_s: Mapping[str, float]) -> Figure:
    """A bar for each way and system, with its time at the end; the deadlines are lines.

    deadlines_s: by what is said of them.
    """
    ways = list(dict.fromkeys(response.way for response in responses))
    systems = list(dict.fromkeys(response.system for response in responses))
    with drawing():
        left = EDGE_MM + 3.0 + max(text_width_mm(SAID.get(way, way)) for way in ways)
        across, height = ACROSS_MM - left - RIGHT_MM, WAY_MM * len(ways)
        legend = [Entry(f"{system} filter", SWATCH_MM, _swatch(system)) for system in systems]
        legend_top = EDGE_MM + HEAD_MM + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM, ACROSS_MM)
        axes = axes_at(figure, left, EDGE_MM + HEAD_MM, across, height)
        decades(axes, "x", LEAST_MS, 2e3 * max(deadlines_s.values()))
        axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes.set(ylim=(height, 0.0), yticks=[])
        for name, seconds in deadlines_s.items():
            axes.axvline(1e3 * seconds, color=INK, lw=0.9, ls=(0, (2, 1.5)), zorder=1)
            axes.annotate(
                f"{name}: {1e3 * seconds:g} ms", (1e3 * seconds, 0), (0, 4), textcoords="offset points", ha="center",
                va="bottom", size=SMALL_PT,
            )  # fmt: skip
        for number, way in enumerate(ways):
            axes.annotate(
                SAID.get(way, way), (0, WAY_MM * (number + 0.5)), (-4, 0), xycoords=axes.get_yaxis_transform(),
                textcoords="offset points", ha="right", va="center",
            )  # fmt: skip
        for response in responses:
            top = WAY_MM * ways.index(response.way) + BAR_MM * (systems.index(response.system) - len(systems) / 2)
            _bar(axes, response, top + WAY_MM / 2)
        axes.fmt_ydata = lambda y: ways[min(int(y / WAY_MM), len(ways) - 1)]
        plain(axes)
        axes.set_xlabel("time from the fix to the result (ms)", labelpad=2)
        draw_legend(figure, legend, left, legend_top, across)
        return figure


def _bar(axes: Axes, response: Response, top: float) -> None:
    line, milliseconds = way_line(response.way), 1e3 * response.seconds
    fill = "white" if HOLLOW[response.system] else line.colour
    axes.barh(
        top + BAR_MM / 2, milliseconds - LEAST_MS, 0.8 * BAR_MM, left=LEAST_MS, facecolor=fill, edgecolor=line.colour,
        lw=0.9, zorder=2,
    )  # fmt: skip
    axes.plot([milliseconds], [top + BAR_MM / 2], color=line.colour, label=response.system)  # for who asks for it
    written = axes.annotate(
        f"{milliseconds:#.3g}", (milliseconds, top + BAR_MM / 2), (3, 0), textcoords="offset points", va="center",
        size=SMALL_PT, zorder=4,
    )  # fmt: skip
    written.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.6})


def _swatch(system: str) -> Callable[[Axes, float, float], None]:
    def draw(axes: Axes, x: float, y: float) -> None:
        fill = "white" if HOLLOW[system] else INK
        axes.barh(y, SWATCH_MM, 2.4, left=x, facecolor=fill, edgecolor=INK, lw=0.9)

    return draw
