"""Power against accuracy, for a column: a sign for each method, a group for each number of measurements left out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import ceil, floor, log10
from typing import Literal, NamedTuple

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.axes import AXIS_MM, EDGE_MM, plain
from reports.drawing.legend import Entry, draw_legend, legend_height, line_entry
from reports.drawing.style import (
    GREY,
    METHOD_LINES,
    PALE,
    RED,
    SMALL_PT,
    Line,
    axes_at,
    drawable,
    drawing,
    page,
    text_width_mm,
)
from reports.pages.minus import true_minus
from studies.selection.front import Front, FrontPoint

COLUMN_MM, PLOT_MM, LEFT_MM, TOP_MM = 88.0, 66.0, 11.5, 4.0

OTHER = Line(GREY, "-", "o")
SHADE = "#8f8f8f"
"""Of the line below designs that no other one beats."""


def front_figure(front: Front) -> Figure:
    """What each method asks for by where it lands, the designs that no other one beats as a line below them, and the
    accuracy that was asked for."""
    with drawing():
        right = _right(front)
        across = COLUMN_MM - LEFT_MM - right.width_mm
        methods = list(dict.fromkeys(point.method for point in front.points))
        entries = [*(_entry(method, front.points) for method in methods), *_signs(front)]
        top = TOP_MM + PLOT_MM + AXIS_MM
        figure = page(top + legend_height(entries, across) + EDGE_MM, COLUMN_MM)
        axes = axes_at(figure, LEFT_MM, TOP_MM, across, PLOT_MM)
        _scale(axes, front)
        _beaten_by_none(axes, front)
        for every in dict.fromkeys(point.every for point in front.points):
            for method in methods:
                _curve(axes, front, [of for of in front.points if of.every == every and of.method == method])
        for every in dict.fromkeys(point.every for point in front.points):
            _name(axes, front, every, [of for of in front.points if of.every == every])
        _landings(axes, front)
        axes.axhline(_over(front, front.within), color=RED, lw=0.9, ls=(0, (5, 2)), zorder=1.5)
        plain(axes)
        axes.grid(axis="y", color=PALE, lw=0.5)
        _draw_right(axes, right)
        axes.set_ylabel("over no delay (%)", labelpad=2)
        axes.set_xlabel(f"least speed ({drawable(_plural(front.cost_unit))} per HR period)", labelpad=2)
        draw_legend(figure, entries, LEFT_MM, top, across)
        return figure


def _plural(unit: str) -> str:
    return f"{unit}s" if unit in ("operation", "second", "standard step") else unit


def _line(method: str) -> Line:
    return METHOD_LINES.get(method, OTHER)


def _entry(method: str, points: Sequence[FrontPoint]) -> Entry:
    several = any(of.L != other.L for of in points for other in points if of.method == other.method == method)
    line = _line(method)
    return line_entry(method, line, dashes=several and _has_curve(points, method))


def _has_curve(points: Sequence[FrontPoint], method: str) -> bool:
    every = [of.every for of in points if of.method == method]
    return len(every) > len(set(every))


def _signs(front: Front) -> list[Entry]:
    unit = f" {drawable(front.output_unit)}" if front.output_unit else ""
    return [
        line_entry(f"within {front.within:g}{unit}", Line(RED, (0, (5, 2)), "None")),
        line_entry("best for its power", Line(SHADE, "-", "None")),
    ]


def _scale(axes: Axes, front: Front) -> None:
    """Power, and by how much the figure is above that without delay, both logarithmic."""
    speeds = [of.speed for of in front.points]
    axes.set_xscale("log")
    low, high = log10(min(speeds)), log10(max(speeds))
    unit = max(high - low, 0.5) / (1 - NAMES_SHARE - LANDINGS_SHARE)
    axes.set_xlim(10 ** (low - LANDINGS_SHARE * unit), 10 ** (high + NAMES_SHARE * unit))
    _ticks(axes.xaxis, axes.get_xlim(), (1, 3) if high - low < WIDE else (1,), _power)
    axes.grid(axis="x", color=PALE, lw=0.5)
    axes.set_yscale("log")
    axes.set_ylim(*_ends(front))
    _ticks(axes.yaxis, axes.get_ylim(), (1, 2, 5), lambda percent: f"{percent:g}")


def _ends(front: Front) -> tuple[float, float]:
    """Of the axis of accuracy, percent over no delay."""
    over = [100 * (std / front.no_delay - 1) for std in (*(of.std for of in front.points), front.within)]
    shown = [value for value in over if value > LEAST_PERCENT]
    return min(shown, default=1.0) / 1.5, max(shown, default=10.0) * 1.9


def _power(value: float) -> str:
    """A tick of power."""
    return (
        f"{value:,.0f}" if WHOLE_FROM <= value < PLAIN_TO else f"{value:.0e}".replace("e+0", "e").replace("e-0", "e-")
    )


WHOLE_FROM, PLAIN_TO = 1.0, 3e6

NAMES_SHARE, LANDINGS_SHARE = 0.25, 0.14
"""Of the width: right of all designs for the names of groups, left of them for landings."""
WIDE = 1.8
"""So many powers of ten have ticks at these alone."""

LEAST_PERCENT = 1e-3
"""What costs less has no place on a logarithmic axis."""


def _ticks(axis: Axis, ends: tuple[float, float], leads: Sequence[int], words: Callable[[float], str]) -> None:
    """At leads x 10^n, or at powers of ten alone where these are many."""
    low, high = ends
    axis.set_major_locator(FixedLocator([tick for tick in _places(low, high, leads) if low <= tick <= high]))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: true_minus(words(value))))


def _places(low: float, high: float, leads: Sequence[int]) -> list[float]:
    leads = leads if high / low < MANY else (1,)
    return [lead * 10.0**n for n in range(floor(log10(low)), ceil(log10(high)) + 1) for lead in leads]


MANY = 3e3


class Right(NamedTuple):
    """The axis of standard deviations: `at`, percent over no delay, with `words` beside it; name: of the axis."""

    at: Sequence[float]
    words: Sequence[str]
    name: str

    @property
    def width_mm(self) -> float:
        return max((text_width_mm(text, SMALL_PT) for text in self.words), default=0.0) + NAME_MM


NAME_MM = 6.5
"""Of the ticks and the name of an axis."""


def _right(front: Front) -> Right:
    """With as many digits as tell the ticks apart, in thousandths, millionths, ... of the unit where it is small."""
    low, high = _ends(front)
    at = [tick for tick in _places(low, high, (1, 2, 5)) if low <= tick <= high]
    power = 3 * min(floor(log10(front.no_delay * (1 + low / 100)) / 3 + 1 / 3), 0)
    values = [front.no_delay * (1 + percent / 100) / 10.0**power for percent in at]
    digits = next((n for n in range(3, 7) if len({f"{value:.{n}g}" for value in values}) == len(values)), 6)
    scale = f"$10^{{{power}}}$ " if power else ""
    unit = f" ({scale}{drawable(front.output_unit)})" if front.output_unit else f" ({scale.strip()})" if power else ""
    words = [f"{value:#.{digits}g}".rstrip(".") for value in values]
    return Right(at, words, f"{front.metric} std of {drawable(front.output)}{unit}")


def _draw_right(axes: Axes, right: Right) -> None:
    beside = axes.twinx()
    beside.set_yscale("log")
    beside.set_ylim(axes.get_ylim())
    beside.yaxis.set_major_locator(FixedLocator(list(right.at)))
    beside.yaxis.set_minor_locator(NullLocator())
    words = dict(zip(right.at, right.words, strict=True))
    beside.yaxis.set_major_formatter(FuncFormatter(lambda value, _: words.get(value, "")))
    beside.spines[["top", "left", "bottom"]].set_visible(False)
    beside.set_ylabel(right.name, labelpad=3)


def _over(front: Front, std: float) -> float:
    """Percent; what has no place on the axis is at its foot."""
    return max(100 * (std / front.no_delay - 1), LEAST_PERCENT)


def _beaten_by_none(axes: Axes, front: Front) -> None:
    """A stair: for less power than of a design, the accuracy of the one before."""
    best = sorted((of.speed, _over(front, of.std)) for of in front.points if of.on_front)
    if best:
        speeds, deviations = zip(*best, strict=True)
        axes.step(
            [*speeds, axes.get_xlim()[1]],
            [*deviations, deviations[-1]],
            where="post",
            color=SHADE,
            lw=3.0,
            zorder=1,
            solid_capstyle="butt",
        )


def _curve(axes: Axes, front: Front, points: Sequence[FrontPoint]) -> None:
    """A line from the earliest landing to the latest, a sign at each; filled where every measurement is used."""
    if not points:
        return
    line = _line(points[0].method)
    filled = points[0].every == 1
    axes.plot(
        [of.speed for of in points],
        [_over(front, of.std) for of in points],
        color=line.colour,
        ls=line.dashes,
        lw=1.2,
        marker=line.marker,
        markevery=[0, len(points) - 1],
        ms=line.size,
        mfc=line.colour if filled else "white",
        mec=line.colour,
        mew=0.8,
        zorder=3 if filled else 2.5,
    )


def _landings(axes: Axes, front: Front) -> None:
    """The earliest and the latest of the method that needs least, on its left."""
    of_all = [of for of in front.points if of.every == 1]
    if not of_all:
        return
    least = min(of_all, key=lambda of: of.speed).method
    curve = [of for of in of_all if of.method == least]
    for of in {curve[0].L: curve[0], curve[-1].L: curve[-1]}.values():
        _beside(axes, f"L={of.L}", (of.speed, _over(front, of.std)), (-4, 0), "right")


def _name(axes: Axes, front: Front, every: int, points: Sequence[FrontPoint]) -> None:
    """Right of the design that needs most."""
    last = max(points, key=lambda of: of.speed)
    text = "all used" if every == 1 else f"every {_ordinal(every)}"
    _beside(axes, text, (last.speed, _over(front, last.std)), (5, 0), "left")


def _beside(
    axes: Axes,
    text: str,
    at: tuple[float, float],
    points: tuple[float, float],
    across: Literal["left", "right"],
) -> None:
    note = axes.annotate(text, at, points, textcoords="offset points", size=SMALL_PT, ha=across, va="center", zorder=2)
    note.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def _ordinal(number: int) -> str:
    return {2: "2nd", 3: "3rd"}.get(number, f"{number}th")
