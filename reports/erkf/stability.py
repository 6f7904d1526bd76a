"""Whether the filter of a linear system is stable and convergent: P from different starts, and estimates that begin
apart."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, decades, plain
from reports.drawing.legend import draw_legend, legend_height, line_entry
from reports.drawing.style import TITLE_PT, WIDTH_MM, Line, axes_at, drawing, page
from reports.erkf.styles import EKF, ERKF, LIMIT
from reports.pages.stored import Rows, digits, rows_of
from studies.robust.linear import CASES, KALMAN
from studies.robust.stability import STARTS, Sample, convergence, sample, stability

LEFT_MM, RIGHT_MM, GAP_MM, ROW_MM, BETWEEN_MM = 20.0, 4.0, 16.0, 38.0, 5.0
LINES = {KALMAN: EKF, "robust, μ = 1": ERKF, "robust, μ = ∞": LIMIT}
TITLES = {"decaying": "States decay (Sayed's example)", "growing": "A state grows by 5 % a step"}
LEAST = 1e-6
"""Of the distance of two estimates: what is less is not drawn."""

SAMPLES = (
    ("finite μ, one noise", 10.0, 1),
    ("μ = ∞, two noises", np.inf, 2),
    ("μ = ∞, one noise", np.inf, 1),
)


def stability_tables() -> dict[str, Rows]:
    """What the report asks of the study, in two minutes: the same on every machine, to the digits that are stored,
    but for how many filters rounding stops."""
    linear: Rows = [["system", "filter", "of_system", "radius", "steps", "error_50", "error_200", "wrong"]]
    curves: dict[str, FloatArray] = {}
    for case in CASES:
        found, shown = stability(case), convergence(case)
        numbers = [digits(value) for value in (found.of_system, found.radius)]
        errors = [digits(value) for value in (*found.error, found.wrong)]
        linear.append([case.system, case.name, *numbers, found.steps, *errors])
        curves["step"] = np.arange(len(shown.apart), dtype=np.float64)
        name = f"{case.system}, {case.name}"
        curves |= {f"{name}: P from {start:g}": largest for start, largest in zip(STARTS, shown.largest, strict=True)}
        curves[f"{name}: apart"] = np.where(shown.apart >= LEAST, shown.apart, np.nan)
    return {
        "linear": linear,
        "linear-curves": rows_of(curves, "{:.4g}"),
        "linear-sample": [list(Sample._fields), *(_sample_row(sample(*asked)) for asked in SAMPLES)],
    }


def _sample_row(found: Sample) -> list[Any]:
    return [found.name, found.systems, found.kept, found.steps, f"{found.radius:.4f}", found.stopped]


def stability_figure(curves: Mapping[str, FloatArray]) -> Figure:
    """A column for each system. Above, the largest singular value of P from each start; below, how far two estimates
    are apart. curves: the table "linear-curves"."""
    with drawing():
        across = WIDTH_MM - LEFT_MM - RIGHT_MM
        width = (across - GAP_MM * (len(TITLES) - 1)) / len(TITLES)
        legend = [line_entry(name, line) for name, line in LINES.items()]
        second = EDGE_MM + TITLE_MM + ROW_MM + BETWEEN_MM
        legend_top = second + ROW_MM + AXIS_MM
        figure = page(legend_top + legend_height(legend, across) + EDGE_MM)
        for column, (system, title) in enumerate(TITLES.items()):
            left = LEFT_MM + column * (width + GAP_MM)
            values = axes_at(figure, left, EDGE_MM + TITLE_MM, width, ROW_MM)
            distances = axes_at(figure, left, second, width, ROW_MM)
            for name, line in LINES.items():
                for start in STARTS:
                    of_start = curves[f"{system}, {name}: P from {start:g}"]
                    _curve(values, curves["step"], of_start, line, f"{name}, from {start:g}")
                _curve(distances, curves["step"], curves[f"{system}, {name}: apart"], line, name)
            decades(values, "y", STARTS[0] / 2, 2 * STARTS[-1])
            decades(distances, "y", LEAST, 3.0, every=2)
            values.set_title(title, loc="left", size=TITLE_PT)
            values.tick_params(axis="x", labelbottom=False)
            distances.set_xlabel("step", labelpad=2)
            if column == 0:
                values.set_ylabel("largest singular\nvalue of $P$", labelpad=2)
                distances.set_ylabel("distance of two\nestimates", labelpad=2)
            for axes in (values, distances):
                axes.set_xlim(-1, curves["step"][-1] + 1)
                plain(axes)
        draw_legend(figure, legend, LEFT_MM, legend_top, across)
        return figure


def _curve(axes: Axes, steps: FloatArray, values: FloatArray, line: Line, name: str) -> None:
    axes.plot(
        steps, values, line.marker, color=line.colour, ms=line.size, mew=0, ls=line.dashes, lw=0.9, markevery=10,
        label=name,
    )  # fmt: skip
