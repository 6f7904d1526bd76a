"""Figures on the ratio in steady state: by what is done with the gain, and by the rule that tells up to which n."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import INK, SMALL_PT, Line, drawing
from reports.multirate.ratio_axis import LEAST, ratio_axis
from reports.multirate.styles import FAMILY_LINES, READING_LINES
from studies.multirate.accuracy import Reading

READINGS_MM, RULE_MM = 58.0, 62.0
SHARES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)


class Point(NamedTuple):
    """A system at some n. spent: (n - 1) K."""

    spent: float
    ratio: float


def readings_figure(
    vehicles: Mapping[str, Mapping[Reading, Mapping[int, float]]], readings: Mapping[Reading, str]
) -> Figure:
    """A plot for each receiver: the ratio against n of three filters that compute equally many gains.

    vehicles: by title; readings: as the legend names them.
    """
    with drawing():
        legend = [line_entry(name, READING_LINES[reading]) for reading, name in readings.items()]
        figure, [plots] = sheet(1, len(vehicles), legend, height_mm=READINGS_MM, gap_mm=6.0)
        highest = 1.6 * max(ratio for of in vehicles.values() for ratios in of.values() for ratio in ratios.values())
        for axes, (title, of_vehicle) in zip(plots, vehicles.items(), strict=True):
            ratio_axis(axes, highest, numbers=axes is plots[0])
            for reading, name in readings.items():
                line = READING_LINES[reading]
                losses = {n: ratio - 1 for n, ratio in of_vehicle[reading].items() if ratio - 1 > LEAST}
                axes.plot(
                    list(losses), list(losses.values()), line.marker, color=line.colour, ms=0.8 * line.size, mew=0,
                    ls=line.dashes, lw=1.0, label=name,
                )  # fmt: skip
            last = max(max(ratios) for ratios in of_vehicle.values())
            axes.set_xlim(0.3, last + 0.7)
            axes.xaxis.set_major_locator(FixedLocator([1, *range(5, last + 1, 5)]))
            label(axes, title, "$n$ (steps for each gain)")
        plots[0].set_ylabel("position variance over the optimum", labelpad=2)
        return figure


def rule_figure(points: Mapping[str, Sequence[Point]], limit: float) -> Figure:
    """The ratio of every system and n against (n - 1) K, with that of a slow scalar filter.

    points: by kind of system; limit: where that curve reaches GOOD.
    """
    with drawing():
        line_of_rule = Line(INK, "-", "None")
        legend = [line_entry(kind, FAMILY_LINES[kind], dashes=False) for kind in points]
        legend.append(line_entry("slow scalar filter: $1 + ((n-1)K)^2/8$", line_of_rule))
        figure, [[axes]] = sheet(1, 1, legend, height_mm=RULE_MM)
        everything = [point for of_kind in points.values() for point in of_kind if point.ratio - 1 > LEAST]
        high = 1.3 * max(point.spent for point in everything)
        ratio_axis(axes, 1.6 * max(point.ratio for point in everything))
        axes.set_xscale("log")
        low = 0.8 * (8 * LEAST) ** 0.5
        axes.set_xlim(low, high)
        axes.xaxis.set_major_locator(FixedLocator([share for share in SHARES if low <= share <= high]))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        for kind, of_kind in points.items():
            line = FAMILY_LINES[kind]
            seen = [point for point in of_kind if point.ratio - 1 > LEAST]
            axes.plot(
                [point.spent for point in seen], [point.ratio - 1 for point in seen], line.marker, color=line.colour,
                ms=line.size, mew=0, alpha=0.85, ls="None", label=kind,
            )  # fmt: skip
        spent = np.geomspace(low, high, 60)
        axes.plot(spent, spent**2 / 8, color=line_of_rule.colour, lw=1.1, zorder=1.5)
        axes.axvline(limit, color=INK, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
        note = axes.annotate(
            f"$(n-1)K$ = {limit:.2f}",
            (limit, axes.get_ylim()[1]),
            (3, -2),
            textcoords="offset points",
            size=SMALL_PT,
            va="top",
        )
        note.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
        label(
            axes,
            "Every system, every $n$ from 2 on",
            "$(n-1)K$: $K$ is the share of an innovation that the filter believes",
        )
        axes.set_ylabel("position variance over the optimum", labelpad=2)
        return figure
