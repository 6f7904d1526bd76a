"""What random times make of a scenario: how response times are spread, and in which steps the corrections land."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from reports.lanes import shortened
from reports.style import (
    FILLS,
    PALE,
    RED,
    SMALL_PT,
    TASK_FILLS,
    TITLE_PT,
    WIDTH_MM,
    Fill,
    axes_at,
    drawing,
    page,
    text_width_mm,
)
from sched_sim.composed import correct_kind
from sched_sim.distribution import Distribution
from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_run import JobFigures, Outcome, SensorFigures

LEFT_MM, RIGHT_MM, GAP_MM, EDGE_MM = 11.0, 3.0, 15.0, 2.0
TITLE_MM, NOTE_MM, PLOT_MM, AXIS_MM = 4.6, 4.2, 24.0, 11.0
ROW_MM = TITLE_MM + NOTE_MM + PLOT_MM + AXIS_MM
BINS = 40
FARTHEST_LIMIT = 1.6
"""A deadline is shown if it is no farther than this from the worst, as a factor."""
HEADROOM = 1.2
FEWEST_SHOWN = 7
"""Steps on the axis of achieved l."""
BETWEEN_MM = 4.0


class Cell(NamedTuple):
    """One plot. notes: under the title; missed: in red behind them, "" if nothing is; draw: fills the axes."""

    title: str
    notes: Sequence[str]
    missed: str
    draw: Callable[[Axes], None]


def distributions_figure(scenario: Scenario, outcome: Outcome) -> Figure:
    """A histogram of the response times of each job kind, and bars of the achieved l beside it where it is a
    correction; a red line is a deadline."""
    plain: list[Cell | None] = [_response("predict", scenario, outcome.jobs["predict"], FILLS["PR"], 1.0)]
    for number, task in enumerate(scenario.tasks):
        fill = TASK_FILLS[number % len(TASK_FILLS)]
        kind = f"task:{task.name}"
        plain.append(_response(shortened(task.name), scenario, outcome.jobs[kind], fill, float(task.period)))
    if len(plain) % 2:
        plain.append(None)
    for sensor in scenario.sensors:
        kind = correct_kind(sensor)
        least, most = min(sensor.delays), max(sensor.delays)
        deadline = float(sensor.land_by + 1 - most) if least == most else None
        plain.append(
            _response(f"correct {shortened(sensor.name)}", scenario, outcome.jobs[kind], FILLS["CO"], deadline)
        )
        plain.append(_achieved(sensor, outcome.sensors[sensor.name]))
    width = (WIDTH_MM - LEFT_MM - GAP_MM - RIGHT_MM) / 2
    with drawing():
        figure = page(EDGE_MM + ROW_MM * len(plain) / 2 + EDGE_MM)
        for number, cell in enumerate(plain):
            if cell is None:
                continue
            row, column = divmod(number, 2)
            top = EDGE_MM + row * ROW_MM + TITLE_MM + NOTE_MM
            axes = axes_at(figure, LEFT_MM + column * (width + GAP_MM), top, width, PLOT_MM)
            axes.spines[["right", "top"]].set_visible(False)
            axes.grid(axis="y", color=PALE, lw=0.5)
            axes.yaxis.set_major_locator(MaxNLocator(nbins=4, min_n_ticks=3))
            _write_head(axes, cell, width)
            cell.draw(axes)
            if column == 0:
                axes.set_ylabel("share (%)")
                axes.yaxis.set_label_coords(-8.0 / width, 0.5)
        return figure


def _write_head(axes: Axes, cell: Cell, width_mm: float) -> None:
    """Title and notes above the plot."""
    within = axes.transAxes
    head, foot = 1 + (NOTE_MM + 1) / PLOT_MM, 1 + 1.2 / PLOT_MM
    axes.text(0, head, cell.title, transform=within, size=TITLE_PT, weight="bold", parse_math=False)
    notes = ", ".join(cell.notes)
    axes.text(0, foot, notes, transform=within, size=SMALL_PT)
    if cell.missed:
        at = (text_width_mm(notes, SMALL_PT) + BETWEEN_MM) / width_mm
        axes.text(at, foot, cell.missed, transform=within, size=SMALL_PT, color=RED)


def _deadline(axes: Axes, at: float) -> None:
    """A red line, its name on the side where there is room."""
    axes.axvline(at, color=RED, lw=1.0)
    low, high = axes.get_xlim()
    right = at > (low + high) / 2
    name = axes.annotate(
        "deadline",
        (at, 1),
        (-2.5 if right else 2.5, -2),
        xycoords=axes.get_xaxis_transform(),
        textcoords="offset points",
        ha="right" if right else "left",
        va="top",
        size=SMALL_PT,
        color=RED,
    )
    name.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def _response(title: str, scenario: Scenario, figures: JobFigures, fill: Fill, deadline: float | None) -> Cell:
    """deadline: in HR periods from the release, None if it differs from job to job."""
    unit, scale = ("HR periods", 1.0) if scenario.hr_hz is None else ("ms", float(1000 / scenario.hr_hz))
    values = [scale * response for response in figures.responses]
    limit = None if deadline is None else scale * deadline
    notes = ["no job finished"]
    if values:
        spread = Distribution.of(values)
        notes = [f"median {spread.median:.3g}", f"99 % within {spread.p99:.3g} {unit}"]
    missed = f"{figures.misses} of {figures.decided} missed" if figures.misses else ""

    def draw(axes: Axes) -> None:
        axes.set_xlabel(f"response time ({unit})", labelpad=2)
        worst = max(values, default=scale)
        shown = [limit] if limit is not None and limit <= FARTHEST_LIMIT * worst else []
        end = 1.05 * max(worst, *shown, 1e-9)
        counts, edges = np.histogram(values, bins=BINS, range=(0, end))
        shares = 100 * counts / max(len(values), 1)
        axes.bar(edges[:-1], shares, np.diff(edges), align="edge", color=fill.colour, edgecolor=fill.ink, lw=0.3)
        axes.set(xlim=(0, end), ylim=(0, HEADROOM * max(shares) or 100))
        for at in shown:
            _deadline(axes, at)

    return Cell(title, notes, missed, draw)


def _achieved(sensor: Sensor, figures: SensorFigures) -> Cell:
    landed = figures.achieved.total()
    notes = [f"{landed} of {figures.taken} landed", f"{figures.dropped} dropped"]
    missed = f"{figures.not_landed} not landed" if figures.not_landed else ""

    def draw(axes: Axes) -> None:
        axes.set_xlabel("$l - k$ (high-rate steps)", labelpad=2)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
        steps = sorted(figures.achieved) or [min(sensor.delays)]
        shares = [100 * figures.achieved[step] / max(landed, 1) for step in steps]
        first, last = steps[0], steps[-1]
        axes.bar(steps, shares, 0.8, color=FILLS["CO"].colour, lw=0)
        limit = sensor.land_by + 0.5  # what lands in step k + land_by has met it
        seen = limit <= FARTHEST_LIMIT * last + 1
        last = max(last, sensor.land_by + 1 if seen else last, first + FEWEST_SHOWN)
        axes.set(xlim=(first - 1, last + 1), ylim=(0, HEADROOM * max(shares) or 100))
        if seen:
            _deadline(axes, limit)

    return Cell(f"{shortened(sensor.name)}: achieved l", notes, missed, draw)
