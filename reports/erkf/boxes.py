"""Boxes and arrows of a block diagram, in millimetres from the upper left corner."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch

from reports.drawing.style import FONT_PT, INK, SMALL_PT, WIDTH_MM, axes_at, page

Point = tuple[float, float]
ARROW = {"arrowstyle": "-|>", "lw": 0.8, "color": INK, "shrinkA": 0, "shrinkB": 0}


class Box(NamedTuple):
    """x, y: its middle. text: in its middle, lines apart."""

    x: float
    y: float
    width: float
    height: float
    text: str
    colour: str = "white"

    @property
    def left(self) -> Point:
        return self.x - self.width / 2, self.y

    @property
    def right(self) -> Point:
        return self.x + self.width / 2, self.y

    def top(self, at: float = 0.5) -> Point:
        """at: share of the width, from the left."""
        return self.x + (at - 0.5) * self.width, self.y - self.height / 2

    def bottom(self, at: float = 0.5) -> Point:
        return self.x + (at - 0.5) * self.width, self.y + self.height / 2


def sheet(height_mm: float) -> tuple[Figure, Axes]:
    """An empty page, and axes all over it in millimetres."""
    figure = page(height_mm)
    axes = axes_at(figure, 0, 0, WIDTH_MM, height_mm)
    axes.set(xlim=(0, WIDTH_MM), ylim=(height_mm, 0))
    axes.axis("off")
    return figure, axes


def draw_box(axes: Axes, box: Box, *, dashed: bool = False) -> None:
    """With rounded corners."""
    corner = (box.x - box.width / 2, box.y - box.height / 2)
    axes.add_patch(
        FancyBboxPatch(
            corner, box.width, box.height, boxstyle="round,pad=0,rounding_size=1", facecolor=box.colour, edgecolor=INK,
            lw=0.8, ls=(0, (3, 2)) if dashed else "-",
        )
    )  # fmt: skip
    axes.text(box.x, box.y, box.text, ha="center", va="center", size=FONT_PT, linespacing=1.35)


def draw_sign(axes: Axes, at: Point, sign: str) -> None:
    """A small circle in which signals are added or multiplied."""
    axes.add_patch(Circle(at, 2.2, facecolor="white", edgecolor=INK, lw=0.8, zorder=3))
    axes.text(*at, sign, ha="center", va="center_baseline", size=FONT_PT, zorder=4)


def draw_arrow(axes: Axes, points: Sequence[Point], text: str = "", *, below: bool = False, at: int = 0) -> None:
    """Along these points; its text at the middle of the piece from point `at` on, above it or below."""
    across, down = zip(*points, strict=True)
    if len(points) > 2:
        axes.plot(across[:-1], down[:-1], color=INK, lw=0.8, solid_joinstyle="miter")
    axes.annotate("", points[-1], points[-2], arrowprops=ARROW)
    if text:
        (x0, y0), (x1, y1) = points[at], points[at + 1]
        level = y0 == y1
        shift = ((0, -2.5) if below else (0, 2.5)) if level else (3, 0)
        axes.annotate(
            text, ((x0 + x1) / 2, (y0 + y1) / 2), shift, textcoords="offset points", size=SMALL_PT,
            ha="center" if level else "left", va=("top" if below else "bottom") if level else "center",
        )  # fmt: skip
