"""The future work of the poster in the report on modular filters: parameters as random variables, and covariances that
are found automatically."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from filters.arrays import FloatArray
from reports.drawing.axes import decades
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, Line, drawing
from reports.modular.future_rows import ENDS, QUANTILES
from reports.modular.oscillator import OSCILLATOR_AMPLITUDES, dropout_axis
from reports.modular.styles import KIND_LINES, QUANTITY_LINES, curve_entry
from studies.modular.found_covariances import START

Record: TypeAlias = Mapping[str, str]

FILTERS = {
    "unaware": ("linear, no spring in it", KIND_LINES["linear"]),
    "aware": ("unscented, stiffness as a state", KIND_LINES["unscented"]),
}
PART_LINES = {
    "position": QUANTITY_LINES["position"],
    "acceleration": QUANTITY_LINES["acceleration"],
    "jerk": Line(INK, "-", "p", 5.0),
}
START_LINE = Line("#6b6b6b", "-", "X", 4.5)
MEDIAN_PT, FITS_PT = 3.2, 1.0


def stiffness_figure(rows: Sequence[Record]) -> Figure:
    """Errors of position against dropout, without the spring and with its stiffness as a state; bars: intervals."""
    with drawing():
        legend = [line_entry(name, line) for name, line in FILTERS.values()]
        figure, [[axes]] = sheet(1, 1, legend, height_mm=46.0)
        across = np.array([1 / (1 - float(row["dropout"])) for row in rows])
        for what, (name, line) in FILTERS.items():
            value, *ends = (_column(rows, f"{what}{end}") / (0.01 * OSCILLATOR_AMPLITUDES["position"]) for end in ENDS)
            drawn = axes.errorbar(
                across, value, [value - ends[0], ends[1] - value], fmt=line.marker, color=line.colour, ms=line.size,
                mew=0, ls=line.dashes, lw=1.1, elinewidth=0.8, capsize=1.6, capthick=0.8,
            )  # fmt: skip
            drawn.lines[0].set_label(name)
        dropout_axis(axes)
        decades(axes, "y", 0.2, 5_000)
        label(axes, "", "dropout (%)", "error of position (%)")
        return figure


def covariance_figure(rows: Sequence[Record]) -> Figure:
    """What was found over what is usual, a plot for each truth: the median of the fits with its interval, and the range
    of nine fits in ten."""
    with drawing():
        legend = [
            line_entry("median of the fits", Line(INK, "-", "o", 4.4), dashes=False),
            curve_entry("its 95 % interval", Line(INK, "-", ""), MEDIAN_PT),
            curve_entry("nine fits in ten", Line(INK, "-", ""), FITS_PT),
            line_entry("start of the search", START_LINE, dashes=False),
        ]
        figure, [plots] = sheet(1, len(rows), legend, height_mm=34.0)
        for axes, row in zip(plots, rows, strict=True):
            for at, (part, line) in enumerate(PART_LINES.items()):
                low, middle, high = (float(row[f"{part} {level}"]) for level in QUANTILES)
                ends = [float(row[f"{part} {QUANTILES[1]}{end}"]) for end in ENDS[1:]]
                axes.plot([at, at], [low, high], color=line.colour, lw=FITS_PT)
                axes.plot([at, at], ends, color=line.colour, lw=MEDIAN_PT, solid_capstyle="butt")
                axes.plot([at], [middle], line.marker, color=line.colour, ms=line.size + 1, mew=0)
                axes.plot([at], [START[at]], START_LINE.marker, color=START_LINE.colour, ms=START_LINE.size, mew=0)
            axes.axhline(1.0, color=INK, lw=0.7, zorder=1)
            axes.set_yscale("log")
            axes.set_ylim(0.1, 4)
            axes.yaxis.set_major_locator(FixedLocator([0.1, 0.2, 0.5, 1, 2]))
            axes.yaxis.set_minor_locator(NullLocator())
            axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axes.set_xlim(-0.6, len(PART_LINES) - 0.4)
            axes.xaxis.set_major_locator(FixedLocator(range(len(PART_LINES))))
            axes.set_xticklabels(list(PART_LINES))
            label(axes, f"Truth: {row['truth']}", "", "found over usual" if axes is plots[0] else "")
        return figure


def _column(rows: Sequence[Record], name: str) -> FloatArray:
    return np.array([float(row[name]) for row in rows])
