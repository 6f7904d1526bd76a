"""The axis of ratios of variances, logarithmic in what they are above one."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.style import INK, PALE, SMALL_PT
from reports.multirate.words import ratio_text
from studies.multirate.accuracy import GOOD

RATIOS = (1.001, 1.01, 1.1, 2.0, 10.0, 100.0, 1000.0)
"""That the axis numbers."""
GROUND = "#f0f0f0"
"""Of what is good."""
LEAST = 6e-4
"""Ratios less than one and this are not shown."""


def ratio_axis(axes: Axes, highest: float, *, numbers: bool = True) -> None:
    """Of y, in ratio - 1 up to `highest`; below the dashed line the loss is small. numbers: and a note that says so."""
    axes.set_yscale("log")
    axes.set_ylim(LEAST, highest)
    axes.yaxis.set_major_locator(FixedLocator([ratio - 1 for ratio in RATIOS if ratio - 1 < highest]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda loss, _: f"×{1 + loss:,.4g}"))
    axes.fmt_ydata = lambda loss: ratio_text(1 + loss)
    axes.tick_params(axis="y", labelleft=numbers)
    axes.spines[["right", "top"]].set_visible(False)
    axes.grid(axis="y", color=PALE, lw=0.5)
    axes.axhline(GOOD - 1, color=INK, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
    axes.axhspan(LEAST, GOOD - 1, facecolor=GROUND, lw=0, zorder=0.2)
    if numbers:
        note = axes.annotate(
            f"within {100 * (GOOD - 1):g} % of the optimum", (1, GOOD - 1), (-3, -2), size=SMALL_PT, ha="right",
            va="top", xycoords=("axes fraction", "data"), textcoords="offset points", zorder=5,
        )  # fmt: skip
        note.set_path_effects([withStroke(linewidth=2.5, foreground=GROUND)])
