"""One look for each thing through all figures of the report on modular filters, and legends of more than one thing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes

from filters.arrays import FloatArray
from reports.charts.panels import METHOD_NAMES
from reports.drawing.legend import BESIDE_MM, GAP_MM, Entry, line_entry
from reports.drawing.sheet import LEFT_MM, RIGHT_MM
from reports.drawing.style import INK, METHOD_LINES, SOURCE_LINES, WIDTH_MM, Fill, Line
from studies.modular.rocket_schedule import WAYS

QUANTITY_LINES = dict(
    zip(
        ("position", "velocity", "acceleration", "turn rate", "orientation"),
        (*SOURCE_LINES[1:], Line(INK, "-", "v")),
        strict=True,
    )
)

DROPOUT_LINES = {
    "0 %": Line("#2f9aa0", "-", "*", 6.0),
    "50 %": Line("#2f74b0", "-", "<", 4.4),
    "80 %": Line("#5b3fa0", "-", "P", 4.8),
    "95 %": Line("#1a1633", "-", "X", 4.8),
}
"""The more is lost, the darker."""

KIND_LINES = {
    "linear": Line("#8a8a8a", "-", "s", 5.4),
    "extended": Line("#0b4f4f", (0, (4.0, 1.5)), "h", 4.2),
    "unscented": Line("#b3382f", (0, (1.0, 1.2)), "*", 6.0),
}
"""Of predictors and correctors. The first is drawn wide, as the second lies on it."""

WAY_LINES = {
    way.name: METHOD_LINES[way.late]
    if way.predictor == "extended"
    else METHOD_LINES[way.late]._replace(marker=KIND_LINES["unscented"].marker, dashes=(0, (1.0, 1.2)), size=6.0)
    for way in WAYS
}
"""The look of the method; with unscented parts it is dotted and has their sign."""

WAY_NAMES = {way.name: f"{METHOD_NAMES[way.late]}, {way.predictor}" for way in WAYS}

BAND_EDGE_PT = 0.4
"""Of the outline by which a pale band stands out from the page."""


def band(axes: Axes, across: FloatArray, low: FloatArray, high: FloatArray, fill: Fill) -> None:
    """Between two curves, with an outline of its ink."""
    axes.fill_between(across, low, high, facecolor=fill.colour, edgecolor=fill.ink, lw=BAND_EDGE_PT)


def span_band(axes: Axes, low: float, high: float, fill: Fill) -> None:
    """Between two heights, below all else."""
    axes.axhspan(low, high, facecolor=fill.colour, edgecolor=fill.ink, lw=BAND_EDGE_PT, zorder=0.3)


def curve_entry(text: str, line: Line, width_pt: float) -> Entry:
    """A curve in a legend, as wide as it is drawn."""
    entry = line_entry(text, line)

    def draw(axes: Axes, x: float, y: float) -> None:
        before = len(axes.lines)
        entry.draw(axes, x, y)
        axes.lines[before].set_linewidth(width_pt)

    return entry._replace(draw=draw)


def apart(groups: Mapping[str, Sequence[Entry]]) -> list[Entry]:
    """Entries of a legend on the width of a `sheet`: each group begins a line with its name."""
    across = WIDTH_MM - LEFT_MM - RIGHT_MM
    found: list[Entry] = []
    for name, entries in groups.items():
        line = [head_entry(name), *entries]
        left = across - sum(entry.width_mm + GAP_MM for entry in line)
        found += [*line, Entry("", left - BESIDE_MM, _nothing)] if left > BESIDE_MM else line
    return found


def head_entry(name: str) -> Entry:
    """What the entries behind it are of."""
    return Entry(f"{name}:", 0.0, _nothing)


def _nothing(_axes: Axes, _x: float, _y: float) -> None:
    pass
