"""Late measurements in the report on modular filters: errors and costs of each way to use them, against the delay."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, StrMethodFormatter

from filters.arrays import FloatArray
from reports.charts.panels import METHOD_NAMES
from reports.drawing.sheet import label, sheet
from reports.drawing.style import METHOD_LINES, drawing
from reports.modular.oscillator import OSCILLATOR_AMPLITUDES
from reports.modular.styles import curve_entry
from studies.modular.late_measurements import WAYS

Record: TypeAlias = Mapping[str, str]

LINES = {str(way): METHOD_LINES[way] for way in WAYS}
WIDTHS = {"recalculate": 2.2}
"""Its curve lies under Larsen's, and is to be seen at both sides of it."""


def late_figure(by_sensors: Mapping[str, Sequence[Record]]) -> Figure:
    """A column for each set of sensors: above, the error of position; below, the work of the longest step."""
    unit = 0.01 * OSCILLATOR_AMPLITUDES["position"]
    with drawing():
        legend = [curve_entry(METHOD_NAMES[way], line, _width(way)) for way, line in LINES.items()]
        figure, rows = sheet(2, len(by_sensors), legend, height_mm=32.0, stacked=True)
        for column, (sensors, records) in enumerate(by_sensors.items()):
            for way in dict.fromkeys(row["way"] for row in records):
                of_way = [row for row in records if row["way"] == way]
                delay = _column(of_way, "delay")
                error, bar = (_column(of_way, name) / unit for name in ("error", "se"))
                line, width = LINES[way], _width(way)
                drawn = rows[0][column].errorbar(
                    delay, error, 2 * bar, fmt=line.marker, color=line.colour, ms=line.size, mew=0, ls=line.dashes,
                    lw=width, elinewidth=0.8,
                )  # fmt: skip
                drawn.lines[0].set_label(METHOD_NAMES[way])
                rows[1][column].plot(
                    delay, _column(of_way, "longest"), line.marker, color=line.colour, ms=line.size, mew=0,
                    ls=line.dashes, lw=width, label=METHOD_NAMES[way],
                )  # fmt: skip
            for row in rows:
                row[column].set_ylim(0, None)
                row[column].yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
            rows[1][column].yaxis.set_major_formatter(StrMethodFormatter("{x:,g}"))
            label(rows[0][column], sensors[0].upper() + sensors[1:])
            label(rows[1][column], "", "delay (steps)")
        label(rows[0][0], up="RMS error of position (%)")
        label(rows[1][0], up="operations, longest step")
        return figure


def _width(way: str) -> float:
    return WIDTHS.get(way, 1.0)


def _column(rows: Sequence[Record], name: str) -> FloatArray:
    return np.array([float(row[name]) for row in rows])
