"""What memory each method takes, in single and in double precision."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.legend import draw_legend, fill_entries, legend_height
from reports.drawing.style import INK, PALE, TITLE_PT, WIDTH_MM, Fill, axes_at, drawing, page, text_width_mm
from reports.embedded.signs import beside

ROW_MM, BAR_SHARE, GAP_MM = 5.6, 0.36, 8.0
KB = 1024
PARTS = {
    "ram": Fill("#11538c", "white", "", "RAM"),
    "HR": Fill("#11538c", "white", "", "RAM of the HR task"),
    "LR": Fill("#fbe3b5", "#9a6200", "////", "RAM of the LR task"),
    "stack": Fill(INK, "white", "", "stacks"),
    "code": Fill("#f2f2f2", INK, "", "code, in flash"),
}
"""How bars look, and what they are."""
FLASH = "code"

Parts = Mapping[str, int]
"""Bytes, by part as in `PARTS`."""


def memory_figure(memory: Mapping[str, Mapping[str, Parts]]) -> Figure:
    """A plot for each key, two bars for each method: above what is in RAM, one behind the other, below code.

    memory: by title of the plot and method.
    """
    methods = list(dict.fromkeys(method for of in memory.values() for method in of))
    bars = [bar for of in memory.values() for parts in of.values() for bar in _bars(parts)]
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(METHOD_NAMES[method]) for method in methods)
        across = WIDTH_MM - left - 4.0
        width = (across - GAP_MM * (len(memory) - 1)) / len(memory)
        height, top = ROW_MM * len(methods), EDGE_MM + TITLE_MM
        legend = fill_entries({f"{part}:": fill for part, fill in PARTS.items() if any(part in bar for bar in bars)})
        figure = page(top + height + AXIS_MM + legend_height(legend, across) + EDGE_MM)
        most = max(sum(bar.values()) for bar in bars) / KB
        for column, (title, of) in enumerate(memory.items()):
            axes = axes_at(figure, left + column * (width + GAP_MM), top, width, height)
            axes.set(xlim=(0, 1.03 * most), ylim=(len(methods) - 0.5, -0.5), yticks=[])
            axes.grid(axis="x", color=PALE, lw=0.5)
            axes.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True))
            for y, method in enumerate(methods):
                for foot, bar in zip((y - BAR_SHARE, y), _bars(of[method]), strict=True):
                    at = 0.0
                    for part, size in bar.items():
                        fill = PARTS[part]
                        box = Rectangle((at, foot), size / KB, BAR_SHARE, facecolor=fill.colour, edgecolor=fill.ink)
                        axes.add_patch(box)
                        box.set(hatch=fill.hatch, linewidth=fill.edge_pt)
                        at += size / KB
                if column == 0:
                    beside(axes, y, METHOD_NAMES[method], left=True)
            axes.set_title(title, loc="left", size=TITLE_PT)
            axes.set_xlabel("KB of 1,024 bytes", labelpad=2)
            plain(axes)
        draw_legend(figure, legend, left, top + height + AXIS_MM, across)
        return figure


def _bars(parts: Parts) -> tuple[dict[str, int], dict[str, int]]:
    """Of RAM, by part in the order of `PARTS`, and of flash."""
    return {part: parts[part] for part in PARTS if part in parts and part != FLASH}, {FLASH: parts[FLASH]}
