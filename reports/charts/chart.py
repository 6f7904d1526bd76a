"""Gantt charts in the manner of Steffes (2014), Fig. 3: schedules below one another on a common axis of steps."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.charts.axis import MS_MM, STEPS_MM, draw_ms, name_steps, step_ticks
from reports.charts.lanes import arrow_stride, draw_lanes, fills_of, lanes, shortened, shown_styles
from reports.charts.marks import draw_marks
from reports.charts.panels import Panel, method_panel
from reports.charts.scale import Scale
from reports.drawing.legend import BESIDE_MM, SWATCH_MM, draw_legend, fill_entries, legend_height, sign_entries
from reports.drawing.picture import image, save
from reports.drawing.style import FONT_PT, INK, PALE, RED, TITLE_PT, WIDTH_MM, axes_at, drawing, page, text_width_mm
from sched_sim.bounds import short
from sched_sim.errors import InputError
from sched_sim.schedule.intervals import jobs, never_ran, rows
from sched_sim.ticks import Number, exact, positive

__all__ = ["Panel", "gantt", "image", "method_panel", "save"]

TITLE_MM, MARKS_MM, PANEL_GAP_MM, EDGE_MM, RIGHT_MM = 4.2, 4.2, 3.5, 2.0, 7.0
BETWEEN_MM = 4.4
NARROWEST_MM, WIDEST_MM = 50, 1000
"""In less the legend has no room."""
WORD = re.compile(r"(?:\$[^$]*\$|\S)+")


def gantt(panels: Panel | Iterable[Panel], *, width_mm: float = WIDTH_MM, hr_hz: Number | None = None) -> Figure:
    """Draw the panels, or one of them, below one another, at print size; width_mm: from 50 to 1000; hr_hz: the rate of
    the HR loop, for a second axis in ms.

    Work is labelled as in the paper's legend (P, U, HRP, HRU, LRP, LRU), as far as the labels fit. An arrow up below
    a row is a release, an arrow down above it a deadline, both black; a missed deadline is red with a cross, work
    done after its deadline hatched in red; a job that was released and does not run is a thin bar. Where a row has
    more arrows than 40 steps, or than there is room for, only those of every second, fifth ... job are drawn.
    Raises InputError for what is no panel, for another width, and for a rate that is not greater than 0.
    """
    panels, width_mm = _panels(panels), _width_mm(width_mm)
    rate = None if hr_hz is None else positive(hr_hz, "hr_hz")
    with drawing():
        names = [shortened(row.name) for panel in panels for row in rows(panel.schedule)]
        left = EDGE_MM + max(8.0, *(text_width_mm(name) for name in names)) + 2.0
        across = width_mm - left - RIGHT_MM
        first, end = min(panel.first for panel in panels), max(panel.end for panel in panels)
        scales = [Scale(panel.schedule.period, first, end, across) for panel in panels]
        titles = [title_lines(panel, width_mm - left - EDGE_MM) for panel in panels]
        places = [lanes(panel.schedule, scale) for panel, scale in zip(panels, scales, strict=True)]
        fills = fills_of((panel.schedule for panel in panels), width_mm - 2 * EDGE_MM - SWATCH_MM - BESIDE_MM)
        every = max(arrow_stride(panel.schedule, scale) for panel, scale in zip(panels, scales, strict=True))
        shown = {
            style for panel, scale in zip(panels, scales, strict=True) for style in shown_styles(panel.schedule, scale)
        }
        meanings = {style: fill for style, fill in fills.items() if style in shown}
        legend = [*fill_entries(meanings), *sign_entries(any(panel.schedule.misses for panel in panels), every)]
        legend_left = left if all(entry.width_mm <= across for entry in legend) else EDGE_MM
        legend_across = width_mm - legend_left - (RIGHT_MM if legend_left == left else EDGE_MM)
        legend_mm = legend_height(legend, legend_across)

        heads = [TITLE_MM * len(lines) + MARKS_MM for lines in titles]
        bodies = [height for _, height in places]
        gaps = PANEL_GAP_MM * (len(panels) - 1)
        axis_mm = STEPS_MM + (0.0 if rate is None else MS_MM)
        figure = page(EDGE_MM + sum(heads) + sum(bodies) + gaps + axis_mm + legend_mm + EDGE_MM, width_mm)
        top = EDGE_MM
        for panel, scale, lines, (rows_at, body), head in zip(panels, scales, titles, places, heads, strict=True):
            axes = axes_at(figure, left, top + head, across, body)
            frame(axes, scale, body, panel.end, with_axis=panel is panels[-1])
            _write_title(axes, lines, scale, body + MARKS_MM)
            draw_marks(axes, panel.marks, scale, body)
            draw_lanes(
                axes, panel.schedule, rows_at, scale, fills, every=every, clipped=True, least_bar_mm=panel.least_bar_mm
            )
            top += head + body + PANEL_GAP_MM
        foot = top - PANEL_GAP_MM
        if rate is not None:
            draw_ms(figure, scales[-1], rate, left, foot + STEPS_MM)
        draw_legend(figure, legend, legend_left, foot + axis_mm, legend_across)
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
    step_ticks(axes, scale)
    axes.tick_params(axis="x", bottom=with_axis, labelbottom=with_axis)
    if scale.mm_per_step >= 3:
        for step in range(int(scale.first), end + 1):
            axes.axvline(step, color=PALE, lw=0.5, zorder=0.3)
    if with_axis:
        name_steps(axes, scale)


def title_lines(panel: Panel, width_mm: float) -> list[list[tuple[str, str]]]:
    """The panel's title, its notes and its misses as lines of (text, role); role: "title", "note" or "miss". What is
    wider than a line goes on in the next."""
    title = shortened(panel.title, width_mm, TITLE_PT, bold=True)
    pieces = [(title, "title"), *((note, "note") for note in panel.notes), _misses(panel)]
    lines: list[list[tuple[str, str]]] = [[]]
    used = 0.0
    for text, role in pieces:
        width = _width(text, role) + BETWEEN_MM
        if lines[-1] and used + width > width_mm:
            lines.append([])
            used = 0.0
        first, *more = _broken(text, role, width_mm)
        lines[-1].append((first, role))
        lines += [[(line, role)] for line in more]
        used = width_mm if more else used + width
    return lines


def _broken(text: str, role: str, width_mm: float) -> list[str]:
    """Between words, never within a formula; one word at the least in each."""
    if _width(text, role) <= width_mm:
        return [text]
    first, *words = WORD.findall(text)
    broken = [first]
    for word in words:
        longer = f"{broken[-1]} {word}"
        if _width(longer, role) <= width_mm:
            broken[-1] = longer
        else:
            broken.append(word)
    return broken


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
