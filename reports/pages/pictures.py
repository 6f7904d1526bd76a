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
    """alive: the panels of a Gantt chart, see `told`, "still" where the picture is to be seen first; or "frames" of
    them, see `Sliding`; and the curves of a figure, see `readout`; None of any other. narrow: what a phone shows."""

    svg: bytes
    alive: Mapping[str, Any] | None
    narrow: Picture | None = None


class Narrowing(NamedTuple):
    """A figure, and the same for a phone, `NARROW_MM` wide. The file is the wide one."""

    wide: Figure
    narrow: Figure


class Annotated(NamedTuple):
    """A figure that says more than the chart of its panels, so that it is what is seen first."""

    figure: Figure
    panels: Sequence[Panel]


class Frame(NamedTuple):
    """One state of a figure. label: what is said of it, short, such as "L = 5"."""

    label: str
    panels: Sequence[Panel]


class Sliding(NamedTuple):
    """A figure in several states, all of equally many panels, which a slider goes through.

    name: what differs; at: the one that is drawn in the file; figure: what is drawn there instead and seen first, such
    as curves over all the states; these tell their values, too.
    """

    name: str
    frames: Sequence[Frame]
    at: int
    figure: Figure | None = None


Drawn = Figure | Narrowing | Annotated | Sliding | Sequence[Panel]


def pictures(figures: Mapping[str, Drawn]) -> dict[str, Picture]:
    """By file name; where there are panels alone, they are drawn below one another as a Gantt chart."""
    return {name: _picture(figure) for name, figure in figures.items()}


def files(drawn: Mapping[str, Picture]) -> dict[str, bytes]:
    """The SVG of each."""
    return {name: picture.svg for name, picture in drawn.items()}


def _picture(figure: Drawn) -> Picture:
    if isinstance(figure, Figure):
        return Picture(image(figure, "svg"), readout(figure))
    if isinstance(figure, Narrowing):
        return _picture(figure.wide)._replace(narrow=_picture(figure.narrow))
    if isinstance(figure, Annotated):
        return Picture(image(figure.figure, "svg"), {"panels": _told(figure.panels), "still": True})
    if isinstance(figure, Sliding):
        return _sliding(figure)
    return Picture(image(gantt(figure), "svg"), {"panels": _told(figure)})


def _sliding(figure: Sliding) -> Picture:
    drawn = gantt(figure.frames[figure.at].panels) if figure.figure is None else figure.figure
    frames = [{"label": frame.label, "panels": _told(frame.panels)} for frame in figure.frames]
    seen_first = {} if figure.figure is None else {**(readout(drawn) or {}), "still": True}
    return Picture(image(drawn, "svg"), {"name": figure.name, "at": figure.at, "frames": frames, **seen_first})


def _told(panels: Sequence[Panel]) -> list[dict[str, Any]]:
    return [told(panel) for panel in panels]
