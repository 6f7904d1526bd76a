"""The rocket of the report on modular filters: a flight, its residuals against the claim, consistency."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator, StrMethodFormatter

from filters.arrays import FloatArray
from reports.drawing.axes import decades
from reports.drawing.legend import fill_entries, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, INK, PALE, RED, Fill, Line, drawing
from reports.modular.oscillator import BAND, ERROR_PT, ESTIMATE, ESTIMATE_PT, TRUE, TRUE_PT
from reports.modular.styles import DROPOUT_LINES, QUANTITY_LINES, apart, band, curve_entry, span_band
from studies.modular.rocket import CLAIM_PERCENT

Columns: TypeAlias = Mapping[str, FloatArray]

SHOWN = {"height": "m", "climb": "m/s", "acceleration": "m/s²", "tilt": "°"}
"""All upward; tilt is that of the nose from the vertical, its error that about one axis across the nose."""
DROPOUTS = tuple(DROPOUT_LINES)
QUANTITIES = tuple(QUANTITY_LINES)
BOUNDS = {"bounds:": Fill(PALE, GREY, "", "95 % bounds")}
HALVES: Mapping[str, str | tuple[int, tuple[float, ...]]] = {"half of the flights": "-", "95 %": (0, (1.0, 1.2))}
"""So many of them are below the curve."""
CLAIM = Line(RED, (0, (4.0, 1.5)), "")


def flight_figure(flight: Columns, burnout_s: float) -> Figure:
    """One flight: states at the left, errors at the right; a line where the motor goes out."""
    with drawing():
        legend = [
            curve_entry("true", TRUE, TRUE_PT),
            curve_entry("estimate", ESTIMATE, ESTIMATE_PT),
            curve_entry("its error", ESTIMATE, ERROR_PT),
            *fill_entries(BAND),
        ]
        figure, rows = sheet(len(SHOWN), 2, legend, height_mm=22.0, stacked=True)
        time_s = flight["time_s"]
        for (left, right), (name, unit) in zip(rows, SHOWN.items(), strict=True):
            error, sigma = flight[f"{name} error"], flight[f"{name} sigma"]
            left.plot(time_s, flight[f"{name} estimate"], color=ESTIMATE.colour, lw=ESTIMATE_PT, label="estimate")
            left.plot(time_s, flight[f"{name} true"], color=INK, lw=TRUE_PT, label="true")
            band(right, time_s, -2 * sigma, 2 * sigma, BAND["band:"])
            right.axhline(0.0, color=INK, lw=0.6)
            right.plot(time_s, error, color=ESTIMATE.colour, lw=ERROR_PT, label="error")
            for axes in (left, right):
                axes.set_xlim(time_s[0], time_s[-1])
                axes.axvline(burnout_s, color=GREY, lw=0.9, ls=(0, (2, 1.5)), zorder=1)
                axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
            across = "time since ignition (s)" if name == "tilt" else ""
            left.yaxis.set_major_formatter(StrMethodFormatter("{x:,g}"))
            flying = time_s > 0
            most = 1.2 * max(np.abs(error[flying]).max(), 2 * sigma[flying].max())
            right.set_ylim(-most, most)
            label(left, "State" if name == "height" else "", across, f"{name} ({unit})")
            label(right, "Estimate less truth" if name == "height" else "", across, f"error ({unit})")
        return figure


def residual_figure(series: Columns, readings: Sequence[str]) -> Figure:
    """Four readings of the claim over the time since ignition: the median of the flights, and what 95 % are below.

    series: "time_s", and "READING, DROPOUT, WHICH" in percent, which of `HALVES`.
    """
    with drawing():
        legend = apart(
            {
                "Dropout": [line_entry(dropout, line) for dropout, line in DROPOUT_LINES.items()],
                "Below the curve are": [line_entry(name, Line(INK, dashes, "")) for name, dashes in HALVES.items()],
                "The claim": [line_entry(f"{CLAIM_PERCENT:g} %", CLAIM)],
            }
        )
        figure, rows = sheet(2, 2, legend, height_mm=34.0)
        for number, reading in enumerate(readings):
            axes = rows[number // 2][number % 2]
            for start, (dropout, line) in enumerate(DROPOUT_LINES.items()):
                for name, dashes in HALVES.items():
                    curve = series[f"{reading}, {dropout}, {name}"]
                    axes.plot(
                        series["time_s"], curve, line.marker, color=line.colour, ls=dashes, lw=1.2, ms=0.8 * line.size,
                        mew=0, markevery=(2 * start, 9), label=f"dropout {dropout}, {name}",
                    )  # fmt: skip
            axes.axhline(CLAIM_PERCENT, color=CLAIM.colour, ls=CLAIM.dashes, lw=1.0)
            decades(axes, "y", 0.005, 1000)
            axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
            _seconds(axes, series["time_s"])
            error, over = reading.split(" / ")
            label(axes, f"{error[0].upper()}{error[1:]} over {over}", "time since ignition (s)", "residual (%)")
        return figure


def nees_figure(series: Columns, bounds: tuple[float, float]) -> Figure:
    """NEES of all 15 errors over time, by dropout. series: "time_s" and the dropouts."""
    with drawing():
        legend = [
            *(line_entry(f"dropout {dropout}", line) for dropout, line in DROPOUT_LINES.items()),
            *fill_entries(BOUNDS),
        ]
        figure, [[above]] = sheet(1, 1, legend, height_mm=42.0)
        span_band(above, *bounds, BOUNDS["bounds:"])
        for start, (dropout, line) in enumerate(DROPOUT_LINES.items()):
            above.plot(
                series["time_s"], series[dropout], line.marker, color=line.colour, ls="-", lw=0.9, ms=0.8 * line.size,
                mew=0, markevery=(9 * start, 37), label=f"dropout {dropout}",
            )  # fmt: skip
        decades(above, "y", 3, 2000)
        above.set_xlim(series["time_s"][0], series["time_s"][-1])
        above.xaxis.set_major_locator(MaxNLocator(nbins=12, steps=[1, 2, 5, 10]))
        above.axhline(15.0, color=INK, lw=0.7, zorder=1)
        label(above, "", "time since ignition (s)", "NEES, mean over flights")
        return figure


def phase_figure(of_phase: Mapping[str, Sequence[tuple[float, float]]], bounds_of_three: tuple[float, float]) -> Figure:
    """NEES of each quantity's three errors in each phase, without dropout. of_phase: mean and standard error of each
    quantity."""
    with drawing():
        legend = [
            *(line_entry(name, line, dashes=False) for name, line in QUANTITY_LINES.items()),
            *fill_entries(BOUNDS),
        ]
        figure, [[below]] = sheet(1, 1, legend, height_mm=42.0)
        span_band(below, *bounds_of_three, BOUNDS["bounds:"])
        for at, values in enumerate(of_phase.values()):
            for number, ((mean, error), line) in enumerate(zip(values, QUANTITY_LINES.values(), strict=True)):
                below.errorbar(
                    [at + 0.14 * (number - 2)], [mean], [2 * error], fmt=line.marker, color=line.colour,
                    ms=line.size + 0.8, mew=0, elinewidth=0.9,
                )  # fmt: skip
        below.axhline(3.0, color=INK, lw=0.7, zorder=1)
        below.set(xlim=(-0.6, len(of_phase) - 0.4), ylim=(0, None))
        below.xaxis.set_major_locator(FixedLocator(list(range(len(of_phase)))))
        below.set_xticklabels(list(of_phase))
        label(below, "", "phase of the flight", "NEES, mean over the phase")
        return figure


def _seconds(axes: Axes, time_s: FloatArray) -> None:
    axes.set_xscale("log")
    axes.set_xlim(time_s[0], time_s[-1])
    axes.xaxis.set_major_locator(FixedLocator([0.1, 0.2, 0.5, 1, 2, 5, 10, 20]))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
