"""How far Larsen and recalculate are from the dual-rate filter, step by step."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.axes import decades, power_of_ten
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, METHOD_LINES, PALE, SMALL_PT, Line, drawing
from reports.steffes.signs import OUTLINE, hollow_entry
from studies.steffes.agreement import FLOOR, Agreement

HEIGHT_MM = 48.0
ZERO, HIGH = 1e-18, 3.0
"""Where no difference at all is drawn, on an axis that has no zero; and the upper end of the axis."""
SHADE = "#ececec"


def agreement_figure(found: Agreement) -> Figure:
    """Lines: states; hollow signs: P_{k^-}. Shaded upright: the steps m to l - 1; below: rounding."""
    timing, last = found.timing, len(found.waiting) - 1
    lines = {method: METHOD_LINES[method] for method in found.state}
    sizes = {method: 3.2 + 1.6 * number for number, method in enumerate(lines)}
    with drawing():
        legend = [
            *(hollow_entry(f"{METHOD_NAMES[name]}, state", line, sizes[name]) for name, line in lines.items()),
            *(
                hollow_entry(
                    f"{METHOD_NAMES[name]}, $P_{{k^-}}$", line._replace(marker="s"), sizes[name] + 2.5, dashes=False
                )
                for name, line in lines.items()
            ),
        ]
        drawn = sheet(1, 1, legend, height_mm=HEIGHT_MM)
        ((axes,),) = drawn.plots
        decades(axes, "y", ZERO / 3, HIGH, every=4)
        axes.yaxis.set_major_locator(FixedLocator([ZERO, *(10.0**n for n in range(-16, 1, 4))]))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda at, _: "0" if at < 1.5 * ZERO else power_of_ten(at)))
        axes.set_xlim(-0.7, last + 0.7)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=9, integer=True))
        _shade(axes, found)
        for name, line in lines.items():
            axes.plot(
                np.arange(last + 1),
                np.maximum(found.state[name], ZERO),
                **_hollow(line, sizes[name], f"{METHOD_NAMES[name]}, state"),
                ls=line.dashes,
            )
            axes.plot(
                timing.N * np.arange(len(found.covariance[name])),
                np.maximum(found.covariance[name], ZERO),
                **_hollow(line._replace(marker="s"), sizes[name] + 2.5, f"{METHOD_NAMES[name]}, P at k"),
                ls="none",
            )
        title = f"Against the dual-rate filter, $N = {timing.N}$, $M = {timing.M}$, $L = {timing.L}$"
        label(axes, title, "HR step $j$", "difference / largest")
        return drawn.figure


def _hollow(line: Line, size: float, name: str) -> dict[str, Any]:
    return {
        "marker": line.marker,
        "color": line.colour,
        "mfc": "none",
        "mew": 0.8,
        "ms": size,
        "lw": 0.7,
        "label": name,
    }


def _shade(axes: Axes, found: Agreement) -> None:
    """The steps from m to l - 1, and what is nothing but rounding."""
    N, M, L = found.timing.N, found.timing.M, found.timing.L
    last = len(found.waiting) - 1
    for k in range(0, last, N):
        axes.axvspan(k + M - 0.5, k + L - 0.5, facecolor=SHADE, lw=0, zorder=0.2)
        axes.vlines([k + M - 0.5, k + L - 0.5], *axes.get_ylim(), color=GREY, lw=0.5, ls=(0, (2.0, 1.5)), zorder=0.3)
    axes.axhspan(ZERO / 3, FLOOR, facecolor="none", edgecolor=PALE, hatch="////", lw=0, zorder=0.4)
    axes.axhline(FLOOR, color=GREY, lw=0.7, zorder=0.6)
    above = axes.text(M + (L - M - 1) / 2, 1e-6, "m to\nl − 1", ha="center", va="center", size=SMALL_PT)
    below = axes.text(last + 0.5, ZERO, "rounding", ha="right", va="center", size=SMALL_PT, color=GREY)
    for note in (above, below):
        note.set_path_effects(OUTLINE)
