"""Numbers of several sources beside one another: what each job costs, and Table 4. Takes the numbers as they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import (
    FONT_PT,
    PALE,
    SOURCE_LINES,
    TITLE_PT,
    WIDTH_MM,
    axes_at,
    drawing,
    page,
    text_width_mm,
)
from sched_sim.costs.methods import KINDS
from sched_sim.costs.table import CostTable
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError

ROW_MM, TITLE_MM, AXIS_MM, GAP_MM, EDGE_MM, RIGHT_MM = 4.6, 6.0, 10.5, 6.0, 2.0, 5.0
SPEED_UNIT = "standard steps per HR period"
NARROWEST = 0.15
"""An axis shows at least this share of its numbers to either side, so that alike numbers look alike."""

KIND_NAMES = {
    "propagate": "propagate",
    "propagate_accumulate": "propagate, accumulate $\\Phi$",
    "update": "update",
    "gain": "gain and covariance, at $k$",
    "correct": "correct the state, at $m$",
    "compensate": "correct one in flight, at $m$",
    "replay": "replay one step",
    "hr_propagate": "HR propagate",
    "hr_propagate_sum": "HR propagate, $Q'$",
    "hr_propagate_euler": "HR propagate, $Q''$",
    "hr_restart": "HR propagate at $k+1$",
    "hr_update": "HR update",
    "lr_propagate": "LR propagate",
    "lr_propagate_euler": "LR propagate, $Q''$",
    "lr_update": "LR update",
    "lr_gain": "LR update: gain part",
    "lr_correct": "LR update: correction part",
    "start": "start, at $k$",
    "carry": "carry one step",
    "land": "land, at $m$",
    "couple": "couple, at $k$",
    "predict": "predict the state",
    "propagate_covariance": "propagate the covariance",
    "pull": "output error",
    "shift_output": "shift one output",
    "predict_0": "predict, 0 delayed states",
    "predict_1": "predict, 1 delayed state",
    "update_0": "update, 0 delayed states",
    "update_1": "update, 1 delayed state",
    "update_2": "update, 2 delayed states",
    "state_update": "state update",
    "covariance_gain": "covariance and gain",
    "inertial": "inertial propagation",
    "robust_step": "robust step",
}


class Speeds(NamedTuple):
    """One cell of Table 4: the least speed of a method in a design, by each source that has it ("paper", ...)."""

    timing: Timing
    method: str
    by_source: Mapping[str, float]


def cost_figure(tables: Mapping[str, CostTable]) -> Figure:
    """What each job costs by each table, the standard filter's propagate + update being 1; one row for each job that
    at least two tables have (all jobs, if there is one table). A line goes from the minimum to the 95th percentile.

    tables: by the names that the legend gives them, at most five.
    Raises InputError for more tables, and for one without the standard filter's costs.
    """
    _check(list(tables))
    normalised = {name: table.normalised() for name, table in tables.items()}
    shown = [
        (method, kind)
        for method, kinds in KINDS.items()
        for kind in kinds
        if sum(kind in table.costs.get(method, {}) for table in normalised.values()) >= min(2, len(tables))
    ]
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(KIND_NAMES[kind]) for _, kind in shown)
        width = WIDTH_MM - left - RIGHT_MM
        methods = list(dict.fromkeys(method for method, _ in shown))
        height = ROW_MM * (len(shown) + len(methods))
        legend = [line_entry(name, line, dashes=False) for name, line in zip(tables, SOURCE_LINES, strict=False)]
        figure = page(EDGE_MM + height + AXIS_MM + legend_height(legend, width) + EDGE_MM)
        axes = axes_at(figure, left, EDGE_MM, width, height)
        y, rows = 0, {}
        for method in methods:
            axes.text(0.0, y, f" {METHOD_NAMES[method]}", size=FONT_PT, weight="bold", va="center")
            y += 1
            for kind in [kind for of_method, kind in shown if of_method == method]:
                rows[y] = f"{METHOD_NAMES[method]}, {KIND_NAMES[kind]}"
                _row_name(axes, y, KIND_NAMES[kind])
                for number, (name, table) in enumerate(normalised.items()):
                    cost = table.costs.get(method, {}).get(kind)
                    if cost is not None:
                        _dot(axes, float(cost.minimum), y, name, number, len(tables), until=float(cost.p95))
                y += 1
        axes.fmt_ydata = lambda at: rows[round(at)]
        axes.set(xlim=(0, axes.get_xlim()[1]), ylim=(y - 0.5, -0.5), yticks=[])
        _finish(axes, "cost (standard filter's propagate + update = 1)")
        draw_legend(figure, legend, left, EDGE_MM + height + AXIS_MM, width)
        return figure


def table4_figure(cells: Sequence[Speeds]) -> Figure:
    """Table 4 as dots: a row for each design, a plot for each method, a sign for each source.

    At most five sources. Raises InputError for more.
    """
    sources = list(dict.fromkeys(source for cell in cells for source in cell.by_source))
    _check(sources)
    designs = list(dict.fromkeys(cell.timing for cell in cells))
    methods = list(dict.fromkeys(cell.method for cell in cells))
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(_design(timing)) for timing in designs)
        across = WIDTH_MM - left - RIGHT_MM
        width = (across - GAP_MM * (len(methods) - 1)) / len(methods)
        height = 1.3 * ROW_MM * len(designs)
        legend = [line_entry(name, line, dashes=False) for name, line in zip(sources, SOURCE_LINES, strict=False)]
        legend_top = EDGE_MM + TITLE_MM + height + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        for column, method in enumerate(methods):
            axes = axes_at(figure, left + column * (width + GAP_MM), EDGE_MM + TITLE_MM, width, height)
            axes.set_title(METHOD_NAMES[method], loc="left", size=TITLE_PT, weight="bold")
            for y, timing in enumerate(designs):
                _row_name(axes, y, _design(timing) if column == 0 else "")
                row_speeds = [cell.by_source for cell in cells if (cell.timing, cell.method) == (timing, method)]
                for by_source in row_speeds:
                    for source, speed in by_source.items():
                        _dot(axes, speed, y, source, sources.index(source), len(sources))
            axes.fmt_ydata = lambda at: _design(designs[round(at)])
            speeds = [speed for cell in cells if cell.method == method for speed in cell.by_source.values()]
            low, high = min(speeds), max(speeds)
            room = max(0.06 * (high - low), NARROWEST * low)
            axes.set(xlim=(low - room, high + room), ylim=(len(designs) - 0.5, -0.5), yticks=[])
            _finish(axes, f"least speed ({SPEED_UNIT})" if column == len(methods) // 2 else "")
        draw_legend(figure, legend, left, legend_top, across)
        return figure


def _check(sources: Sequence[str]) -> None:
    if not 1 <= len(sources) <= len(SOURCE_LINES):
        raise InputError(
            f"{len(sources)} sources of numbers ({', '.join(sources)}): give 1 to {len(SOURCE_LINES)}, so that each "
            f"has a sign of its own"
        )


def _design(timing: Timing) -> str:
    return f"$N={timing.N}$, $M={timing.M}$, $L={timing.L}$"


def _row_name(axes: Axes, y: float, name: str) -> None:
    axes.axhline(y, color=PALE, lw=0.5, zorder=0.5)
    axes.annotate(
        name, (0, y), (-4, 0), xycoords=axes.get_yaxis_transform(), textcoords="offset points", ha="right", va="center"
    )


def _dot(
    axes: Axes, value: float, y: float, source: str, number: int, count: int, *, until: float | None = None
) -> None:
    """The sign of a source, whose number it is, a little above or below the others of its row."""
    line = SOURCE_LINES[number]
    at = y + 0.62 * ((number + 0.5) / count - 0.5)
    if until is not None and until > value:
        axes.plot([value, until], [at, at], color=line.colour, lw=0.8, zorder=2)
    axes.plot(
        [value],
        [at],
        line.marker,
        color=line.colour,
        ms=line.size,
        mew=1.3 if line.marker == "|" else 0,
        zorder=3,
        label=source,
    )


def _finish(axes: Axes, label: str) -> None:
    axes.spines[["left", "right", "top"]].set_visible(False)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=7, steps=[1, 2, 5, 10]))
    axes.set_xlabel(label, labelpad=2)
