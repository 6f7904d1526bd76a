"""The oscillator of the report on modular filters: a run, residuals against dropout, consistency."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from filters.arrays import FloatArray
from reports.drawing.axes import decades
from reports.drawing.legend import fill_entries, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, INK, PALE, SMALL_PT, SOURCE_LINES, Fill, Line, drawing
from reports.modular.styles import QUANTITY_LINES, band, curve_entry, span_band
from studies.modular.oscillator_run import ACCELERATION_SIGMA, AMPLITUDES, POSITION_SIGMA_M

Columns: TypeAlias = Mapping[str, FloatArray]
Record: TypeAlias = Mapping[str, str]

QUANTITIES = {"position": "m", "velocity": "m/s", "acceleration": "m/s²"}
UNITS = {"position": "m", "velocity": "m_s", "acceleration": "m_s2"}
"""Units in the columns' names."""
SENSORS = ("position", "acceleration")
LINES = {name: QUANTITY_LINES[name] for name in QUANTITIES}

TRUE = Line(INK, "-", "")
ESTIMATE = Line("#11538c", "-", "")
TRUE_PT, ESTIMATE_PT, ERROR_PT = 0.7, 1.8, 0.9
MEASURED = Line("#a5620a", "-", ".", 5.0)
BAND = {"band:": Fill("#cfdde9", "#5f87ab", "", "twice the standard deviation that the filter gives")}
BOUNDS = (Fill(PALE, GREY, "", "95 % bounds"), Fill("#bdbdbd", INK, "", "95 % bounds"))
"""The wider ones first."""

SHOWN = (0.1, 0.5, 0.8, 0.9, 0.95, 0.98, 0.99)
"""Dropouts with a number on the axis."""
CLAIMED = 0.8
ENDS = ("", "low ", "high ")
"""How the columns of a value and of its interval are called."""
OSCILLATOR_AMPLITUDES = dict(zip(QUANTITIES, map(float, AMPLITUDES), strict=True))
NOISES = {"position": float(POSITION_SIGMA_M), "acceleration": float(ACCELERATION_SIGMA)}


def history_figure(run: Columns, periods_s: float) -> Figure:
    """One run: states at the left, errors at the right, up to so many seconds."""
    with drawing():
        legend = [
            curve_entry("true", TRUE, TRUE_PT),
            curve_entry("estimate", ESTIMATE, ESTIMATE_PT),
            curve_entry("its error", ESTIMATE, ERROR_PT),
            line_entry("measurement", MEASURED, dashes=False),
            *fill_entries(BAND),
        ]
        figure, rows = sheet(3, 2, legend, height_mm=24.0, stacked=True)
        kept = run["time_s"] <= periods_s
        time_s = run["time_s"][kept]
        for (left, right), (name, unit) in zip(rows, QUANTITIES.items(), strict=True):
            truth, estimate, sigma = (run[f"{name} {what}"][kept] for what in ("true", "estimate", "sigma"))
            if name in SENSORS:
                seen = run[f"{name} measured"][kept]
                left.plot(time_s, seen, MEASURED.marker, color=MEASURED.colour, ms=3.2, mew=0, zorder=4)
            left.plot(time_s, estimate, color=ESTIMATE.colour, lw=ESTIMATE_PT, label="estimate")
            left.plot(time_s, truth, color=INK, lw=TRUE_PT, label="true")
            band(right, time_s, -2 * sigma, 2 * sigma, BAND["band:"])
            right.axhline(0.0, color=INK, lw=0.6)
            right.plot(time_s, estimate - truth, color=ESTIMATE.colour, lw=ERROR_PT, label="error")
            settled = np.abs(np.concatenate([2 * sigma, estimate - truth])[np.tile(time_s > 0.1 * periods_s, 2)])
            right.set_ylim(-1.2 * settled.max(), 1.2 * settled.max())
            for axes in (left, right):
                axes.set_xlim(0, periods_s)
                axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
            across = "time (s)" if name == "acceleration" else ""
            label(left, "State" if name == "position" else "", across, f"{name} ({unit})")
            label(right, "Estimate less truth" if name == "position" else "", across, f"error ({unit})")
        return figure


def dropout_figure(rows: Sequence[Record]) -> Figure:
    """The three readings of "residual" against dropout; bars: the 95 % interval."""
    shown = [row for row in rows if float(row["dropout"]) >= SHOWN[0]]
    titles = ("Error of the estimate", "Innovation", "What is left after the update")
    names = ("RMS over amplitude (%)", "RMS over sensor noise", "RMS over sensor noise")
    with drawing():
        figure, [plots] = sheet(1, 3, [line_entry(name, line) for name, line in LINES.items()], gap_mm=14.0)
        for axes, title, up, what in zip(plots, titles, names, ("error", "innovation", "after"), strict=True):
            for name in QUANTITIES if what == "error" else SENSORS:
                unit = 0.01 * OSCILLATOR_AMPLITUDES[name] if what == "error" else NOISES[name]
                value, *ends = (column(shown, f"{what} {end}{UNITS[name]}") / unit for end in ENDS)
                curve(axes, _spaced(column(shown, "dropout")), value, ends, LINES[name], name)
            label(axes, title, "dropout (%)", up)
            dropout_axis(axes)
        decades(plots[0], "y", 1, 20_000)
        level(plots[0], 100 * float(rows[0]["still"]), "motion ignored")
        decades(plots[1], "y", 0.7, 2_000)
        decades(plots[2], "y", 0.005, 3)
        plots[2].yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        return figure


def nees_figure(
    course: Columns, bounds: Mapping[str, tuple[float, float]], overall: Mapping[str, Sequence[Record]]
) -> Figure:
    """Left: mean NEES over the runs in each step, by filter; right: of all steps against dropout.

    bounds: by what they are of, the wider ones first.
    """
    lines = {name: line._replace(dashes="-") for name, line in zip(overall, SOURCE_LINES[1:], strict=False)}
    bands = dict(zip(bounds, BOUNDS, strict=True))
    with drawing():
        fills = {f"{group}:": band._replace(meaning=f"{band.meaning}, {group}") for group, band in bands.items()}
        legend = [*(line_entry(name, line) for name, line in lines.items()), *fill_entries(fills)]
        figure, [[left, right]] = sheet(1, 2, legend)
        for group, (low, high) in bounds.items():
            span_band(left, low, high, bands[group])
        for name, line in lines.items():
            left.plot(
                course["time_s"], course[name], line.marker, color=line.colour, ls=line.dashes, lw=0.8, ms=line.size,
                mew=0, markevery=12, label=name,
            )  # fmt: skip
        left.set(xlim=(course["time_s"][0], course["time_s"][-1]), ylim=(0, None))
        label(left, "Dropout 50 %", "time (s)", "NEES, mean over the runs")
        for name, rows in overall.items():
            shown = [row for row in rows if float(row["dropout"]) >= SHOWN[0]]
            at, value, line = _spaced(column(shown, "dropout")), column(shown, "nees"), lines[name]
            right.plot(
                at, value, line.marker, color=line.colour, ms=line.size, mew=0, ls=line.dashes, lw=1.0, label=name
            )
        right.set_ylim(0, None)
        for axes in (left, right):
            axes.axhline(3.0, color=INK, lw=0.7, zorder=1)
        dropout_axis(right)
        label(right, "All steps", "dropout (%)", "NEES, mean over runs and steps")
        return figure


def dropout_axis(axes: Axes) -> None:
    """An axis of the time between measurements, logarithmic, that names the dropout; the claim's end is marked."""
    axes.set_xscale("log")
    axes.set_xlim(0.95 * _gap(SHOWN[0]), 1.2 * _gap(SHOWN[-1]))
    axes.xaxis.set_major_locator(FixedLocator([_gap(dropout) for dropout in SHOWN]))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda gap, _: f"{100 * (1 - 1 / gap):.0f}"))
    axes.fmt_xdata = lambda gap: f"{100 * (1 - 1 / gap):.3g}"
    axes.axvline(_gap(CLAIMED), color=GREY, lw=0.9, ls=(0, (2, 1.5)), zorder=1)


def _gap(dropout: float) -> float:
    """Mean time between measurements, in their intervals without dropout."""
    return 1 / (1 - dropout)


def _spaced(dropouts: FloatArray) -> FloatArray:
    return 1 / (1 - dropouts)


def column(rows: Iterable[Record], name: str) -> FloatArray:
    """As numbers."""
    return np.array([float(row[name]) for row in rows])


def curve(axes: Axes, across: FloatArray, up: FloatArray, ends: Sequence[FloatArray], line: Line, name: str) -> None:
    """With bars, whose ends are low and high."""
    low, high = ends
    drawn = axes.errorbar(
        across, up, [up - low, high - up], fmt=line.marker, color=line.colour, ms=line.size,
        mew=1.3 if line.marker == "|" else 0, ls=line.dashes, lw=1.0, elinewidth=0.8, capsize=1.6, capthick=0.8,
    )  # fmt: skip
    drawn.lines[0].set_label(name)


def level(axes: Axes, at: float, text: str) -> None:
    """A dashed line across, with what it is."""
    axes.axhline(at, color=GREY, lw=0.9, ls=(0, (2, 1.5)), zorder=1)
    axes.annotate(
        text, (0.02, at), (0, 2), xycoords=axes.get_yaxis_transform(), textcoords="offset points", va="bottom",
        size=SMALL_PT,
    )  # fmt: skip
