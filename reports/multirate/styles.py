"""How the report on the multirate gain draws what it tells apart: each the same in all of its figures."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes

from reports.drawing.legend import SWATCH_MM, Entry
from reports.drawing.style import INK, SOURCES, Line
from studies.multirate.accuracy import Reading

BLUE, OCHRE, GREEN, PURPLE = "#11538c", "#b8700a", "#2e7d4f", "#8a3b73"
DASHES, DOTS, CHAIN = (0, (4.0, 1.5)), (0, (1.2, 1.2)), (0, (6.0, 1.5, 1.2, 1.5))

PRINTED = SOURCES["printed"]
PRINTED_MARKER = "_"
"""Its stroke, across an axis of values that goes up."""


def printed_entry() -> Entry:
    """That stroke in a legend."""

    def draw(axes: Axes, x: float, y: float) -> None:
        axes.plot([x, x + SWATCH_MM], [y, y], color=PRINTED.colour, lw=1.6)

    return Entry("as the patent prints it", SWATCH_MM, draw)


OPTIMAL = Line(INK, "-", "X", 4.2)
"""The filter that computes its gain in every step."""

VEHICLE_LINES: Mapping[str, Line] = {
    "calm": Line(BLUE, "-", "o"),
    "road": Line(GREEN, DASHES, "s"),
    "aircraft": Line(OCHRE, CHAIN, "^"),
}
"""A receiver, by how it moves."""

READING_LINES: Mapping[Reading, Line] = {
    "averaged": Line(BLUE, "-", "o"),
    "sampled": Line(PURPLE, DASHES, "D"),
    "skipped": Line(GREEN, DOTS, "s"),
}

PERIOD_LINES: Mapping[int, Line] = {
    2: Line(BLUE, "-", "o"),
    5: Line(OCHRE, DASHES, "^"),
    10: Line(GREEN, CHAIN, "s"),
    20: Line(PURPLE, DOTS, "D"),
}
"""By n."""

FAMILY_LINES: Mapping[str, Line] = {
    "random walk": Line(GREEN, "None", "s"),
    "tracker": Line(PURPLE, "None", "D"),
    "receiver": Line(BLUE, "None", "o"),
}
"""Systems, by kind: markers alone."""

FORM_LINES = (
    Line(INK, "-", "v", 4.0),
    Line(BLUE, DASHES, "o"),
    Line(OCHRE, CHAIN, "^"),
    Line(GREEN, "-", "s"),
    Line(PURPLE, DOTS, "D"),
)
"""Forms of the covariance in the report's order, the patent's own first."""
