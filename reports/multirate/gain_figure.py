"""The gain over time, after the start and settled: that of each step, and the divided one of every n-th."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, SMALL_PT, drawing
from reports.multirate.results import Course, N
from reports.multirate.styles import OPTIMAL, READING_LINES
from reports.multirate.words import EACH_GAIN, READING_NAMES
from studies.multirate.constancy import CONSTANT

PLOT_MM = 56.0
LAST_STEP = 100
SHARES = (0.1, 0.2, 0.5, 1.0)
DIVIDED = f"{READING_NAMES['averaged']}, of every {N}th step"


def gain_figure(courses: Mapping[str, Course], constant_from: Mapping[str, int]) -> Figure:
    """A plot for each receiver. courses: by its title; constant_from: the step from which on the gain is."""
    with drawing():
        divided = READING_LINES["averaged"]
        legend = [line_entry(EACH_GAIN, OPTIMAL), line_entry(DIVIDED, divided)]
        figure, [plots] = sheet(1, len(courses), legend, height_mm=PLOT_MM, gap_mm=6.0)
        steps = np.arange(LAST_STEP + 1)
        for axes, (title, course) in zip(plots, courses.items(), strict=True):
            axes.plot(
                steps, course.optimal[steps], OPTIMAL.marker, color=OPTIMAL.colour, ls=OPTIMAL.dashes, lw=1.4,
                ms=OPTIMAL.size, mew=0, markevery=20, label=EACH_GAIN,
            )  # fmt: skip
            axes.plot(
                steps, course.divided[steps], divided.marker, color=divided.colour, ls="-", lw=1.1, mew=0,
                ms=0.8 * divided.size, drawstyle="steps-post", markevery=N, label=DIVIDED,
            )  # fmt: skip
            _share_axis(axes)
            axes.tick_params(axis="y", labelleft=axes is plots[0])
            axes.set_xlim(-2, LAST_STEP + 2)
            _from(axes, constant_from[title])
            label(axes, title, "step after the start (1 s each)")
        plots[0].set_ylabel("share of an innovation believed", labelpad=2)
        return figure


def _from(axes: Axes, step: int) -> None:
    axes.axvline(step, color=INK, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
    note = axes.annotate(
        f"from step {step} on\nno state's gain\nchanges > {100 * CONSTANT:g} %", (step, 1.25), (4, -2),
        textcoords="offset points", size=SMALL_PT, va="top",
    )  # fmt: skip
    note.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def _share_axis(axes: Axes) -> None:
    axes.set_yscale("log")
    axes.set_ylim(SHARES[0], 1.3)
    axes.yaxis.set_major_locator(FixedLocator(SHARES))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
