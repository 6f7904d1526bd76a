"""Gantt charts in the manner of Steffes (2014), Fig. 3: schedules below one another on a common axis of steps."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.intervals import jobs, never_ran, rows
from reports.charts.lanes import draw_lanes, fills_of, lanes, shortened
from reports.charts.marks import draw_marks
from reports.charts.panels import Panel, method_panel
from reports.charts.scale import Scale
from reports.drawing.legend import draw_legend, fill_entries, legend_height, sign_entries
from reports.drawing.picture import image, save
from reports.drawing.style import FONT_PT, INK, PALE, RED, TITLE_PT, WIDTH_MM, axes_at, drawing, page, text_width_mm
from sched_sim.bounds import short
from sched_sim.errors import InputError
from sched_sim.ticks import exact

__all__ = ["Panel", "gantt", "image", "method_panel", "save"]

TITLE_MM, MARKS_MM, AXIS_MM, PANEL_GAP_MM, EDGE_MM, RIGHT_MM = 4.2, 4.2, 10.0, 3.5, 2.0, 7.0
BETWEEN_MM = 4.4
NARROWEST_MM, WIDEST_MM = 40, 1000


def gantt(panels: Panel | Iterable[Panel], *, width_mm: float = WIDTH_MM) -> Figure:
    """Draw the panels, or one of them, below one another, at print size; width_mm: from 40 to 1000.

    Work is labelled as in the paper's legend (P, U, HRP, HRU, LRP, LRU), as far as the labels fit. An arrow up below
    a row is a release, an arrow down above it a deadline, both black; a missed deadline is red with a cross, work
    done after its deadline hatched in red; a job that was released and does not run is a thin bar.
    Raises InputError for what is no panel, and for another width.
    """
    panels, width_mm = _panels(panels), _width_mm(width_mm)
    with drawing():
        names = [shortened(row.name) for panel in panels for row in rows(panel.schedule)]
        left = EDGE_MM + max(8.0, *(text_width_mm(name) for name in names)) + 2.0
        across = width_mm - left - RIGHT_MM
        first, end = min(panel.first for panel in panels), max(panel.end for panel in panels)
        scales = [Scale(panel.schedule.period, first, end, across) for panel in panels]
        titles = [title_lines(panel, width_mm - left - EDGE_MM) for panel in panels]
        places = [lanes(panel.schedule, scale) for panel, scale in zip(panels, scales, strict=True)]
        fills = fills_of(panel.schedule for panel in panels)
        legend = [*fill_entries(fills), *sign_entries(any(panel.schedule.misses for panel in panels))]
        legend_mm = legend_height(legend, across)

        heads = [TITLE_MM * len(lines) + MARKS_MM for lines in titles]
        bodies = [height for _, height in places]
        gaps = PANEL_GAP_MM * (len(panels) - 1)
        figure = page(EDGE_MM + sum(heads) + sum(bodies) + gaps + AXIS_MM + legend_mm + EDGE_MM, width_mm)
        top = EDGE_MM
        for panel, scale, lines, (rows_at, body), head in zip(panels, scales, titles, places, heads, strict=True):
            axes = axes_at(figure, left, top + head, across, body)
            frame(axes, scale, body, panel.end, with_axis=panel is panels[-1])
            _write_title(axes, lines, scale, body + MARKS_MM)
            draw_marks(axes, panel.marks, scale, body)
            draw_lanes(axes, panel.schedule, rows_at, scale, fills, least_bar_mm=panel.least_bar_mm)
            top += head + body + PANEL_GAP_MM
        draw_legend(figure, legend, left, top - PANEL_GAP_MM + AXIS_MM, across)
        return figure


def _panels(given: Any) -> Sequence[Panel]:
    panels = [given] if isinstance(given, Panel) or not isinstance(given, Iterable) else list(given)
    if not panels:
        raise InputError("panels is empty: give at least one, such as method_panel(...)")
    for panel in panels:
        if not isinstance(panel, Panel):
            raise InputError(
                f"panels holds {short(repr(panel))}: give method_panel(...) or scenario_panel(...), or a list of them"
            )
    return panels


def _width_mm(given: Any) -> float:
    width = float(exact(given, "width_mm"))
    if not NARROWEST_MM <= width <= WIDEST_MM:
        raise InputError(f"width_mm is {width:g}: give from {NARROWEST_MM} to {WIDEST_MM}")
    return width


def frame(axes: Axes, scale: Scale, height_mm: float, end: int, *, with_axis: bool) -> None:
    """Axes of steps across and mm up, with a fine line at each step as far as `end`; with numbers and a name below
    if they are the lowest."""
    axes.set(xlim=(scale.first, scale.end), ylim=(0, height_mm), yticks=[])
    axes.spines[["left", "right", "top"]].set_visible(False)
    axes.spines["bottom"].set_visible(with_axis)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=20, integer=True, steps=[1, 2, 5, 10]))
    axes.tick_params(axis="x", bottom=with_axis, labelbottom=with_axis)
    if scale.mm_per_step >= 3:
        for step in range(int(scale.first), end + 1):
            axes.axvline(step, color=PALE, lw=0.5, zorder=0.3)
    if with_axis:
        axes.set_xlabel("start of step $j$ (high-rate periods)", labelpad=2)


def title_lines(panel: Panel, width_mm: float) -> list[list[tuple[str, str]]]:
    """The panel's title, its notes and its misses as lines of (text, role); role: "title", "note" or "miss"."""
    title = shortened(panel.title, width_mm, TITLE_PT, bold=True)
    pieces = [(title, "title"), *((note, "note") for note in panel.notes), _misses(panel)]
    lines: list[list[tuple[str, str]]] = [[]]
    used = 0.0
    for text, role in pieces:
        width = _width(text, role) + BETWEEN_MM
        if lines[-1] and used + width > width_mm:
            lines.append([])
            used = 0.0
        lines[-1].append((text, role))
        used += width
    return lines


def _misses(panel: Panel) -> tuple[str, str]:
    missed = panel.schedule.misses
    if panel.misses:
        return panel.misses, "miss"
    if not missed:
        return "no deadline missed", "note"
    silent = never_ran(panel.schedule)
    waiting = f", {silent} never got the processor" if silent else ""
    verb = "misses its" if missed == 1 else "miss their"
    return f"✗ {missed} of {len(jobs(panel.schedule))} jobs {verb} deadline{waiting}", "miss"


def _width(text: str, role: str) -> float:
    return text_width_mm(text, TITLE_PT if role == "title" else FONT_PT, bold=role != "note")


def _write_title(axes: Axes, lines: Sequence[Sequence[tuple[str, str]]], scale: Scale, foot_mm: float) -> None:
    for number, line in enumerate(lines):
        x, y = 0.0, foot_mm + TITLE_MM * (len(lines) - number - 1) + 0.8
        for text, role in line:
            if x:
                axes.text(scale.at(x + BETWEEN_MM / 2), y, "·", size=FONT_PT, ha="center")
                x += BETWEEN_MM
            axes.text(
                scale.at(x),
                y,
                text,
                size=TITLE_PT if role == "title" else FONT_PT,
                weight="normal" if role == "note" else "bold",
                color=RED if role == "miss" else INK,
            )
            x += _width(text, role)
