"""How achieved l, wake-up latency and the time that was taken are spread over a run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator

from reports.drawing.legend import Entry, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import FILLS, GREY, INK, RED, Line, drawing
from studies.live.measure import Measured
from studies.live.taken import may_be_taken

PLOT_MM, BINS = 38.0, 30
PREDICTED = Line(INK, (0, (5, 2)), "None")
ELSEWHERE = Line(RED, "-", "s", 5.0)
FEWEST_SHOWN, MOST_LATER = 5, 6
"""Steps on the axis of achieved l, and those beyond the predicted one."""
WIDE = 50
"""Longest over shortest: ticks at powers of ten alone."""
UP, TIME = "% of the cycles", "time (us, logarithmic)"


def histograms_figure(measured: Measured) -> Figure:
    """Achieved l with the predicted one, latencies of HR's wake-ups, and what was taken with what disturbs a cycle."""
    with drawing():
        figure, ((landed, wake, taken),) = sheet(1, 3, _legend(measured), height_mm=PLOT_MM, gap_mm=13.0)
        _landed(landed, measured)
        _times(wake, [ns / 1e3 for ns in measured.wake], FILLS["HRP"].colour)
        label(wake, "wake-up latency of HR", TIME, "% of the wake-ups")
        limit = float(may_be_taken(measured.design, measured.predicted)) / 1e3
        _times(taken, [ns / 1e3 for ns in measured.taken], GREY)
        taken.axvline(limit, color=INK, lw=1.0, ls=(0, (1.0, 1.2)))
        low, high = taken.get_xlim()
        taken.set_xlim(low, max(high, 1.5 * limit))
        label(taken, "taken from a cycle", TIME, UP)
        return figure


def _legend(measured: Measured) -> list[Entry]:
    disturbs = Line(INK, (0, (1.0, 1.2)), "None")
    entries = [line_entry("predicted l", PREDICTED)]
    if any(l != measured.predicted for l in _drawn(measured)):
        entries.append(line_entry("landed elsewhere", ELSEWHERE, dashes=False))
    return [*entries, line_entry("more disturbs a cycle", disturbs)]


def _drawn(measured: Measured) -> list[int]:
    """The landings that are on the axis, ascending."""
    last = measured.predicted + MOST_LATER
    return sorted(l for l in set(measured.achieved) if l is not None and l <= last)


def _landed(axes: Axes, measured: Measured) -> None:
    counts = Counter(measured.achieved)
    landed = _drawn(measured)
    low, high = min([*landed, measured.predicted]), max([*landed, measured.predicted])
    wider = max(FEWEST_SHOWN - (high - low + 1), 0)
    low, high = low - wider // 2, high + wider - wider // 2
    shares = [100 * counts[l] / len(measured.achieved) for l in landed]
    colours = [FILLS["LRU"].colour if l == measured.predicted else RED for l in landed]
    axes.bar(landed, shares, 0.8, color=colours, lw=0)
    axes.axvline(measured.predicted, color=INK, lw=1.0, ls=PREDICTED.dashes)
    axes.set_xlim(low - 0.7, high + 0.7)
    axes.set_ylim(0, 105)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=7, integer=True))
    others = len(measured.achieved) - sum(counts[l] for l in landed)
    label(axes, f"achieved l{f' ({others} later or left out)' if others else ''}", "$l - k$ (high-rate steps)", UP)


def _times(axes: Axes, times_us: Sequence[float], colour: str) -> None:
    """Of a logarithmic axis: most are short, and few very long."""
    low, high = max(min(times_us), 1.0), max(max(times_us), 2.0)
    edges = np.geomspace(low, 1.01 * high, BINS + 1)
    counts, _ = np.histogram(np.maximum(times_us, low), bins=edges)
    axes.bar(edges[:-1], 100 * counts / len(times_us), np.diff(edges), align="edge", color=colour, ec=INK, lw=0.3)
    axes.set_xscale("log")
    axes.set_xlim(low, 1.01 * high)
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < WIDE * low else (1,)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
