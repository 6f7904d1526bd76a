"""Figures on how accurate the multirate gain is: in steady state, and after the start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import log10
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from filters.arrays import FloatArray
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.placing import spread
from reports.drawing.style import INK, PALE, SMALL_PT, SOURCE_LINES, TITLE_PT, WIDTH_MM, Line, axes_at, drawing, page
from reports.multirate.words import ratio_text
from studies.multirate.accuracy import GOOD, Reading

EDGE_MM, LEFT_MM, RIGHT_MM, GAP_MM, TITLE_MM, BETWEEN_MM, AXIS_MM = 2.0, 20.0, 11.0, 15.0, 6.0, 5.0, 11.0
STEADY_MM, START_MM = 42.0, 62.0
RATIOS = (1.001, 1.01, 1.05, 1.2, 2.0, 5.0, 20.0, 100.0, 1000.0)


class Curve(NamedTuple):
    """label: at its right end, short; ratios: by n."""

    label: str
    ratios: Mapping[int, float]


class Family(NamedTuple):
    """A column of the figure. title: with the unit of the labels; curves: by reading, at most five for each."""

    title: str
    curves: Mapping[Reading, Sequence[Curve]]


def steady_figure(families: Sequence[Family], readings: Mapping[Reading, str]) -> Figure:
    """The ratio in steady state against n: a column for each family, a row for each reading.

    readings: what stands at the axis of each. Below the fine line the loss is small.
    """
    with drawing():
        across = (WIDTH_MM - LEFT_MM - RIGHT_MM - GAP_MM * (len(families) - 1)) / len(families)
        down = STEADY_MM * len(readings) + BETWEEN_MM * (len(readings) - 1)
        figure = page(EDGE_MM + TITLE_MM + down + AXIS_MM)
        ratios = [
            ratio for family in families for row in family.curves.values() for c in row for ratio in c.ratios.values()
        ]
        highest = 1.6 * max(ratios)
        for row, (reading, name) in enumerate(readings.items()):
            for column, family in enumerate(families):
                top = EDGE_MM + TITLE_MM + row * (STEADY_MM + BETWEEN_MM)
                axes = axes_at(figure, LEFT_MM + column * (across + GAP_MM), top, across, STEADY_MM)
                _ratio_axis(axes, highest, numbers=column == 0)
                _curves(axes, family.curves[reading])
                if row == 0:
                    axes.set_title(family.title, loc="left", size=TITLE_PT)
                if column == 0:
                    axes.set_ylabel(f"ratio, {name}", labelpad=3)
                axes.tick_params(axis="x", labelbottom=row == len(readings) - 1)
                if row == len(readings) - 1:
                    axes.set_xlabel("$n$ (steps for each gain)", labelpad=2)
        return figure


def _curves(axes: Axes, curves: Sequence[Curve]) -> None:
    last = max(n for curve in curves for n in curve.ratios)
    axes.set_xlim(0.3, last + 0.7)
    axes.xaxis.set_major_locator(FixedLocator([1, *range(5, last + 1, 5)]))
    low, high = (log10(limit) for limit in axes.get_ylim())
    ends = []
    for curve, line in zip(curves, SOURCE_LINES, strict=False):
        losses = {n: ratio - 1 for n, ratio in curve.ratios.items() if n > 1}
        mew = 1.2 if line.marker == "|" else 0
        axes.plot(
            list(losses), list(losses.values()), line.marker, color=line.colour, ms=0.75 * line.size, mew=mew,
            ls=line.dashes, lw=0.8, label=curve.label,
        )  # fmt: skip
        ends.append(((log10(losses[last]) - low) / (high - low) * STEADY_MM, curve.label))
    ends.sort()
    places = spread([at for at, _ in ends], [2.7] * len(ends), 0.0, STEADY_MM, 0.2)
    for (_, label), at in zip(ends, places, strict=True):
        axes.text(1.03, at / STEADY_MM, label, transform=axes.transAxes, va="center", size=SMALL_PT)


def _ratio_axis(axes: Axes, highest: float, *, numbers: bool) -> None:
    """Logarithmic in the loss, ratio - 1, with the ratios as numbers; pale where the loss is small."""
    axes.set_yscale("log")
    axes.set_ylim(6e-4, highest)
    axes.yaxis.set_major_locator(FixedLocator([ratio - 1 for ratio in RATIOS if ratio < highest]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda loss, _: f"{1 + loss:.4g}"))
    axes.fmt_ydata = lambda loss: ratio_text(1 + loss)
    axes.tick_params(axis="y", labelleft=numbers)
    axes.spines[["right", "top"]].set_visible(False)
    axes.grid(axis="y", color=PALE, lw=0.5)
    axes.axhline(GOOD - 1, color=INK, lw=0.7, ls=(0, (2, 1.5)), zorder=1)
    axes.axhspan(6e-4, GOOD - 1, facecolor="#f0f0f0", lw=0, zorder=0.2)


def start_figure(
    courses: Mapping[int, FloatArray], starts: Mapping[int, Mapping[int, float]], last_step: int = 150
) -> Figure:
    """Left, the ratio in every step after the start, its peak ringed and in the legend; right, the worst
    ratio if the first steps have a gain each. Both by n, at most four."""
    with drawing():
        width = (WIDTH_MM - LEFT_MM - RIGHT_MM - GAP_MM) / 2
        legend = [
            line_entry(f"n = {n}, peak {ratio_text(course.max())} in step {course.argmax()}", line)
            for (n, course), line in zip(courses.items(), SOURCE_LINES[1:], strict=False)
        ]
        legend_top = EDGE_MM + TITLE_MM + START_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, WIDTH_MM - LEFT_MM - RIGHT_MM) + EDGE_MM)
        highest = 2.5 * max(course.max() for course in courses.values())
        left, right = (
            axes_at(figure, LEFT_MM + column * (width + GAP_MM), EDGE_MM + TITLE_MM, width, START_MM)
            for column in range(2)
        )
        for axes in (left, right):
            _ratio_axis(axes, highest, numbers=True)
        for (n, course), line in zip(courses.items(), SOURCE_LINES[1:], strict=False):
            _course(left, course[: last_step + 1], line, f"n = {n}")
            steps = starts[n]
            losses = [ratio - 1 for ratio in steps.values()]
            right.plot(
                list(steps), losses, line.marker, color=line.colour, ms=line.size, mew=0, ls=line.dashes, lw=1.0,
                label=f"n = {n}",
            )  # fmt: skip
        left.set_title("Gain every $n$-th step from the start", loc="left", size=TITLE_PT)
        right.set_title("The first steps with a gain each", loc="left", size=TITLE_PT)
        left.set_xlabel("step after the start (1 s each)", labelpad=2)
        right.set_xlabel("steps with a gain each", labelpad=2)
        left.set_ylabel("ratio in that step", labelpad=3)
        right.set_ylabel("worst ratio of the run", labelpad=3)
        left.set_xlim(-3, last_step + 3)
        draw_legend(figure, legend, LEFT_MM, legend_top, WIDTH_MM - LEFT_MM - RIGHT_MM)
        return figure


def _course(axes: Axes, course: FloatArray, line: Line, name: str) -> None:
    """With a ring at its peak."""
    axes.plot(
        range(len(course)),
        course - 1,
        line.marker,
        color=line.colour,
        ms=0.8 * line.size,
        mew=0,
        ls=line.dashes,
        lw=0.8,
        markevery=10,
        label=name,
    )
    peak = int(course.argmax())
    axes.plot([peak], [course[peak] - 1], "o", ms=7, mfc="none", mec=INK, mew=0.8, zorder=4)
