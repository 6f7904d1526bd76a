"""What memory each method takes, in single and in double precision."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.axes import AXIS_MM, EDGE_MM, TITLE_MM, plain
from reports.drawing.legend import draw_legend, legend_height
from reports.drawing.style import PALE, TITLE_PT, WIDTH_MM, axes_at, drawing, page, text_width_mm
from reports.embedded.signs import beside, swatch_entry
from reports.embedded.words import SOURCES

ROW_MM, BAR_SHARE, GAP_MM = 7.0, 0.36, 8.0
KB = 1024
PARTS = {
    "HR": ("#11538c", "RAM of the HR task"),
    "LR": ("#dd9009", "RAM of the LR task"),
    "stack": ("#8f8f8f", "stacks"),
    "code": ("#dcdcdc", "code, in flash"),
}
"""Colours of bars, and what they are."""
FLASH = "code"


def memory_figure(memory: Mapping[str, Mapping[str, Mapping[str, int]]]) -> Figure:
    """A plot for each core, two bars for each method: above RAM by task and stacks, one behind the other, below code.

    memory: bytes by core, method and part, as in `PARTS`.
    """
    methods = list(dict.fromkeys(method for of in memory.values() for method in of))
    with drawing():
        left = EDGE_MM + 2.0 + max(text_width_mm(METHOD_NAMES[method]) for method in methods)
        across = WIDTH_MM - left - 4.0
        width = (across - GAP_MM * (len(memory) - 1)) / len(memory)
        height, top = ROW_MM * len(methods), EDGE_MM + TITLE_MM
        legend = [swatch_entry(text, colour) for colour, text in PARTS.values()]
        figure = page(top + height + AXIS_MM + legend_height(legend, across) + EDGE_MM)
        bars = [bar for of in memory.values() for parts in of.values() for bar in _bars(parts)]
        most = max(sum(bar.values()) for bar in bars) / KB
        for column, (core, of) in enumerate(memory.items()):
            axes = axes_at(figure, left + column * (width + GAP_MM), top, width, height)
            axes.set(xlim=(0, 1.03 * most), ylim=(len(methods) - 0.5, -0.5), yticks=[])
            axes.grid(axis="x", color=PALE, lw=0.5)
            axes.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True))
            for y, method in enumerate(methods):
                for top_at, bar in zip((y - BAR_SHARE, y), _bars(of[method]), strict=True):
                    at = 0.0
                    for part, size in bar.items():
                        colour, _ = PARTS[part]
                        axes.add_patch(Rectangle((at, top_at), size / KB, BAR_SHARE, facecolor=colour, lw=0))
                        at += size / KB
                if column == 0:
                    beside(axes, y, METHOD_NAMES[method], left=True)
            axes.set_title(SOURCES[core], loc="left", size=TITLE_PT)
            axes.set_xlabel("KB", labelpad=2)
            plain(axes)
        draw_legend(figure, legend, left, top + height + AXIS_MM, across)
        return figure


def _bars(parts: Mapping[str, int]) -> tuple[dict[str, int], dict[str, int]]:
    """Of RAM, by part in the order of `PARTS`, and of flash."""
    return {part: parts[part] for part in PARTS if part in parts and part != FLASH}, {FLASH: parts[FLASH]}
