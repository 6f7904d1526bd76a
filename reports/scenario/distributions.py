"""What random times make of a scenario: how response times are spread, and in which steps the corrections land."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from reports.charts.lanes import shortened
from reports.drawing.style import (
    FILLS,
    INK,
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
from reports.drawing.tails import tail_axis
from reports.scenario.cells import BINS, Cell, Note
from sched_sim.probability.samples import unseen_mass
from sched_sim.scenario.distribution import finished_or_not
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.outcome import JobFigures, Outcome, SensorFigures
from sched_sim.scenario.scenario import Scenario, Sensor

if TYPE_CHECKING:
    from sched_sim.probability.outcome import Floats
    from studies.probability.beside_sampled import Beside, Exact, Longer
    from studies.selection.in_scenario import ScenarioAccuracy

LEFT_MM, RIGHT_MM, GAP_MM, EDGE_MM = 11.0, 3.0, 15.0, 2.0
TITLE_MM, NOTE_MM, PLOT_MM, AXIS_MM = 4.6, 3.6, 24.0, 11.0
BESIDE_MM = 2.5
"""A note may reach so far into the gap between the plots."""
NEAR = 1.6
"""A deadline is near if an axis that shows it is no longer than this factor times one without it."""
FEWEST_SHOWN = 7
"""Steps on the axis of achieved l."""
FEWEST = 10
"""So many the axis of shares is for, at the least."""
DEEPEST = 1e-12
"""What is exact and rarer is not drawn."""
DASHES = (0, (3, 2))
EDGE = 0.03
"""Left free at both ends of that axis."""


def distributions_figure(
    scenario: Scenario, outcome: Outcome, accuracy: ScenarioAccuracy | None = None, exact: Beside | None = None
) -> Figure:
    """A histogram of the response times of each job kind, and bars of the achieved l beside it where it is a
    correction, on logarithmic axes: what so many do not resolve is shaded, a red line is a deadline. A deadline that is
    too far off for a line is in the subtitle. What is known exactly is dashed, or a circle. With the accuracy,
    histograms of the output's standard deviation, and of the age of each sensor's information."""
    longer, landing = (None, {}) if exact is None else (exact.longer, exact.landing)
    plain: list[Cell | None] = [_response("predict", scenario, outcome.jobs["predict"], FILLS["PR"], 1.0, longer)]
    for number, task in enumerate(scenario.tasks):
        fill = TASK_FILLS[number % len(TASK_FILLS)]
        kind = f"task:{task.name}"
        plain.append(_response(shortened(task.name), scenario, outcome.jobs[kind], fill, float(task.period)))
    if len(plain) % 2:
        plain.append(None)
    for sensor in scenario.sensors:
        kind = correct_kind(sensor)
        least, most = sensor.least_delay, sensor.longest_delay
        deadline = float(scenario.due(sensor) - most) if least == most else None
        plain.append(
            _response(f"correct {shortened(sensor.name)}", scenario, outcome.jobs[kind], FILLS["CO"], deadline)
        )
        plain.append(_achieved(sensor, outcome.sensors[sensor.name], landing))
    if accuracy is not None:
        from reports.scenario.accuracy import accuracy_cells

        plain += accuracy_cells(accuracy)
        if len(plain) % 2:
            plain.append(None)
    width = (WIDTH_MM - LEFT_MM - GAP_MM - RIGHT_MM) / 2
    rows = [plain[number : number + 2] for number in range(0, len(plain), 2)]
    with drawing():
        heads = [TITLE_MM + NOTE_MM * _most_lines(row, width) for row in rows]
        figure = page(EDGE_MM + sum(heads) + (PLOT_MM + AXIS_MM) * len(rows) + EDGE_MM)
        top = EDGE_MM
        for row, head in zip(rows, heads, strict=True):
            top += head
            for column, cell in enumerate(row):
                if cell is not None:
                    axes = axes_at(figure, LEFT_MM + column * (width + GAP_MM), top, width, PLOT_MM)
                    _draw_cell(axes, cell, width)
                    if column == 0:
                        axes.set_ylabel(cell.shares)
                        axes.yaxis.set_label_coords(-8.0 / width, 0.5)
            top += PLOT_MM + AXIS_MM
        return figure


def _most_lines(row: Sequence[Cell | None], width_mm: float) -> int:
    return max(len(_note_lines(cell.notes, width_mm)) for cell in row if cell is not None)


def _draw_cell(axes: Axes, cell: Cell, width_mm: float) -> None:
    axes.spines[["right", "top"]].set_visible(False)
    axes.grid(axis="y", color=PALE, lw=0.5)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=4, min_n_ticks=3))
    within = axes.transAxes
    lines = _note_lines(cell.notes, width_mm)
    at = 1 + (NOTE_MM * len(lines) + 1.6) / PLOT_MM
    axes.text(0, at, cell.title, transform=within, size=TITLE_PT, weight="bold")
    for number, line in enumerate(reversed(lines)):
        for x, note in line:
            at = 1 + (NOTE_MM * number + 1.2) / PLOT_MM
            axes.text(x / width_mm, at, note.text, transform=within, size=SMALL_PT, color=RED if note.missed else INK)
    cell.draw(axes)


def _note_lines(notes: Sequence[Note], width_mm: float) -> list[list[tuple[float, Note]]]:
    """The notes with a comma between them, broken into lines, each with its x in mm."""
    lines: list[list[tuple[float, Note]]] = [[]]
    x = 0.0
    for number, note in enumerate(notes):
        shown = note._replace(text=note.text + ("," if note is not notes[-1] else ""))
        width = text_width_mm(shown.text, SMALL_PT)
        if number and x + width > width_mm + BESIDE_MM:
            lines.append([])
            x = 0.0
        lines[-1].append((x, shown))
        x += width + text_width_mm("n", SMALL_PT) * 0.6
    return lines


def _deadline(axes: Axes, at: float, height: float = 1.0) -> None:
    """A red line, its name at this height of the plot, on the side where there is room."""
    axes.axvline(at, color=RED, lw=1.0, zorder=4)
    low, high = axes.get_xlim()
    right = at > (low + high) / 2
    name = axes.annotate(
        "deadline",
        (at, height),
        (-2.5 if right else 2.5, -2),
        xycoords=axes.get_xaxis_transform(),
        textcoords="offset points",
        ha="right" if right else "left",
        va="top",
        size=SMALL_PT,
        color=RED,
        zorder=5,
    )
    name.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def is_near(limit: float, low: float, high: float) -> bool:
    """Whether the axis of [low, high] is stretched to show a deadline; the one rule of all plots."""
    return max(high, limit) - min(low, limit) <= NEAR * (high - low)


def _response(
    title: str,
    scenario: Scenario,
    figures: JobFigures,
    fill: Fill,
    deadline: float | None,
    exact: Longer | None = None,
) -> Cell:
    """deadline: in HR periods from the release, None if it differs from job to job."""
    unit, scale = ("HR periods", 1.0) if scenario.hr_hz is None else ("ms", float(1000 / scenario.hr_hz))
    values = [scale * response for response in figures.responses]
    worst = max(values, default=scale)
    limit = None if deadline is None else scale * deadline
    near = limit is not None and is_near(limit, 0, worst)
    notes = _response_notes(values, figures, unit)
    if limit is not None and not near:
        notes.append(Note(f"deadline {_short(limit)} {unit}"))
    if figures.misses:
        notes.append(Note(f"{figures.misses} of {figures.decided} missed", missed=True))

    def draw(axes: Axes) -> None:
        dashed = "" if exact is None else ", dashed: exactly"
        axes.set_xlabel(f"response time ({unit}); line: longer{dashed}", labelpad=2)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
        reached = 0.0 if exact is None else scale * _reached(exact)
        end = 1.05 * max(worst, reached, limit if near and limit is not None else 0, 1e-9)
        counts, edges = np.histogram(values, bins=BINS, range=(0, end))
        _tail(axes, len(values), 1.0 if exact is None else _least(exact.exceedance, exact.floor))
        shares = counts / max(len(values), 1)
        axes.bar(edges[:-1], shares, np.diff(edges), align="edge", color=fill.colour, edgecolor=fill.ink, lw=0.3)
        longer = 1 - np.arange(len(values) + 1) / max(len(values), 1)
        axes.step([0.0, *sorted(values)], longer, where="post", color=INK, lw=0.8)
        if exact is not None:
            times = scale * np.arange(len(exact.exceedance) + 1) / exact.ticks
            shown = np.where(exact.exceedance > exact.floor, exact.exceedance, np.nan)
            axes.step(times[:-1], shown, where="post", color=INK, lw=1.0, ls=DASHES, zorder=4)
        axes.set_xlim(0, end)
        if near and limit is not None:
            _deadline(axes, limit)

    return Cell(title, notes, draw)


def _reached(exact: Longer) -> float:
    """The longest response that is drawn, in HR periods."""
    return float(np.count_nonzero(exact.exceedance > max(exact.floor, DEEPEST))) / exact.ticks


def _least(exact: Floats, floor: float) -> float:
    """A third of the rarest that is drawn; 1 if nothing is."""
    drawn = exact[exact > max(floor, DEEPEST)]
    return float(drawn.min()) / 3 if len(drawn) else 1.0


def _tail(axes: Axes, n: int, least: float = 1.0) -> None:
    """A logarithmic axis of shares, down to `least`; what may well be in none of n is shaded."""
    name = "not resolved" if least == 1 else "not resolved by this simulation"
    tail_axis(axes, min(1 / max(n, FEWEST), least), unseen_mass(max(n, FEWEST)), name)


def _response_notes(values: Sequence[float], figures: JobFigures, unit: str) -> list[Note]:
    """What is known of all jobs, finished or not."""
    if not values:
        return [Note("no job finished" if figures.released else "no job released")]
    finished, released = len(values), figures.released
    spread = finished_or_not(values, released - finished)
    known = [(words, spread[name]) for name, words in (("median", "median"), ("p99", "99 % within"))]
    said = [f"{words} {_short(value)}" for words, value in known if value is not None]
    if said:
        said[-1] += f" {unit}"
    if finished < released:
        said.insert(0, f"{finished} of {released} finished")
    return [Note(text) for text in said]


def _short(time: float) -> str:
    return f"{time:.3g}" if time < 1000 else f"{time:,.0f}"


def _achieved(sensor: Sensor, figures: SensorFigures, exact: Mapping[int, Exact]) -> Cell:
    landed = figures.achieved.total()
    known = {L: one.bounds.upper for L, one in exact.items() if one.bounds.upper > max(one.floor, DEEPEST)}
    steps = sorted({*figures.achieved, *known}) or [sensor.least_delay]
    first, last = steps[0], steps[-1]
    shown = max(last, first + FEWEST_SHOWN)
    limit = sensor.land_by + 0.5  # what lands in step k + land_by has met it
    near = is_near(limit, first - 1, shown + 1)
    notes = [Note(f"{landed} of {figures.taken} landed"), Note(f"{figures.dropped} dropped")]
    if not near:
        notes.append(Note(f"deadline k + {sensor.land_by}"))
    if figures.not_landed:
        notes.append(Note(f"{figures.not_landed} not landed", missed=True))
    per_bar = ceil((last - first + 1) / BINS)

    def draw(axes: Axes) -> None:
        each = f", {per_bar} in each bar" if per_bar > 1 else ""
        circles = "; circles: exactly" if known and per_bar == 1 else ""
        axes.set_xlabel(f"$l - k$ (high-rate steps{each}){circles}", labelpad=2)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
        starts = list(range(first, last + 1, per_bar))
        counts = [sum(figures.achieved[start + more] for more in range(per_bar)) for start in starts]
        shares = [count / max(landed, 1) for count in counts]
        middles = [start + (per_bar - 1) / 2 for start in starts]
        _tail(axes, landed, min(known.values()) / 3 if known else 1.0)
        if circles:
            axes.plot([*known], [*known.values()], "o", color=INK, mfc="white", ms=3.5, zorder=4)
        axes.bar(middles, shares, 0.8 * per_bar, color=FILLS["CO"].colour, lw=0)
        low, high = (min(first, sensor.land_by), max(shown, sensor.land_by + 1)) if near else (first, shown)
        edge = max(1.0, EDGE * (high - low))
        axes.set_xlim(low - edge, high + edge)
        if near:
            _deadline(axes, limit, 0.5 if circles else 1.0)

    return Cell(f"{shortened(sensor.name)}: achieved l", notes, draw)
