"""Accuracy against power: every method wherever it can land, a plot for each model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil, floor, log10

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from reports.accuracy.tables import operations
from reports.accuracy.words import MODELS, method_name
from reports.drawing.legend import SWATCH_MM, Entry, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, METHOD_LINES, NOISE_LINES, SMALL_PT, Line, drawing
from reports.pages.numbers import significant
from studies.accuracy.scale import EXACT, SUMMED, Placed

LINES: Mapping[str, Line] = {**METHOD_LINES, SUMMED: NOISE_LINES["sum"]}
LATER = ("dual-rate", SUMMED, "delayed-horizon")
"""Methods that need less power where they land later."""
SHADE, SHADE_PT = "#8f8f8f", 2.2
"""The line below designs that no other one beats: so thin that the signs on it stand out."""
LARGER = 1.5
"""Signs, than in other figures: many lie near one another."""
FAR, EDGES, END = 2.4, (1.14, 1.40), 1.6
"""Beyond so many times the power of the standard filter a design stands at the right edge, at so many times that power;
and where the axis ends."""
BELOW, ABOVE = 0.25, 0.9
"""The axis goes so far below the least and above the largest error of exact methods, in parts of what is between."""


def front_figure(placed: Mapping[str, Sequence[Placed]]) -> Figure:
    """A plot for each model: by how much the worst is above that without delay, against the least power; a sign where
    a method lands first and where it needs least, a line between, and below all the designs that no other one beats.
    What lies beyond the axes stands at their edge, with an arrow and its number."""
    with drawing():
        legend = [
            line_entry(method_name(name), line, dashes=name in LATER)
            for name, line in LINES.items()
            if name != "standard"
        ]
        legend.append(Entry("best for its power", SWATCH_MM, _shade))
        legend.append(line_entry("standard filter's power", Line(GREY, (0, (2, 1.5)), "None")))
        figure, rows = sheet(2, 2, legend, height_mm=58.0)
        for axes, (name, designs) in zip([axes for row in rows for axes in row], placed.items(), strict=True):
            _front(axes, designs)
            label(axes, MODELS[name].name)
        for row in rows:
            row[0].set_ylabel("worst error above that without delay (%)", labelpad=2)
        for axes in rows[-1]:
            axes.set_xlabel("least power (operations per HR period, logarithmic)", labelpad=2)
        return figure


def _shade(axes: Axes, x: float, y: float) -> None:
    axes.plot([x, x + SWATCH_MM], [y, y], color=SHADE, lw=SHADE_PT, solid_capstyle="butt")


def _front(axes: Axes, designs: Sequence[Placed]) -> None:
    standard = float(next(place.speed for place in designs if place.method == "standard"))
    shown = [place for place in designs if place.method != "standard" and place.every == 1]
    edge = FAR * standard
    _frame(axes, shown, edge)
    axes.axvline(standard, color=GREY, lw=0.8, ls=(0, (2, 1.5)), zorder=1)
    best = sorted((float(place.speed), _over(place)) for place in shown if place.on_front)
    speeds, levels = zip(*best, strict=True)
    axes.step(
        [*speeds, edge * END], [*levels, levels[-1]], where="post", color=SHADE, lw=SHADE_PT, zorder=1.2,
        solid_capstyle="butt",
    )  # fmt: skip
    low, high = axes.get_ylim()
    beyond = higher = 0
    for method in dict.fromkeys(place.method for place in shown):
        of_method = sorted((place for place in shown if place.method == method), key=lambda place: place.lands)
        inside = [place for place in of_method if place.speed <= edge]
        if not inside:
            _beyond_right(axes, of_method[0], edge * EDGES[beyond], (6, -6)[beyond])
            beyond += 1
        elif _over(inside[0]) > high:
            _beyond_above(axes, inside[0], high - (0.06 + 0.09 * higher) * (high - low), standard)
            higher += 1
        else:
            _curve(axes, inside)


def _frame(axes: Axes, shown: Sequence[Placed], edge: float) -> None:
    least = min(float(place.speed) for place in shown) / 1.12
    axes.set_xscale("log")
    axes.set_xlim(least, edge * END)
    axes.xaxis.set_major_locator(FixedLocator(_round_numbers(least, edge)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
    exact = [_over(place) for place in shown if place.method in EXACT]
    between = max(exact) - min(exact)
    axes.set_ylim(min(exact) - BELOW * between, max(exact) + ABOVE * between)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))


def _curve(axes: Axes, places: Sequence[Placed]) -> None:
    """A sign at each end, and one alone where there is one place."""
    line, name = LINES[places[0].method], method_name(places[0].method)
    axes.plot(
        [float(place.speed) for place in places], [_over(place) for place in places], line.marker,
        color=line.colour, ls=line.dashes, lw=1.1, ms=LARGER * line.size, mew=0.6, mec="white",
        markevery=[0, len(places) - 1] if len(places) > 1 else None, zorder=3, label=name,
    )  # fmt: skip


def _beyond_right(axes: Axes, place: Placed, at: float, up: float) -> None:
    _sign(axes, place, at, _over(place))
    _note(axes, f"{operations(place.speed)} →", (axes.get_xlim()[1], _over(place)), (0, up), "right")


def _beyond_above(axes: Axes, place: Placed, height: float, standard: float) -> None:
    """Its number on the side on which the line of the standard filter's power does not cross it."""
    at = float(place.speed)
    _sign(axes, place, at, height)
    shift, side = ((-6, 0), "right") if at <= standard else ((6, 0), "left")
    _note(axes, f"{significant(_over(place))} % ↑", (at, height), shift, side)


def _sign(axes: Axes, place: Placed, speed: float, over: float) -> None:
    line = LINES[place.method]
    axes.plot([speed], [over], line.marker, color=line.colour, ms=LARGER * line.size, mew=0.6, mec="white", zorder=3)


def _note(axes: Axes, text: str, at: tuple[float, float], shift: tuple[float, float], side: str) -> None:
    note = axes.annotate(text, at, shift, textcoords="offset points", va="center", ha=side, size=SMALL_PT)
    note.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def _over(place: Placed) -> float:
    return 100 * place.accuracy.over_no_delay


def _round_numbers(low: float, high: float) -> list[float]:
    """Some two to four, at 1, 2, 3, 5 times powers of ten."""
    leads = (1.0, 2.0, 3.0, 5.0)
    powers = range(floor(log10(low)), ceil(log10(high)) + 1)
    return [lead * 10.0**power for power in powers for lead in leads if low <= lead * 10.0**power <= high]
