"""The rocket's filter on slower and slower processors, in the report on modular filters: what is late, how late, and in
which step the GPS correction lands."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from statistics import median

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from filters.arrays import FloatArray
from filters.systems.rocket_filter import GPS
from reports.drawing.axes import decades
from reports.drawing.legend import fill_entries, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, PALE, RED, SMALL_PT, Fill, Line, drawing
from reports.modular.styles import BAND_EDGE_PT, WAY_LINES, WAY_NAMES
from reports.pages.stored import Rows, digits, rows_of
from studies.modular.rocket_schedule import (
    CONTROL_EVERY,
    GPS_DELAYS,
    JOBS,
    LAND_BY,
    PERIOD_MS,
    PURPOSES,
    URGENCIES,
    WAYS,
    Costs,
    MissRow,
    Progress,
    Run,
    Way,
    arrivals,
    chosen,
    clocks,
    compared_at,
    miss_curves,
    slowest_that_holds,
)

Columns = Mapping[str, FloatArray]
Record = Mapping[str, str]

TITLES = {"loop": "Loop: predict, IMU", "control": "Control task", "GPS": "GPS correction"}
URGENCY_TITLES = {"preempted": "GPS correction preempted", "in the loop": "GPS correction in the loop"}
BAND = {"band:": Fill(PALE, GREY, "", "95 % band")}
DEADLINES = {"band:": Fill("#f6e0e0", RED, "", "from the first to the last deadline")}
ARRIVALS = Line(GREY, "-", "")
SHOWN = (10, 20, 50, 100, 200, 500, 1000, 2000)
"""MHz with a number on the axis."""

LEAST_SHARE, LEVELS = 1e-3, 61
"""The shares that exceed response times are stored from 1 down to the least, on a logarithmic scale."""


TABLES = ("schedule-misses", "schedule-responses", "schedule-landings", "schedule-shares")


# ---------------------------------------------------------------------------------------------------- as stored tables


def schedule_tables(costs: Costs, progress: Progress = lambda _done, _total, _what: None) -> dict[str, Rows]:
    """`TABLES`, by name: simulated with these costs, the same every time."""
    rows = miss_curves(costs, clocks(costs), progress=progress)
    at = compared_at(rows)
    runs = [chosen(costs, way, urgency, at) for way in WAYS for urgency in URGENCIES]
    tables = (miss_table(rows), rows_of(responses(runs), "{:.4g}"), rows_of(landings(runs), "{:.3g}"), share_rows(runs))
    return dict(zip(TABLES, tables, strict=True))


def miss_table(rows: Iterable[MissRow]) -> Rows:
    """What `miss_rows_of` reads back, to three digits."""
    body = [[*row[:7], digits(row.late_ms) if row.late_ms else "0", digits(row.utilization)] for row in rows]
    return [[*MissRow._fields], *body]


def miss_rows_of(records: Iterable[Record]) -> list[MissRow]:
    """The rows of a table that `miss_table` made."""
    return [
        MissRow(
            record["way"],
            record["urgency"],
            int(record["clock_mhz"]),
            record["job"],
            int(record["misses"]),
            int(record["decided"]),
            int(record["cycles"]),
            float(record["late_ms"]),
            float(record["utilization"]),
        )
        for record in records
    ]


def column(run: Run, job: str = "GPS") -> str:
    """The name of a column of `responses` or `landings`."""
    return f"{job}, {run.way}, {run.urgency}"


def responses(runs: Iterable[Run]) -> dict[str, FloatArray]:
    """For each run and job the response time in ms that so large a share exceeds."""
    share = np.geomspace(1.0, LEAST_SHARE, LEVELS)
    columns: dict[str, FloatArray] = {"share": share}
    for run in runs:
        for job, values in run.responses_ms.items():
            ordered = np.array(values)
            at = np.minimum(np.floor(len(ordered) * (1 - share)).astype(np.int64), len(ordered) - 1)
            columns[column(run, job)] = ordered[at] if len(ordered) else np.full(LEVELS, np.nan)
    return columns


def landings(runs: Iterable[Run]) -> dict[str, FloatArray]:
    """For each run the percentage of all GPS measurements that arrived, whose correction landed at l - k; and of
    `arrivals`. The runs are of `STEPS` and `SEED`."""
    kept = list(runs)
    steps = range(max([LAND_BY, *(step for run in kept for step in run.achieved)]) + 1)
    fixes = arrivals()
    columns: dict[str, FloatArray] = {"l - k": np.array(steps, dtype=np.float64)}
    columns["arrivals"] = np.array([100 * fixes[step] / fixes.total() for step in steps])
    for run in kept:
        arrived = max(run.outcome.sensors[GPS].arrived, 1)
        columns[column(run)] = np.array([100 * run.achieved[step] / arrived for step in steps])
    return columns


# -------------------------------------------------------------------------------------------------- tables to be read


def verdict_rows(rows: Sequence[MissRow], at: int) -> Rows:
    """Down to which clock each way holds, and what is late on a processor of `at` MHz, with 95 % intervals."""
    heading = [
        "late GPS fix", "its correction", "holds from, MHz", f"busy at {at} MHz, %", "loop missed, %",
        "by at most, ms", "control missed, %", "GPS missed, %",
    ]  # fmt: skip
    table: Rows = [heading]
    for way in WAYS:
        for urgency in URGENCIES:
            there = {row.job: row for row in rows if (row.way, row.urgency, row.clock_mhz) == (way.name, urgency, at)}
            held = slowest_that_holds(rows, way.name, urgency)
            if not there:
                table.append([WAY_NAMES[way.name], urgency, "-" if held is None else held, *["-"] * 5])
                continue
            loop, control, gps = (there[job] for job in JOBS)
            table.append([
                WAY_NAMES[way.name], urgency, "-" if held is None else held, f"{100 * loop.utilization:.0f}",
                missed_percent(loop), f"{loop.late_ms:.0f}", missed_percent(control), missed_percent(gps),
            ])  # fmt: skip
    return table


def missed_percent(row: MissRow) -> str:
    """The share of deadlines missed, with its interval; where none is, only what it may be."""
    share, low, high = (f"{100 * value:.1f}" for value in (row.probability, *row.interval))
    return f"{share} ({low} to {high})" if row.misses else f"none (≤ {high})"


def share_rows(runs: Iterable[Run]) -> Rows:
    """What the processor's time is spent on, in percent, and when the GPS correction lands after it arrived."""
    purposes = (f"{purpose} (%)" for purpose in PURPOSES)
    table: Rows = [["late GPS fix", "its correction", "MHz", *purposes, "idle (%)", "GPS response, median (ms)"]]
    for run in runs:
        spent = [run.shares[purpose] for purpose in PURPOSES]
        shares = [f"{100 * share:.1f}" for share in (*spent, 1 - sum(spent))]
        gps = run.responses_ms["GPS"]
        table.append([run.way, run.urgency, run.clock_mhz, *shares, f"{median(gps):.1f}" if gps else "-"])
    return table


# ------------------------------------------------------------------------------------------------------------ figures


def miss_figure(rows: Sequence[MissRow]) -> Figure:
    """The probability of a miss against the clock of the processor; a row of plots for each urgency."""
    ends = min(row.clock_mhz for row in rows) / 1.15, 1.15 * max(row.clock_mhz for row in rows)
    with drawing():
        legend = [*(line_entry(WAY_NAMES[name], line) for name, line in WAY_LINES.items()), *fill_entries(BAND)]
        figure, plots = sheet(len(URGENCIES), len(JOBS), legend, height_mm=32.0, gap_mm=9.0)
        for of_urgency, urgency in zip(plots, URGENCIES, strict=True):
            for axes, job in zip(of_urgency, JOBS, strict=True):
                for name, line in WAY_LINES.items():
                    of_way = [row for row in rows if (row.way, row.urgency, row.job) == (name, urgency, job)]
                    _miss_curve(axes, of_way, WAY_NAMES[name], line)
                _clock_axis(axes, ends)
                _probability_axis(axes)
                _titles(axes, urgency, job, "deadlines missed (%)")
                if urgency == [*URGENCIES][-1]:
                    label(axes, across="clock of the processor (MHz)")
        return figure


def response_figure(columns: Columns) -> Figure:
    """The share of jobs that take longer than a time, from their release; columns: from `responses`."""
    with drawing():
        legend = [*(line_entry(WAY_NAMES[name], line) for name, line in WAY_LINES.items()), *fill_entries(DEADLINES)]
        figure, plots = sheet(len(URGENCIES), len(JOBS), legend, height_mm=32.0, gap_mm=9.0)
        times = {job: [columns[name] for name in columns if name.startswith(f"{job}, ")] for job in JOBS}
        for of_urgency, urgency in zip(plots, URGENCIES, strict=True):
            for axes, job in zip(of_urgency, JOBS, strict=True):
                for start, way in enumerate(WAYS):
                    line = WAY_LINES[way.name]
                    values = columns[f"{job}, {way.name}, {urgency}"]
                    axes.plot(
                        values, 100 * columns["share"], line.marker, color=line.colour, ls=line.dashes, lw=1.2,
                        ms=0.9 * line.size, mew=0, markevery=(5 * start, 15), label=WAY_NAMES[way.name],
                    )  # fmt: skip
                decades(axes, "y", 100 * LEAST_SHARE, 130)
                axes.yaxis.set_major_formatter(FuncFormatter(lambda share, _: f"{share:g}"))
                _time_axis(axes, np.concatenate([*times[job], _deadline_ms(job)]))
                _mark_deadline(axes, job)
                _titles(axes, urgency, job, "jobs that take longer (%)")
                if urgency == [*URGENCIES][-1]:
                    label(axes, across="response time (ms)")
        return figure


SHOWN_LANDINGS = (
    (WAYS[0], "preempted"),
    (WAYS[1], "preempted"),
    (WAYS[1], "in the loop"),
    (WAYS[2], "preempted"),
)


def landing_figure(columns: Columns) -> Figure:
    """How many of the GPS corrections land at each l - k, beside when they arrive; columns: from `landings`."""
    with drawing():
        legend = [line_entry("when the fixes arrive", ARRIVALS)]
        figure, plots = sheet(2, 2, legend, height_mm=30.0, gap_mm=12.0)
        highest = max(columns[name].max() for name in columns if name != "l - k")
        seen = [columns["l - k"][columns[_landing(*case)] > 0] for case in SHOWN_LANDINGS]
        last = max([LAND_BY, *(steps.max() for steps in seen if len(steps))])
        for axes, (way, urgency) in zip((axes for row in plots for axes in row), SHOWN_LANDINGS, strict=True):
            colour = WAY_LINES[way.name].colour
            axes.bar(columns["l - k"], columns[_landing(way, urgency)], 0.8, color=colour, lw=0)
            axes.stairs(columns["arrivals"], np.arange(len(columns["l - k"]) + 1) - 0.5, color=ARRIVALS.colour, lw=1.1)
            axes.set(xlim=(0, last + 1), ylim=(0, 1.15 * highest))
            axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
            axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
            _line(axes, LAND_BY + 0.5, "deadline")
            label(axes, f"{WAY_NAMES[way.name]}: {urgency}")
        for row in plots:
            label(row[0], up="share of fixes (%)")
        for axes in plots[-1]:
            label(axes, across="$l - k$ (steps of 10 ms)")
        return figure


def _landing(way: Way, urgency: str) -> str:
    return f"GPS, {way.name}, {urgency}"


def _miss_curve(axes: Axes, rows: Sequence[MissRow], name: str, line: Line) -> None:
    """With its 95 % band."""
    across = [row.clock_mhz for row in rows]
    low, high = (np.array([100 * row.interval[side] for row in rows]) for side in (0, 1))
    axes.fill_between(across, low, high, facecolor=(line.colour, 0.18), edgecolor=line.colour, lw=BAND_EDGE_PT)
    axes.plot(
        across, [100 * row.probability for row in rows], line.marker, color=line.colour, ms=0.75 * line.size, mew=0,
        ls=line.dashes, lw=1.0, label=name,
    )  # fmt: skip


def _titles(axes: Axes, urgency: str, job: str, up: str) -> None:
    """The job above a column, the urgency beside a row."""
    if urgency == next(iter(URGENCIES)):
        label(axes, TITLES[job])
    if job == next(iter(JOBS)):
        label(axes, up=f"{URGENCY_TITLES[urgency]}:\n{up}")


def _probability_axis(axes: Axes) -> None:
    """Percent, by their square roots: so that 0 is there, and 1 is seen."""
    axes.set_yscale("function", functions=(lambda share: np.sqrt(np.maximum(share, 0)), np.square))
    axes.set_ylim(0, 104)
    axes.yaxis.set_major_locator(FixedLocator([0, 1, 5, 20, 50, 100]))
    axes.yaxis.set_minor_locator(NullLocator())


def _clock_axis(axes: Axes, ends: tuple[float, float]) -> None:
    axes.set_xscale("log")
    axes.set_xlim(*ends)
    axes.xaxis.set_major_locator(FixedLocator([number for number in SHOWN if ends[0] <= number <= ends[1]]))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))


TIMES_MS = tuple(digit * 10**power for power in range(-1, 6) for digit in (1, 2, 5))


def _time_axis(axes: Axes, values: FloatArray) -> None:
    """Logarithmic, with round numbers."""
    low, high = np.nanmin(values) / 1.2, 1.2 * np.nanmax(values)
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    shown = [time for time in TIMES_MS if low <= time <= high]
    axes.xaxis.set_major_locator(FixedLocator(shown if len(shown) < 8 else shown[::3]))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda time, _: f"{time:g}"))


def _deadline_ms(job: str) -> list[float]:
    """From the release. Of the GPS correction the first and the last: the sooner a fix arrives the more time it has."""
    if job == "GPS":
        return [PERIOD_MS * (LAND_BY + 1 - delay) for delay in (GPS_DELAYS[-1], GPS_DELAYS[0])]
    return [PERIOD_MS * (CONTROL_EVERY if job == "control" else 1)]


def _mark_deadline(axes: Axes, job: str) -> None:
    first, *later = _deadline_ms(job)
    for last in later:
        fill = DEADLINES["band:"]
        axes.axvspan(first, last, facecolor=fill.colour, edgecolor=fill.ink, lw=BAND_EDGE_PT, zorder=0)
    if not later:
        _line(axes, first, "deadline")


def _line(axes: Axes, at: float, text: str) -> None:
    """Red, its name on the side where there is room."""
    axes.axvline(at, color=RED, lw=1.0)
    transform = axes.transData + axes.transAxes.inverted()
    right = transform.transform((at, 1.0))[0] > 0.5
    axes.annotate(
        text, (at, 1), (-2.5 if right else 2.5, -2), xycoords=axes.get_xaxis_transform(), textcoords="offset points",
        ha="right" if right else "left", va="top", size=SMALL_PT, color=RED,
    )  # fmt: skip
