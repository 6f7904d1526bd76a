"""The legend of a Gantt chart: as many lines as it takes, entries side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from reports.drawing.style import GREY, INK, RED, SMALL_PT, Fill, Line, axes_at, text_width_mm

LINE_MM, SWATCH_MM, SIGN_MM, BESIDE_MM, GAP_MM = 4.0, 5.5, 1.2, 1.2, 3.8


class Entry(NamedTuple):
    """draw: paints the sign, `width` mm wide, into axes in mm, its left end at x and its middle at y."""

    text: str
    width: float
    draw: Callable[[Axes, float, float], None]

    @property
    def width_mm(self) -> float:
        """With its text."""
        return self.width + BESIDE_MM + text_width_mm(self.text, SMALL_PT)


def fill_entries(fills: Mapping[str, Fill]) -> list[Entry]:
    """What runs, with its label."""
    return [Entry(_words(style, fill), SWATCH_MM, _swatch(fill)) for style, fill in fills.items()]


def sign_entries(missing: bool, every: int = 1) -> list[Entry]:
    """What the other signs mean. missing: whether a deadline is missed somewhere; every: of how many jobs of a crowded
    row one has its arrows."""
    some = f" (1 in {every} where crowded)" if every > 1 else ""
    entries = [
        Entry("released, not running", SWATCH_MM, _thin_bar),
        Entry(f"release{some}", SIGN_MM, _marker("^", INK)),
        Entry(f"deadline{some}", SIGN_MM, _marker("v", INK)),
    ]
    if missing:
        entries += [
            Entry("missed deadline", SIGN_MM, _missed),
            Entry("work after its deadline", SWATCH_MM, _late),
        ]
    return entries


def legend_height(entries: Sequence[Entry], width_mm: float) -> float:
    """The height in mm that `draw_legend` takes."""
    return LINE_MM * len(_lines(entries, width_mm)) if entries else 0.0


def draw_legend(figure: Figure, entries: Sequence[Entry], left: float, top: float, width_mm: float) -> None:
    """Draw it at `left`, `top` (mm from the figure's left and top edge)."""
    if not entries:
        return
    lines = _lines(entries, width_mm)
    height = LINE_MM * len(lines)
    axes = axes_at(figure, left, top, width_mm, height)
    axes.set(xlim=(0, width_mm), ylim=(0, height))
    axes.axis("off")
    for number, line in enumerate(lines):
        y = height - LINE_MM * (number + 0.5)
        for x, entry in line:
            entry.draw(axes, x, y)
            axes.text(x + entry.width + BESIDE_MM, y, entry.text, va="center_baseline", size=SMALL_PT)


def _words(style: str, fill: Fill) -> str:
    return fill.meaning if style == "switch" or ":" in style else f"{style}  {fill.meaning}"


def _lines(entries: Sequence[Entry], width_mm: float) -> list[list[tuple[float, Entry]]]:
    """The entries broken into lines, each with its x: as few lines as fit the width, and those about equally long."""
    lines = _broken(entries, width_mm)
    for narrower in range(1, int(width_mm)):
        shorter = _broken(entries, width_mm - narrower)
        if len(shorter) > len(lines):
            break
        lines = shorter
    return lines


def _broken(entries: Sequence[Entry], width_mm: float) -> list[list[tuple[float, Entry]]]:
    lines: list[list[tuple[float, Entry]]] = [[]]
    x = 0.0
    for entry in entries:
        if lines[-1] and x + entry.width_mm > width_mm:
            lines.append([])
            x = 0.0
        lines[-1].append((x, entry))
        x += entry.width_mm + GAP_MM
    return lines


def _swatch(fill: Fill) -> Callable[[Axes, float, float], None]:
    def draw(axes: Axes, x: float, y: float) -> None:
        half = fill.edge_pt / 2 / 72 * 25.4
        box = Rectangle((x + half, y - 1.3), SWATCH_MM - 2 * half, 2.6, facecolor=fill.colour, edgecolor=fill.ink)
        box.set(hatch=fill.hatch, linewidth=fill.edge_pt)
        axes.add_patch(box)

    return draw


def _thin_bar(axes: Axes, x: float, y: float) -> None:
    axes.add_patch(Rectangle((x, y - 0.35), SWATCH_MM, 0.7, facecolor=GREY, lw=0))


def _marker(marker: str, colour: str) -> Callable[[Axes, float, float], None]:
    def draw(axes: Axes, x: float, y: float) -> None:
        tail, tip = (y - 1.3, y + 0.6) if marker == "^" else (y + 1.3, y - 0.6)
        axes.plot([x + SIGN_MM / 2] * 2, [tail, tip], color=colour, lw=0.7)
        axes.plot([x + SIGN_MM / 2], [tip], marker=marker, color=colour, ms=3, mew=0)

    return draw


def _missed(axes: Axes, x: float, y: float) -> None:
    _marker("v", RED)(axes, x, y)
    axes.plot([x + SIGN_MM / 2], [y + 1.1], marker="x", color=RED, ms=4, mew=1.1)


def _late(axes: Axes, x: float, y: float) -> None:
    box = Rectangle((x, y - 1.3), SWATCH_MM, 2.6, facecolor="none", edgecolor=RED, hatch="xxxx", lw=0)
    axes.add_patch(box)


def line_entry(text: str, line: Line, *, dashes: bool = True) -> Entry:
    """A curve with its marker, or the marker alone."""
    width = SWATCH_MM + 2.5 if dashes else 2.0

    def draw(axes: Axes, x: float, y: float) -> None:
        if dashes:
            axes.plot([x, x + width], [y, y], color=line.colour, ls=line.dashes, lw=1.2)
        axes.plot(
            [x + width / 2],
            [y],
            marker=line.marker,
            color=line.colour,
            ms=line.size,
            mew=1.3 if line.marker == "|" else 0,
        )

    return Entry(text, width, draw)
