"""What each job costs, by several sources beside one another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.legend import draw_legend, legend_height
from reports.drawing.readout import plain_text
from reports.drawing.style import FONT_PT, PALE, WIDTH_MM, axes_at, drawing, page, text_width_mm
from reports.pages.machine import marked
from reports.pages.numbers import span
from reports.pages.stored import Rows
from reports.steffes.signs import MEASURED, check_sources, row_name, shown, sign, source_entries
from sched_sim.costs.methods import KINDS
from sched_sim.costs.table import CostTable
from studies.machines.ranges import Range, range_of

ROW_MM, AXIS_MM, EDGE_MM, RIGHT_MM = 4.6, 10.5, 2.0, 5.0

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


def cost_figure(tables: Mapping[str, CostTable], measured: Sequence[CostTable] = ()) -> Figure:
    """What each job costs by each table, the standard filter's propagate + update being 1; one row for each job that
    at least two tables have (all jobs, if there is one table). Signs are at least costs.

    tables: by their source, of `SOURCES`. measured: all measurements, over whose least costs a bar goes.
    Raises InputError for another source, and for a table without the standard filter's costs.
    """
    sources = list(tables)
    check_sources(sources)
    alike = [table.normalised() for table in measured]
    normalised = {name: table.normalised() for name, table in tables.items()}
    jobs = _shown(normalised)
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(KIND_NAMES[kind]) for _, kind in jobs)
        width = WIDTH_MM - left - RIGHT_MM
        methods = list(dict.fromkeys(method for method, _ in jobs))
        height = ROW_MM * (len(jobs) + len(methods))
        legend = source_entries(sources)
        figure = page(EDGE_MM + height + AXIS_MM + legend_height(legend, width) + EDGE_MM)
        axes = axes_at(figure, left, EDGE_MM, width, height)
        y, rows = 0, {}
        for method in methods:
            axes.text(0.0, y, f" {METHOD_NAMES[method]}", size=FONT_PT, weight="bold", va="center")
            y += 1
            for kind in [kind for of_method, kind in jobs if of_method == method]:
                rows[y] = f"{METHOD_NAMES[method]}, {KIND_NAMES[kind]}"
                row_name(axes, y, KIND_NAMES[kind])
                for source, table in normalised.items():
                    if table.has(method, kind):
                        bar = _over(alike, method, kind) if source == MEASURED and alike else None
                        sign(axes, _least(table, method, kind), y, source, sources, interval=bar)
                y += 1
        axes.fmt_ydata = lambda at: rows[round(at)]
        axes.set(xlim=(0, axes.get_xlim()[1]), ylim=(y - 0.5, -0.5), yticks=[])
        axes.spines[["left", "right", "top"]].set_visible(False)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=7, steps=[1, 2, 5, 10]))
        axes.grid(axis="x", color=PALE, lw=0.5)
        axes.set_xlabel("cost (standard filter's propagate + update = 1)", labelpad=2)
        draw_legend(figure, legend, left, EDGE_MM + height + AXIS_MM, width)
        return figure


def cost_rows(tables: Mapping[str, CostTable], measured: Sequence[CostTable]) -> Rows:
    """What `cost_figure` draws. The last column is the range over all measurements."""
    normalised = {name: table.normalised() for name, table in tables.items()}
    alike = [table.normalised() for table in measured]
    rows: Rows = [["Method", "Job", *map(shown, normalised), marked("all measurements")]]
    for method, kind in _shown(normalised):
        costs = [
            f"{_least(table, method, kind):.3f}" if table.has(method, kind) else "" for table in normalised.values()
        ]
        over = _over(alike, method, kind)
        rows.append(
            [METHOD_NAMES[method], plain_text(KIND_NAMES[kind]), *costs, span(*map("{:.3f}".format, over or ()))]
        )
    return rows


def _shown(tables: Mapping[str, CostTable]) -> list[tuple[str, str]]:
    """The jobs that at least two tables have, by method and kind; all, of one table."""
    return [
        (method, kind)
        for method, kinds in KINDS.items()
        for kind in kinds
        if sum(kind in table.costs.get(method, {}) for table in tables.values()) >= min(2, len(tables))
    ]


def _least(table: CostTable, method: str, kind: str) -> float:
    return float(table.entry(method, kind).minimum)


def _over(measured: Sequence[CostTable], method: str, kind: str) -> Range[float] | None:
    """None where none of them timed that job."""
    timed = [table for table in measured if table.has(method, kind)]
    return range_of(lambda table: _least(table, method, kind), timed) if timed else None
