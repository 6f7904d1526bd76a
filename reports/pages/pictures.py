"""The figures of a report: each as the bytes of its file, and as data from which a script makes it alive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from matplotlib.figure import Figure

from reports.charts.chart import gantt
from reports.charts.panels import Panel
from reports.charts.told import told
from reports.drawing.picture import image
from reports.drawing.readout import readout


class Picture(NamedTuple):
    """alive: the panels of a Gantt chart, see `told`, "still" where the picture is to be seen first; or the curves of a
    figure, see `readout`; None of any other."""

    svg: bytes
    alive: Mapping[str, Any] | None


class Annotated(NamedTuple):
    """A figure that says more than the chart of its panels, so that it is what is seen first."""

    figure: Figure
    panels: Sequence[Panel]


def pictures(figures: Mapping[str, Figure | Annotated | Sequence[Panel]]) -> dict[str, Picture]:
    """By file name; where there are panels alone, they are drawn below one another as a Gantt chart."""
    return {name: _picture(figure) for name, figure in figures.items()}


def files(drawn: Mapping[str, Picture]) -> dict[str, bytes]:
    """The SVG of each."""
    return {name: picture.svg for name, picture in drawn.items()}


def _picture(figure: Figure | Annotated | Sequence[Panel]) -> Picture:
    if isinstance(figure, Figure):
        return Picture(image(figure, "svg"), readout(figure))
    if isinstance(figure, Annotated):
        return Picture(image(figure.figure, "svg"), {"panels": [told(panel) for panel in figure.panels], "still": True})
    return Picture(image(gantt(figure), "svg"), {"panels": [told(panel) for panel in figure]})
