"""What figures on boards share: names beside rows, and numbers at ticks."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.pages.minus import true_minus


def beside(axes: Axes, y: float, text: str, *, left: bool) -> None:
    """A text left or right of the axes, at the height of a row."""
    axes.annotate(
        text, (0 if left else 1, y), (-4 if left else 4, 0), xycoords=axes.get_yaxis_transform(),
        textcoords="offset points", ha="right" if left else "left", va="center",
    )  # fmt: skip


def numbers_at(axis: Axis, ticks: Sequence[float], *, signed: bool = False) -> None:
    """Numbers at those of these that are on the axis."""
    low, high = sorted(axis.get_view_interval())
    axis.set_major_locator(FixedLocator([tick for tick in ticks if low <= tick <= high]))
    axis.set_minor_locator(NullLocator())
    written = "{:+g}" if signed else "{:,g}"
    axis.set_major_formatter(FuncFormatter(lambda value, _: true_minus(written.format(value)).replace("+0", "0")))
