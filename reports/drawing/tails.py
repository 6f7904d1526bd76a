"""Logarithmic axes of probabilities, on which a shade covers what is not resolved."""

from __future__ import annotations

from math import ceil, floor, log10

from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from reports.drawing.axes import decades
from reports.drawing.style import GREY, SMALL_PT

MOST_DECADES = 6
"""With a number each; with more decades some have none."""
SHADE = "#efefef"


def tail_axis(axes: Axes, least: float, resolved: float = 0.0, name: str = "not resolved") -> None:
    """From 1 down to the decade of `least`. resolved: what is less is covered by a shade of this name."""
    low = 10.0 ** floor(log10(least))
    decades(axes, "y", low, 1.0, every=max(ceil(-log10(low) / MOST_DECADES), 1))
    if resolved > low:
        axes.axhspan(low, resolved, facecolor=SHADE, edgecolor="white", hatch="////", lw=0, zorder=3)
        written = axes.annotate(
            name,
            (0, low),
            (3, 2),
            xycoords=axes.get_yaxis_transform(),
            textcoords="offset points",
            va="bottom",
            size=SMALL_PT,
            color=GREY,
            zorder=5,
        )
        written.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
