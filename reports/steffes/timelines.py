"""The timelines of Steffes (2014), Figs 1 and 2, drawn from a simulated schedule."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedFormatter, FixedLocator

from reports.charts.chart import frame
from reports.charts.lanes import Lane, draw_lanes, fills_of
from reports.charts.marks import draw_marks
from reports.charts.panels import METHOD_NAMES, Panel
from reports.charts.scale import Scale
from reports.drawing.legend import draw_legend, fill_entries, legend_height
from reports.drawing.style import GREY, INK, SMALL_PT, WIDTH_MM, axes_at, drawing, page, text_width_mm
from sched_sim.costs.table import CostTable
from sched_sim.design.cycle_marks import cycle_marks
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, LarsenCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.intervals import JobSpan, bars, jobs, rows

LEFT_MM, RIGHT_MM, MARKS_MM, AXIS_MM, KEY_LINE_MM, EDGE_MM = 12.0, 7.0, 5.0, 6.5, 4.6, 2.0

STEPS = (
    r"each step $j$: $\hat{x}_{j^-}$, Eq. (6); $\Phi$, $Q$ from $k-N$ to $j$, Eqs. (15)–(18)",
    r"at $k$: $\Phi_{(k-N)\rightarrow k}$, $Q_{(k-N)\rightarrow k}$ to the LR task",
    r"LR propagate: $P_{k^-}$, Eq. (14)",
    r"from $m$ on, LR update: $\delta\hat{x}_{k^+}$, $P_{k^+}$, Eqs. (9)–(11)",
    r"$\delta\hat{x}_{k^+}$ to the HR task",
    r"at $l$, HR update: $\delta\hat{x}_{l^-}$, Eq. (13); reset, Eq. (19)",
)
"""What the six numbers of Fig. 2 stand for (Sec. III.A)."""


def serial_timeline(table: CostTable, timing: Timing, speed: Fraction) -> Figure:
    """Fig. 1: a Kalman filter in real time, one step after another, and the time that it leaves unused. Shown from one
    step before the second measurement until two after it has arrived.

    As the paper says of it, each step propagates alike; its update is that of Larsen's method.
    Raises InputError if a deadline is missed at `speed`.
    """
    panel = serial_panel(table, timing, speed)
    period = panel.schedule.period
    with drawing():
        figure, axes, scale = _sheet(panel, 19.0, timing.N)
        lane = Lane(rows(panel.schedule)[0], 6.5, ())
        draw_lanes(axes, panel.schedule, [lane], scale, fills_of([panel.schedule]), arrows=False)
        for start, stop in unused(jobs(panel.schedule), panel.first * period, panel.end * period):
            _span(axes, scale.step(start), scale.step(stop), 4.6)
            axes.text(scale.step((start + stop) / 2), 1.2, "unused", ha="center", size=SMALL_PT, color=GREY)
        _arrow(axes, (timing.N, lane.head + 6.5), (timing.N, lane.head))
        _beside(axes, scale, timing.N, lane.head + 4.5, "measurement taken")
        _arrow(axes, (timing.N + timing.M, lane.head + 6.5), (timing.N + timing.M, lane.head))
        _beside(axes, scale, timing.N + timing.M, lane.head + 4.5, "delayed measurement available")
        return figure


def dual_rate_timeline(table: CostTable, timing: Timing, speed: Fraction) -> Figure:
    """Fig. 2: the dual-rate filter, with the six steps of Sec. III.A and what its two tasks exchange. Shown from one
    step before the second measurement until two after its correction was due.

    Raises InputError if a deadline is missed at `speed`, and for an L that the method cannot have.
    """
    panel = dual_rate_panel(table, timing, speed)
    schedule, k, m = panel.schedule, timing.N, timing.N + timing.M
    with drawing():
        figure, axes, scale = _sheet(panel, 43.0, timing.N, STEPS)
        high, low = (Lane(row, foot, ()) for row, foot in zip(rows(schedule), (30.5, 10.0), strict=True))
        draw_lanes(axes, schedule, [high, low], scale, fills_of([schedule]), arrows=False)
        work = [bar for bar in bars(schedule) if scale.shows(bar.start) and scale.shows(bar.end)]

        def extent(style: str) -> tuple[float, float]:
            """From the first to the last instant at which this cycle's work of one label runs."""
            pieces = [
                bar for bar in work if bar.style == style and (bar.step >= m if style == "HRU" else bar.step == k)
            ]
            return scale.step(pieces[0].start), scale.step(pieces[-1].end)

        for bar in work:
            if bar.style == "HRP":
                _badge(axes, scale.step((bar.start + bar.end) / 2), high.head + 3.0, 1)
        sent = next(scale.step(bar.end) for bar in work if bar.style == "HRP" and bar.step == k)
        _arrow(axes, (sent, high.foot), (sent, low.head))
        _badge(axes, scale.at(scale.mm(sent) + 3.0), 22.5, 2)
        _beside(axes, scale, scale.at(scale.mm(sent) + 4.6), 21.6, r"$\Phi, Q$")
        for number, style in ((3, "LRP"), (4, "LRU")):
            start, end = extent(style)
            _span(axes, start, end, low.foot - 1.8)
            middle = scale.mm((start + end) / 2)
            _badge(axes, scale.at(middle - 4.5), low.foot - 5.0, number)
            _beside(axes, scale, scale.at(middle - 3.0), low.foot - 5.9, style)
        _arrow(axes, (m, 0.6), (m, low.foot))
        axes.text(scale.at(scale.mm(m) - 1.2), 1.0, "delayed measurement", ha="right", size=SMALL_PT)
        done, applied = extent("LRU")[1], sum(extent("HRU")) / 2
        _arrow(axes, (done, low.head), (applied, high.foot))
        _badge(axes, scale.at(scale.mm((done + applied) / 2) + 3.5), 22.0, 5)
        _beside(axes, scale, scale.at(scale.mm((done + applied) / 2) + 5.1), 21.1, r"$\delta\hat{x}_{k^+}$")
        _badge(axes, applied, high.head + 3.0, 6)
        return figure


def serial_panel(table: CostTable, timing: Timing, speed: Fraction) -> Panel:
    """The schedule of Fig. 1."""
    return _second_cycle(serial_costs(table), "larsen", timing, speed, timing.M + 3)


def dual_rate_panel(table: CostTable, timing: Timing, speed: Fraction) -> Panel:
    """The schedule of Fig. 2."""
    return _second_cycle(select(table, "dual-rate", Options()), "dual-rate", timing, speed, timing.L + 2)


def serial_costs(table: CostTable) -> LarsenCosts[Fraction]:
    """Costs of a filter whose steps all propagate alike, and one of which also updates."""
    costs = select(table, "larsen", Options())
    assert isinstance(costs, LarsenCosts)
    return replace(costs, accumulate=costs.propagate)


def unused(all_jobs: Sequence[JobSpan], first: int, end: int) -> list[tuple[int, int]]:
    """The intervals of [first, end) ticks in which none of the jobs runs; they run one at a time."""
    runs = sorted(run for job in all_jobs for run in job.runs if first < run[1] and run[0] < end)
    edges = [first, *(min(max(instant, first), end) for run in runs for instant in run), end]
    return [(start, stop) for start, stop in list(pairwise(edges))[::2] if start < stop]


def _second_cycle(costs: Costs, method: str, timing: Timing, speed: Fraction, steps: int) -> Panel:
    """The second cycle, so that what the first left to do is there too; from step k-1 until step k + `steps`."""
    landings: dict[int, int] = {}
    schedule = simulate(costs, timing, speed, 3, keep_slices=True, on_landing=landings.__setitem__)
    if schedule.misses:
        raise InputError(
            f"timeline of {method}: {schedule.misses} deadlines are missed at speed {float(speed):g}: give the "
            f"method's least speed or more"
        )
    k = timing.N
    marks = [mark._replace(step=mark.step + k) for mark in cycle_marks(timing, 1, {0: landings[1]})]
    return Panel(METHOD_NAMES[method], schedule, (), marks, first=k - 1, last=k + steps)


def _sheet(panel: Panel, body_mm: float, k: int, key: Sequence[str] = ()) -> tuple[Figure, Axes, Scale]:
    """A page with the axes of the timeline, k, m and l above, the steps' names and the legend below; and under it the
    numbered lines of `key` in two columns."""
    fills = fill_entries(fills_of([panel.schedule]))
    across = WIDTH_MM - LEFT_MM - RIGHT_MM
    scale = Scale(panel.schedule.period, panel.first, panel.end, across)
    legend_top = EDGE_MM + MARKS_MM + body_mm + AXIS_MM
    key_top = legend_top + legend_height(fills, across) + (2.0 if key else 0.0)
    key_lines = -(-len(key) // 2)
    figure = page(key_top + key_lines * KEY_LINE_MM + EDGE_MM)
    axes = axes_at(figure, LEFT_MM, EDGE_MM + MARKS_MM, across, body_mm)
    frame(axes, scale, body_mm, panel.end, with_axis=True)
    axes.set_xlabel("")
    steps = range(panel.first, panel.end + 1)
    axes.xaxis.set_major_locator(FixedLocator(steps))
    axes.xaxis.set_major_formatter(FixedFormatter([f"${_name(step - k)}$" for step in steps]))
    draw_marks(axes, panel.marks, scale, body_mm)
    draw_legend(figure, fills, LEFT_MM, legend_top, across)
    if key:
        below = axes_at(figure, LEFT_MM, key_top, across, key_lines * KEY_LINE_MM)
        below.set(xlim=(0, across), ylim=(0, key_lines * KEY_LINE_MM))
        below.axis("off")
        second_column = max(text_width_mm(text, SMALL_PT) for text in key[:key_lines]) + 10.0
        for number, text in enumerate(key):
            x, y = second_column * (number // key_lines), (key_lines - number % key_lines - 0.5) * KEY_LINE_MM
            _badge(below, x + 1.6, y, number + 1)
            below.text(x + 4.2, y, text, va="center_baseline", size=SMALL_PT)
    return figure, axes, scale


def _name(offset: int) -> str:
    return "k" if offset == 0 else f"k{offset:+d}"


def _span(axes: Axes, start: float, end: float, y: float) -> None:
    """A measuring line from start to end (steps) at `y` mm."""
    axes.plot([start, end], [y, y], "|-", color=GREY, lw=0.6, ms=3.5, mew=0.6)


def _arrow(axes: Axes, tail: tuple[float, float], tip: tuple[float, float]) -> None:
    style = {"arrowstyle": "-|>", "lw": 0.9, "color": INK, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7}
    axes.annotate("", tip, tail, arrowprops=style, zorder=4)


def _badge(axes: Axes, x: float, y: float, number: int) -> None:
    """A number in a circle."""
    box = {"boxstyle": "circle,pad=0.18", "facecolor": "white", "edgecolor": INK, "linewidth": 0.6}
    axes.text(x, y, str(number), ha="center", va="center", size=SMALL_PT, bbox=box, zorder=5)


def _beside(axes: Axes, scale: Scale, step: float, y: float, text: str) -> None:
    label = axes.text(scale.at(scale.mm(step) + 1.2), y, text, size=SMALL_PT, zorder=5)
    label.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
