"""What dropout leaves, in the report on modular filters: the error of position against the measurements that get
through, at every sampling rate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter

from reports.drawing.axes import decades, plain
from reports.drawing.legend import Entry, draw_legend, legend_height, line_entry
from reports.drawing.style import INK, RED, SMALL_PT, SOURCE_LINES, Line, axes_at, drawing, page
from reports.modular.oscillator import CLAIMED, ENDS, NOISES, OSCILLATOR_AMPLITUDES, column, curve, level
from reports.modular.styles import head_entry

Record: TypeAlias = Mapping[str, str]

WIDTH_MM, LEFT_MM, RIGHT_MM, TOP_MM, HEIGHT_MM, AXIS_MM = 112.0, 19.0, 3.0, 2.0, 44.0, 9.5
"""Narrow, so that its letters are large on a page and still read on a phone."""
RING = Line(RED, "-", "o", 7.5)
"""Around what the claim is about."""
SHOWN = (0.2, 1, 4, 20, 100, 400)
"""Measurements with a number on the axis."""


def gap_figure(by_rate: Mapping[int, Sequence[Record]], enough: float) -> Figure:
    """by_rate: by measurements in a period; enough: so many that get through are said to be."""
    lines = dict(zip(by_rate, SOURCE_LINES, strict=False))
    unit = 0.01 * OSCILLATOR_AMPLITUDES["position"]
    with drawing():
        legend = [
            head_entry("Sampled in a period"),
            *(line_entry(f"{rate}", line) for rate, line in lines.items()),
            Entry(f"{100 * CLAIMED:g} % of them lost", 3.0, _ring_entry),
        ]
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        legend_top = TOP_MM + HEIGHT_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + 1.0, WIDTH_MM)
        axes = axes_at(figure, LEFT_MM, TOP_MM, across, HEIGHT_MM)
        plain(axes)
        for rate, rows in by_rate.items():
            through = 1 / column(rows, "interval")
            value, *ends = (column(rows, f"error {end}m") / unit for end in ENDS)
            curve(axes, through, value, ends, lines[rate], f"sampled {rate} times")
            claimed = np.isclose(column(rows, "dropout"), CLAIMED)
            axes.plot(
                through[claimed], value[claimed], RING.marker, color=RING.colour, mfc="none", ms=RING.size, mew=1.1,
                zorder=4,
            )  # fmt: skip
        decades(axes, "y", 0.5, 20_000)
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
        decades(axes, "x", 0.16, 500)
        axes.xaxis.set_major_locator(FixedLocator(SHOWN))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.axvline(enough, color=INK, lw=0.9, zorder=1)
        _beside(axes, enough, f"{enough:g} get through:\nenough at every rate")
        level(axes, NOISES["position"] / unit, f"one measurement: {NOISES['position'] / unit:g} %")
        level(axes, 100 * float(next(iter(by_rate.values()))[0]["still"]), "an estimate of zero")
        axes.set_xlabel("measurements that get through in a period", labelpad=2)
        axes.set_ylabel("error of position\n(% of the amplitude)", labelpad=2)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def _beside(axes: Axes, at: float, text: str) -> None:
    axes.annotate(
        text, (at, 1), (4, -2), xycoords=axes.get_xaxis_transform(), textcoords="offset points", va="top",
        size=SMALL_PT,
    )  # fmt: skip


def _ring_entry(axes: Axes, x: float, y: float) -> None:
    axes.plot([x + 1.5], [y], RING.marker, color=RING.colour, mfc="none", ms=RING.size - 1, mew=1.1)
