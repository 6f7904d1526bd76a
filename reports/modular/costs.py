"""What predict and correct cost in the report on modular filters, by kind and number of states."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.axes import decades
from reports.drawing.legend import Entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, drawing
from reports.modular.styles import KIND_LINES, curve_entry
from reports.pages.machine import marked
from studies.machines.parts import PartName, PartTimes
from studies.machines.ranges import Range, range_of

Record: TypeAlias = Mapping[str, str]

WIDTHS = {"linear": 2.6}
"""The curve of the extended parts lies on it."""
OPERATIONS, TIME = "operations", "time"
"""Names of the columns."""


def cost_figure(rows: Sequence[Record], measurements: Sequence[PartTimes]) -> Figure:
    """Above, operations; below, least times by the last measurement, with a bar over those of all: of predict at
    the left, of correct at the right."""
    shown = {OPERATIONS: ("operations", 60, 40_000), TIME: (f"least time, {marked('compiled')} (µs)", 0.015, 5)}
    rows = [{**row, TIME: str(measurements[-1].parts[_key(row)].least)} for row in rows]
    states = sorted({int(row["states"]) for row in rows})
    with drawing():
        legend = [
            *(curve_entry(kind, line, _width(kind)) for kind, line in KIND_LINES.items()),
            Entry(marked("all measurements"), 1.2, _bar),
        ]
        figure, plots = sheet(2, 2, legend, height_mm=30.0)
        for of_row, (column, (up, low, high)) in zip(plots, shown.items(), strict=True):
            for axes, part in zip(of_row, ("predict", "correct"), strict=True):
                for kind, line in KIND_LINES.items():
                    of_kind = [row for row in rows if (row["kind"], row["part"]) == (kind, part)]
                    for row in of_kind if column == TIME else ():
                        axes.vlines(int(row["states"]), *_over(measurements, row), color=INK, lw=0.8, zorder=3)
                    axes.plot(
                        [int(row["states"]) for row in of_kind], [float(row[column]) for row in of_kind], line.marker,
                        color=line.colour, ms=line.size, mew=0, ls=line.dashes, lw=_width(kind),
                        label=kind,
                    )  # fmt: skip
                axes.set_xscale("log")
                axes.set_xlim(states[0] / 1.1, states[-1] * 1.1)
                axes.xaxis.set_major_locator(FixedLocator(states))
                axes.xaxis.set_minor_locator(NullLocator())
                axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0f}"))
                decades(axes, "y", low, high)
                axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
                title = part.capitalize() if column == OPERATIONS else ""
                label(axes, title, "states", up if part == "predict" else "")
        return figure


def _width(kind: str) -> float:
    return WIDTHS.get(kind, 1.1)


def _bar(axes: Axes, x: float, y: float) -> None:
    axes.plot([x + 0.6] * 2, [y - 1.4, y + 1.4], color=INK, lw=0.8)


def _key(row: Record) -> PartName:
    return row["kind"], row["states"], row["part"]


def _over(measurements: Sequence[PartTimes], row: Record) -> Range[float]:
    return range_of(lambda times: times.parts[_key(row)].least, measurements)
