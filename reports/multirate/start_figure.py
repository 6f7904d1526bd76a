"""The ratio after the start, and what a gain in each of the first steps makes of it."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, Line, drawing
from reports.multirate.ratio_axis import ratio_axis
from reports.multirate.styles import PERIOD_LINES
from reports.multirate.words import ratio_text

PLOT_MM = 60.0
LAST_STEP = 150


def start_figure(courses: Mapping[int, FloatArray], starts: Mapping[int, Mapping[int, float]]) -> Figure:
    """Left, the ratio in every step after the start, its peak ringed and in the legend; right, the worst ratio if the
    first steps have a gain each. Both by n."""
    with drawing():
        legend = [
            line_entry(f"$n$ = {n}, peak {ratio_text(course.max())} in step {course.argmax()}", PERIOD_LINES[n])
            for n, course in courses.items()
        ]
        figure, [[left, right]] = sheet(1, 2, legend, height_mm=PLOT_MM, gap_mm=19.0)
        for axes in (left, right):
            ratio_axis(axes, 2.5 * max(course.max() for course in courses.values()))
        for n, course in courses.items():
            line = PERIOD_LINES[n]
            _course(left, course[: LAST_STEP + 1], line, f"n = {n}")
            losses = [ratio - 1 for ratio in starts[n].values()]
            right.plot(
                list(starts[n]), losses, line.marker, color=line.colour, ms=line.size, mew=0, ls=line.dashes, lw=1.1,
                label=f"n = {n}",
            )  # fmt: skip
        label(left, "Gain every $n$-th step from the start", "step after the start (1 s each)", "ratio in that step")
        label(right, "The first steps with a gain each", "steps with a gain each", "worst ratio of the run")
        left.set_xlim(-3, LAST_STEP + 3)
        return figure


def _course(axes: Axes, course: FloatArray, line: Line, name: str) -> None:
    """With a ring at its peak."""
    axes.plot(
        range(len(course)), course - 1, line.marker, color=line.colour, ms=0.8 * line.size, mew=0, ls=line.dashes,
        lw=1.0, markevery=10, label=name,
    )  # fmt: skip
    peak = int(course.argmax())
    axes.plot([peak], [course[peak] - 1], "o", ms=7, mfc="none", mec=INK, mew=0.8, zorder=4)
