"""The rows of a Gantt panel: bars, their labels, waiting jobs, releases, deadlines and misses."""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patheffects import withStroke

from reports.charts.boxes import Box, outlines, rectangles
from reports.charts.callouts import Callout, callouts, label_fits, shown_label
from reports.charts.scale import Scale
from reports.drawing.style import FILLS, FONT_PT, GREY, INK, RED, SMALL_PT, TASK_FILLS, Fill, drawable, text_width_mm
from sched_sim.schedule.intervals import TASK, Bar, JobSpan, Row, bars, jobs, overdue_work, rows, waits
from sched_sim.schedule.outcome import Schedule

Fills = Mapping[str, Fill]

BAR_MM, ABOVE_MM, BELOW_MM, CALLOUT_MM, GAP_MM = 4.6, 2.7, 2.4, 3.4, 0.5
LONGEST_MEANING_MM = 100.0
"""A task's name in the legend."""
WAIT_MM = 0.7
SHORT_MM = 1.0
JOINT_MM = 3.0
"""Jobs that follow one another without a gap are parted by a line where a step is at least so long."""
ARROW_MM, MOST_ARROWS = 1.2, 41
"""Arrows of one kind in a row are no closer together than this, and no more, which are those of 40 steps and both ends:
of a crowded row only those of every second, fifth ... job are drawn. Those of missed deadlines all are."""
STRIDES = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000)
MANY_BARS = 2000
"""From here on hatches are left out: too fine to see, and slow to draw."""
LONGEST_NAME_MM = 28.0


class Lane(NamedTuple):
    """One row's place in its panel: foot: of its bars, in mm above the panel's foot."""

    row: Row
    foot: float
    callouts: Sequence[Callout]

    @property
    def head(self) -> float:
        return self.foot + BAR_MM

    @property
    def middle(self) -> float:
        return self.foot + BAR_MM / 2


def fills_of(schedules: Iterable[Schedule], longest_mm: float = LONGEST_MEANING_MM) -> Fills:
    """How everything that runs in these schedules is drawn, in the order of the legend; longest_mm: of a task's name
    there."""
    used = {bar.style for schedule in schedules for bar in bars(schedule)}
    tasks = sorted(style for style in used if style.startswith(TASK))
    fills = {style: fill for style, fill in FILLS.items() if style in used}
    for number, style in enumerate(tasks):
        fills[style] = TASK_FILLS[number % len(TASK_FILLS)]._replace(
            meaning=shortened(style.removeprefix(TASK), min(longest_mm, LONGEST_MEANING_MM))
        )
    return fills


def shown_styles(schedule: Schedule, scale: Scale) -> set[str]:
    """Of what runs where the axis shows it."""
    visible = ((bar.style, scale.visible_mm(bar.start, bar.end)) for bar in bars(schedule))
    return {style for style, (start, end) in visible if start < end}


def shortened(name: str, width_mm: float = LONGEST_NAME_MM, points: float = FONT_PT, *, bold: bool = False) -> str:
    """A name of the user's as a picture shows it, cut where it would be wider; by default a row's, where it would push
    the chart aside."""

    def too_wide(letters: int) -> bool:
        return text_width_mm(drawable(name[:letters] + "…"), points, bold=bold) > width_mm

    whole = drawable(name)
    if text_width_mm(whole, points, bold=bold) <= width_mm:
        return whole
    return drawable(name[: bisect_left(range(1, len(name)), True, key=too_wide)] + "…")


def lanes(schedule: Schedule, scale: Scale) -> tuple[list[Lane], float]:
    """The rows' places, from top to bottom, and the height of the panel in mm."""
    bars_of: defaultdict[Row, list[Bar]] = defaultdict(list)
    for bar in bars(schedule):
        bars_of[bar.row].append(bar)
    places = []
    y = 0.0
    for row in reversed(rows(schedule)):
        above = callouts(bars_of[row], scale)
        places.append(Lane(row, y + BELOW_MM, above))
        y += BELOW_MM + BAR_MM + ABOVE_MM + (CALLOUT_MM if above else 0) + GAP_MM
    return places[::-1], y - GAP_MM


def draw_lanes(
    axes: Axes,
    schedule: Schedule,
    places: Sequence[Lane],
    scale: Scale,
    fills: Fills,
    *,
    arrows: bool = True,
    every: int = 1,
    clipped: bool = False,
    least_bar_mm: float = 0.0,
) -> None:
    """Draw the schedule into axes whose x is in steps and whose y is in mm.

    arrows: releases and deadlines too, in crowded rows those of one job in `every`; clipped: without what is beyond the
    ends of the axis; least_bar_mm: shorter work is drawn so long, to be seen.
    """
    lane_of = {lane.row: lane for lane in places}
    all_bars, all_jobs = bars(schedule), jobs(schedule)
    waiting = [(job.row, start, end) for job in all_jobs for start, end in waits(job, schedule.horizon)]
    if clipped:
        all_bars = [bar for bar in all_bars if scale.overlaps(bar.start, bar.end)]
        waiting = [(row, start, end) for row, start, end in waiting if scale.overlaps(start, end)]
    _names(axes, places, schedule.cpus, min(scale.step(schedule.horizon), scale.end))
    _waits(axes, waiting, lane_of, scale)
    _bars(axes, all_bars, lane_of, scale, fills, least_bar_mm)
    if scale.mm_per_step >= JOINT_MM:
        _joints(axes, all_bars, lane_of, scale)
    _overdue(axes, all_bars, lane_of, scale)
    _labels(axes, all_bars, lane_of, scale, fills)
    for lane in places:
        _callouts(axes, lane, scale)
        if arrows:
            _arrows(axes, lane, [job for job in all_jobs if job.row == lane.row], scale, every)


def _names(axes: Axes, places: Sequence[Lane], cpus: int, end: float) -> None:
    beside = axes.get_yaxis_transform()
    for lane in places:
        axes.plot([axes.get_xlim()[0], end], [lane.foot] * 2, color=GREY, lw=0.5, zorder=0.8)
        label = f"CPU {lane.row.cpu + 1}" if cpus > 1 and lane.row.cpu is not None else ""
        at: dict[str, Any] = {"transform": beside, "ha": "right", "va": "center"}
        shift = 1.5 if label else 0.0
        axes.text(-0.012, lane.middle + shift, shortened(lane.row.name), **at)
        axes.text(-0.012, lane.middle - shift, label, size=SMALL_PT, color=GREY, **at)


def _waits(axes: Axes, waiting: Iterable[tuple[Row, int, int]], lane_of: Mapping[Row, Lane], scale: Scale) -> None:
    boxes = []
    for row, start, end in waiting:
        middle = lane_of[row].middle
        boxes.append((scale.step(start), scale.step(end), middle - WAIT_MM / 2, middle + WAIT_MM / 2))
    axes.add_collection(
        PolyCollection(rectangles(boxes), facecolor=GREY, linewidth=0, zorder=1.5, snap=False), autolim=False
    )


def _bars(
    axes: Axes, all_bars: Sequence[Bar], lane_of: Mapping[Row, Lane], scale: Scale, fills: Fills, least_mm: float
) -> None:
    by_style: defaultdict[tuple[bool, str], list[Box]] = defaultdict(list)
    for bar in all_bars:
        lane = lane_of[bar.row]
        start, end = scale.step(bar.start), scale.step(bar.end)
        seen = start + least_mm / scale.mm_per_step
        by_style[end < seen, bar.style].append((start, max(end, seen), lane.foot, lane.head))
    hatched = len(all_bars) < MANY_BARS
    for (widened, style), boxes in sorted(by_style.items()):
        fill = fills[style]
        hatch = fill.hatch if hatched else None
        axes.add_collection(
            PolyCollection(
                rectangles(boxes),
                facecolor=fill.colour,
                edgecolor=fill.ink,
                hatch=hatch or None,
                linewidth=0,
                zorder=2.05 if widened else 2,
                snap=False,
            ),
            autolim=False,
        )
        if hatched and fill.edge_pt:
            edges = outlines(boxes, scale, fill.edge_pt / 72 * 25.4)
            axes.add_collection(
                LineCollection(edges, color=fill.ink, linewidth=fill.edge_pt, zorder=2.07, capstyle="butt"),
                autolim=False,
            )


def _joints(axes: Axes, all_bars: Sequence[Bar], lane_of: Mapping[Row, Lane], scale: Scale) -> None:
    """A fine line where one job of a row follows another without a gap."""
    ended: dict[Row, Bar] = {}
    lines = []
    for bar in all_bars:
        before = ended.get(bar.row)
        if before is not None and before.end == bar.start and (before.kind, before.step) != (bar.kind, bar.step):
            at, lane = scale.step(bar.start), lane_of[bar.row]
            lines.append([(at, lane.foot), (at, lane.head)])
        ended[bar.row] = bar
    axes.add_collection(LineCollection(lines, color=INK, linewidth=0.3, zorder=2.1), autolim=False)


def _overdue(axes: Axes, all_bars: Sequence[Bar], lane_of: Mapping[Row, Lane], scale: Scale) -> None:
    boxes = [
        (scale.step(start), scale.step(end), lane_of[row].foot, lane_of[row].head)
        for row, start, end in overdue_work(all_bars)
    ]
    hatch = "xxxx" if len(all_bars) < MANY_BARS else None
    late = PolyCollection(
        rectangles(boxes), facecolor=(1, 1, 1, 0.55), edgecolor=RED, hatch=hatch, linewidth=0, zorder=2.2
    )
    axes.add_collection(late, autolim=False)


def _labels(axes: Axes, all_bars: Sequence[Bar], lane_of: Mapping[Row, Lane], scale: Scale, fills: Fills) -> None:
    for bar in all_bars:
        if not label_fits(bar, scale):
            continue
        fill = fills[bar.style]
        start, end = scale.visible_mm(bar.start, bar.end)
        ink = INK if fill.hatch or bar.overdue is not None else fill.ink
        text = axes.text(
            scale.at((start + end) / 2),
            lane_of[bar.row].middle,
            shown_label(bar),
            ha="center",
            va="center_baseline",
            size=SMALL_PT,
            color=ink,
            zorder=3,
        )
        if fill.hatch or bar.overdue is not None:
            around = "white" if bar.overdue is not None else fill.colour
            text.set_path_effects([withStroke(linewidth=2.2, foreground=around)])


def _callouts(axes: Axes, lane: Lane, scale: Scale) -> None:
    """The label over its work, with a bracket over all of it; or a leader, if the work is too short for a bracket."""
    foot = lane.head + ABOVE_MM
    middle = foot + CALLOUT_MM / 2 + 0.1
    for callout in lane.callouts:
        start, end, centre = callout.start, callout.end, callout.centre
        text = axes.text(
            scale.at(centre), middle, callout.text, ha="center", va="center_baseline", size=SMALL_PT, zorder=2.9
        )
        text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
        half = text_width_mm(callout.text, SMALL_PT) / 2 + 0.8
        if end - start > 2 * half + 2:
            bracket = [(start, foot), (start, middle), (end, middle), (end, foot)]
            lines = [[*bracket[:2], (centre - half, middle)], [(centre + half, middle), *bracket[2:]]]
        elif end - start > 2 * SHORT_MM:
            lines = [[(start, foot - 0.7), (start, foot), (end, foot), (end, foot - 0.7)]]
        else:
            lines = [[((start + end) / 2, lane.head), ((start + end) / 2, foot), (centre, foot + 0.4)]]
        in_steps = [[(scale.at(x), y) for x, y in line] for line in lines]
        axes.add_collection(
            LineCollection(in_steps, color=GREY, linewidth=0.5, zorder=2.8, clip_on=False), autolim=False
        )


def arrow_stride(schedule: Schedule, scale: Scale) -> int:
    """Of how many jobs of a crowded row one has its arrows, so that none is crowded any more; 1 if none is."""
    jobs_of: defaultdict[Row, list[JobSpan]] = defaultdict(list)
    for job in jobs(schedule):
        jobs_of[job.row].append(job)
    most = max(_count(row_jobs, scale) for row_jobs in jobs_of.values())
    return next(stride for stride in STRIDES if stride == STRIDES[-1] or most <= stride * _room(scale))


def _count(row_jobs: Sequence[JobSpan], scale: Scale) -> int:
    """Arrows of one kind that the axis shows."""
    releases, deadlines = {job.release for job in row_jobs}, {job.deadline for job in row_jobs}
    return max(sum(map(scale.shows, releases)), sum(map(scale.shows, deadlines)))


def _room(scale: Scale) -> float:
    """How many arrows there is room for."""
    return min(scale.width_mm / ARROW_MM, MOST_ARROWS)


def _thinned(row_jobs: Sequence[JobSpan], every: int) -> list[JobSpan]:
    """One in so many of each kind, from the first released on."""
    of_kind: defaultdict[str, list[JobSpan]] = defaultdict(list)
    for job in row_jobs:
        of_kind[job.kind].append(job)
    return [job for kind_jobs in of_kind.values() for job in kind_jobs[::every]]


def _arrows(axes: Axes, lane: Lane, row_jobs: Sequence[JobSpan], scale: Scale, every: int) -> None:
    """Releases from below, deadlines from above; missed ones in red with a cross."""
    kept = _thinned(row_jobs, every) if _count(row_jobs, scale) > _room(scale) else row_jobs
    releases = sorted({job.release for job in kept if scale.shows(job.release)})
    deadlines = sorted({job.deadline for job in kept if scale.shows(job.deadline) and not job.missed})
    missed = sorted({job.deadline for job in row_jobs if scale.shows(job.deadline) and job.missed})
    foot, head = lane.foot, lane.head
    _arrow_row(axes, [scale.step(at) for at in releases], foot - 2.1, foot - 0.55, "^", INK)
    _arrow_row(axes, [scale.step(at) for at in deadlines], head + 2.1, head + 0.55, "v", INK)
    steps = [scale.step(at) for at in missed]
    _arrow_row(axes, steps, head + 2.1, head + 0.55, "v", RED)
    axes.plot(steps, [head + 1.75] * len(steps), "x", color=RED, ms=4, mew=1.1, clip_on=False, zorder=3.2)


def _arrow_row(axes: Axes, steps: Sequence[float], tail: float, tip: float, marker: str, colour: str) -> None:
    shafts = [[(step, tail), (step, tip)] for step in steps]
    axes.add_collection(LineCollection(shafts, color=colour, linewidth=0.7, zorder=2.6, clip_on=False), autolim=False)
    axes.plot(steps, [tip] * len(steps), marker, color=colour, ms=3, mew=0, clip_on=False, zorder=2.7)
