"""How the figures on modular filters look on paper, in grey and in the dark."""

from __future__ import annotations

import re

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from reports.drawing.style import METHOD_LINES
from reports.modular.costs import cost_figure
from reports.modular.late import late_figure
from reports.modular.oscillator import ESTIMATE, history_figure
from reports.modular.styles import KIND_LINES
from tests.reports.explorer.test_palette import contrast
from tests.reports.modular.page import rebuilt, stored

PAINT = re.compile(r"(?<![-\w])(fill|stroke): (#\w{6})")
HIGHEST_MM = 170.0
"""Two thirds of a printed page, with its caption."""


def figures() -> dict[str, str]:
    return {name: content.decode() for name, content in rebuilt().items() if name.endswith(".svg")}


def test_no_pale_fill_is_without_an_edge() -> None:
    """Of a chart's work, `FILLS` sees to it."""
    for name, figure in figures().items():
        for style in re.findall(r'style="([^"]*)"', figure if name != "one-fix.svg" else ""):
            paint = dict(PAINT.findall(style))
            if "fill" in paint and paint["fill"] != "#ffffff" and contrast(paint["fill"], "#ffffff") < 3:
                assert contrast(paint.get("stroke", "#ffffff"), "#ffffff") >= 3, f"{name}: {style}"


def test_a_figure_leaves_room_on_its_page() -> None:
    for name, figure in figures().items():
        across, down = map(float, re.findall(r'(?:width|height)="([\d.]+)pt"', figure)[:2])
        assert 170.0 * down / across <= HIGHEST_MM, name


def widths(figure: Figure, colour: str) -> tuple[set[float], set[float]]:
    """Of the curves of that colour in the plots, and in the legend, which is the last of the axes."""

    def of(lines: list[Line2D]) -> set[float]:
        return {line.get_linewidth() for line in lines if line.get_color() == colour and len(line.get_xdata()) > 1}

    *shown, legend = figure.axes
    return of([line for axes in shown for line in axes.lines if not line.get_label().startswith("_")]), of(legend.lines)


def test_a_curve_is_as_wide_in_the_legend_as_in_the_plot() -> None:
    rows = [
        {"way": way, "delay": str(delay), "error": "0.1", "se": "0.01", "longest": "9"}
        for way in ("recalculate", "larsen")
        for delay in (0, 5)
    ]
    late = late_figure({"position": rows})
    for way in ("recalculate", "larsen"):
        shown, told = widths(late, METHOD_LINES[way].colour)
        assert len(shown) == 1
        assert shown == told
    costs = cost_figure(stored().records("parts"), stored().measurements)
    for line in KIND_LINES.values():
        shown, told = widths(costs, line.colour)
        assert len(shown) == 1
        assert shown == told
    run = {"time_s": np.linspace(0, 4, 5)}
    for name in ("position", "velocity", "acceleration"):
        run |= {f"{name} {what}": np.ones(5) for what in ("true", "estimate", "sigma", "measured")}
    shown, told = widths(history_figure(run, 4.0), ESTIMATE.colour)
    assert len(shown) == 2
    assert shown == told
