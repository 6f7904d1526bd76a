"""What one plot of a scenario's distributions is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes

BINS = 40
HEADROOM = 1.2


class Note(NamedTuple):
    """A piece of a subtitle. missed: something is wrong, so it is red."""

    text: str
    missed: bool = False


class Cell(NamedTuple):
    """One plot. notes: under the title, in as many lines as they take; draw: fills the axes; shares: what 100 % are."""

    title: str
    notes: Sequence[Note]
    draw: Callable[[Axes], None]
    shares: str = "share of the finished"


def share_axis(axes: Axes, shares: Sequence[float]) -> None:
    axes.set_ylim(0, min(HEADROOM * max(shares), 100) or 100)
