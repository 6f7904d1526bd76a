"""What plots of reports share: sizes, logarithmic axes, names at the ends of curves."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, floor, log10
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.placing import spread
from reports.drawing.style import PALE, SMALL_PT

EDGE_MM, TITLE_MM, AXIS_MM = 2.0, 6.0, 10.5
LINE_MM = 2.9
"""Height of a line of small text."""


def decades(axes: Axes, which: Literal["x", "y"], low: float, high: float, *, every: int = 1) -> None:
    """A logarithmic axis with a number at every so many powers of ten: plain up to 100,000, as a power beyond."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    (axes.set_xscale if which == "x" else axes.set_yscale)("log")
    (axes.set_xlim if which == "x" else axes.set_ylim)(low, high)
    exponents = [n for n in range(ceil(log10(low)), floor(log10(high)) + 1) if n % every == 0]
    axis.set_major_locator(FixedLocator([10.0**n for n in exponents]))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: power_of_ten(value)))
    axes.grid(axis=which, color=PALE, lw=0.5)


def power_of_ten(value: float) -> str:
    exponent = round(log10(value))
    return f"{10**exponent:,}" if 0 <= exponent <= 5 else f"$10^{{{exponent}}}$"


def plain(axes: Axes) -> None:
    axes.spines[["right", "top"]].set_visible(False)


def end_labels(axes: Axes, heights: Sequence[float], texts: Sequence[str], height_mm: float) -> None:
    """Texts right of the axes, each as near to its height (in the units of the y axis) as the others let it be."""
    transform = axes.transData + axes.transAxes.inverted()
    at_mm = [transform.transform((axes.get_xlim()[1], height))[1] * height_mm for height in heights]
    order = sorted(range(len(texts)), key=at_mm.__getitem__)
    placed = spread([at_mm[i] for i in order], [LINE_MM] * len(order), 0.0, height_mm, 0.1)
    for i, at in zip(order, placed, strict=True):
        axes.text(1.02, at / height_mm, texts[i], transform=axes.transAxes, va="center", size=SMALL_PT)
