"""Residuals against time in the report on modular filters: one run, and all, a row of plots for each dropout."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from filters.arrays import FloatArray
from reports.drawing.axes import decades
from reports.drawing.legend import fill_entries, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, Fill, Line, drawing
from reports.modular.oscillator import BAND, ERROR_PT, ESTIMATE, NOISES, OSCILLATOR_AMPLITUDES
from reports.modular.styles import apart, band, curve_entry

Columns: TypeAlias = Mapping[str, FloatArray]
Record: TypeAlias = Mapping[str, str]

CURVES = {
    "error": Line(ESTIMATE.colour, "-", ""),
    "unlucky": Line(ESTIMATE.colour, (0, (1.0, 1.2)), ""),
    "innovation": Line("#a5620a", (0, (4.0, 1.5)), ""),
}
NAMES = {
    "error": "error, typical run",
    "unlucky": "error, 1 run in 20 above",
    "innovation": "innovation, typical run",
}
NOISE = Line(INK, (0, (6.0, 1.5, 1.0, 1.5)), "")
OF_ERROR, OF_INNOVATION = (
    Fill("#9dbbd6", "#5f87ab", "", "95 % interval, error"),
    Fill("#ecc99a", "#b0783a", "", "innovation"),
)
INTERVAL = {"error:": OF_ERROR, "innovation:": OF_INNOVATION}
SHADES = {"error": OF_ERROR, "unlucky": OF_ERROR, "innovation": OF_INNOVATION}
LARGE = 1000.0
"""Percent: what is larger is drawn in hundreds of them."""
HIGH = 200.0
"""Percent: the end of the axis where nothing is above."""
UNIT_M = 0.01 * OSCILLATOR_AMPLITUDES["position"]


def residual_time_figure(run: Columns, course: Sequence[Record]) -> Figure:
    """run: "time_s", and "error D" and "sigma D" of the run that is drawn at each dropout D of the course; course: see
    `future_rows.course_rows`; all in m."""
    dropouts = list(dict.fromkeys(row["dropout"] for row in course))
    with drawing():
        legend = apart(
            {
                "Left": [curve_entry("error of one run", ESTIMATE, ERROR_PT), *fill_entries(BAND)],
                "Right": [line_entry(NAMES[what], line) for what, line in CURVES.items()],
                "Beside them": [line_entry("noise of a measurement", NOISE), *fill_entries(INTERVAL)],
            }
        )
        figure, rows = sheet(len(dropouts), 2, legend, height_mm=20.0, stacked=True)
        for (left, right), dropout in zip(rows, dropouts, strict=True):
            error, sigma = (run[f"{what} {dropout}"] / UNIT_M for what in ("error", "sigma"))
            is_large = np.abs(error).max() > LARGE
            scale = 100.0 if is_large else 1.0
            _one_run(left, run["time_s"], error / scale, sigma / scale)
            _all_runs(right, [row for row in course if row["dropout"] == dropout])
            first, last = dropout == dropouts[0], dropout == dropouts[-1]
            across = "time (s)" if last else ""
            runs = course[0]["runs"]
            label(
                left,
                "One run: error of position (%)" if first else "",
                across,
                f"{100 * float(dropout):g} % lost{', ×100' if is_large else ''}",
            )
            label(right, f"{runs} runs, RMS in a tenth of a period (%)" if first else "", across)
            for axes in (left, right):
                axes.set_xlim(0, run["time_s"][-1])
        return figure


def _one_run(axes: Axes, time_s: FloatArray, error: FloatArray, sigma: FloatArray) -> None:
    band(axes, time_s, -2 * sigma, 2 * sigma, BAND["band:"])
    axes.axhline(0.0, color=INK, lw=0.6)
    axes.plot(time_s, error, color=ESTIMATE.colour, lw=ERROR_PT, label="error of one run")
    settled = np.abs(np.concatenate([error, 2 * sigma]))[np.tile(time_s > 0.1 * time_s[-1], 2)].max()
    axes.set_ylim(-1.2 * settled, 1.2 * settled)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))


def _all_runs(axes: Axes, course: Sequence[Record]) -> None:
    time_s = np.array([float(row["time_s"]) for row in course])
    for what, line in CURVES.items():
        value, low, high = (
            np.array([float(row[f"{what}{end}"]) for row in course]) / UNIT_M for end in ("", " low", " high")
        )
        band(axes, time_s, low, high, SHADES[what])
        axes.plot(time_s, value, color=line.colour, ls=line.dashes, lw=1.1, label=NAMES[what])
    axes.axhline(NOISES["position"] / UNIT_M, color=NOISE.colour, ls=NOISE.dashes, lw=0.8)
    decades(axes, "y", 0.5, 20_000 if axes.dataLim.y1 > HIGH else HIGH)
