"""Axes of speeds."""

from __future__ import annotations

from math import ceil, floor, log10
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.style import PALE

SPEED_UNIT = "standard steps per HR period"
SPEEDS_SHOWN = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)
"""In each decade."""


def speed_ticks(axes: Axes, which: Literal["x", "y"], limits: tuple[float, float]) -> None:
    """A logarithmic axis of speeds with numbers as people write them."""
    axis = axes.yaxis if which == "y" else axes.xaxis
    (axes.set_yscale if which == "y" else axes.set_xscale)("log")
    decades = range(floor(log10(limits[0])), ceil(log10(limits[1])))
    speeds = [float(f"{speed}e{decade}") for decade in decades for speed in SPEEDS_SHOWN]
    axis.set_major_locator(FixedLocator([speed for speed in speeds if limits[0] <= speed <= limits[1]]))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda speed, _: f"{speed:g}"))
    axes.grid(axis=which, color=PALE, lw=0.5)
