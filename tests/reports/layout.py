"""Whether a picture can be read: its texts as boxes on the page."""

from __future__ import annotations

from itertools import combinations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from reports.drawing.dark import contrast
from reports.drawing.style import drawing

TOLERANCE = 0.5  # pixels at 100 dots per inch


def texts(figure: Figure) -> list[tuple[Text, Bbox]]:
    """Every visible text with its box in pixels."""
    with drawing():
        canvas = FigureCanvasAgg(figure)
        figure.draw_without_rendering()
        found = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
        unseen = _ticks_beyond_the_axis(figure)
        return [(text, text.get_window_extent(canvas.get_renderer())) for text in found if text not in unseen]


def contrast_of(patch: Patch) -> float:
    """To white paper: of its fill, or of its edge where that is more."""
    red, green, blue, opaque = patch.get_facecolor()
    fill = to_hex([1 - opaque * (1 - part) for part in (red, green, blue)])
    edge = to_hex(patch.get_edgecolor()) if patch.get_linewidth() else fill
    return max(contrast(fill, "#ffffff"), contrast(edge, "#ffffff"))


def _ticks_beyond_the_axis(figure: Figure) -> set[Text]:
    """Labels that matplotlib keeps without drawing them."""
    found = set()
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            for tick in axis.get_major_ticks():
                if not low - 1e-9 <= tick.get_loc() <= high + 1e-9:
                    found |= {tick.label1, tick.label2}
    return found


def flaws(figure: Figure) -> list[str]:
    """Texts that overlap, reach beyond the page or are smaller than 7 points."""
    boxes, page = texts(figure), figure.bbox
    found = [f"{text.get_text()!r} is small" for text, _ in boxes if text.get_fontsize() < 7]
    for text, box in boxes:
        if min(box.x0 - page.x0, box.y0 - page.y0, page.x1 - box.x1, page.y1 - box.y1) < -TOLERANCE:
            found.append(f"{text.get_text()!r} leaves the page")
    for (one, a), (other, b) in combinations(boxes, 2):
        if min(a.x1, b.x1) - max(a.x0, b.x0) > TOLERANCE and min(a.y1, b.y1) - max(a.y0, b.y0) > TOLERANCE:
            found.append(f"{one.get_text()!r} overlaps {other.get_text()!r}")
    return found
