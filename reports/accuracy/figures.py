"""Figures on accuracy: against the landing, and on a slow processor."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from reports.accuracy.words import heading, ordinal
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, INK, SMALL_PT, Line, drawing
from studies.accuracy.given import Given
from studies.accuracy.landing import Curve, Landing
from studies.accuracy.slow_processor import Choice, at_speeds

EVERY_LINES = {
    1: Line("#11538c", "-", "o"),
    2: Line("#b8700a", (0, (4.0, 1.5)), "^"),
    3: Line("#2e7d4f", (0, (6.0, 1.5, 1.0, 1.5)), "s"),
    4: Line("#8a3b73", (0, (1.5, 1.2)), "D"),
}
FLIGHT_LINES = {False: Line(GREY, (0, (4.0, 1.5)), "v"), True: Line("#1d8a8a", "-", "P", 4.2)}
"""By whether several frames are under way."""
SLOWEST, FASTEST = 1.9, 22.0
"""Speeds shown, on the slow processor."""
BEFORE = 1.12
"""The axis of speeds begins at the slowest over this, for the first n."""


def landing_figure(landings: Sequence[Landing]) -> Figure:
    """A plot for each model: the worst step's standard deviation over that without delay, against where corrections
    land; a curve for every measurement, and for every n-th."""
    with drawing():
        legend = [line_entry(f"{ordinal(n)} fix", line) for n, line in EVERY_LINES.items()]
        figure, rows = sheet(2, 2, legend, height_mm=52.0)
        for axes, found in zip([axes for row in rows for axes in row], landings, strict=True):
            _landing(axes, found)
        for row in rows:
            row[0].set_ylabel("std above that without delay (%)", labelpad=2)
        for axes in rows[-1]:
            axes.set_xlabel("lands after the fix was taken (ms)", labelpad=2)
        return figure


def _landing(axes: Axes, found: Landing) -> None:
    of = found.given
    label(axes, heading(of).replace(": a fix every ", ": every "))
    end = 2 * of.N
    for n, curve in found.curves.items():
        _curve(axes, of, found.no_delay, curve, n, end)
    axes.set(xlim=(of.ms(of.M) - 0.04 * of.ms(end), of.ms(end) * 1.02))
    axes.set_ylim(-0.03 * axes.get_ylim()[1], axes.get_ylim()[1] * 1.12)
    top = axes.get_ylim()[1]
    for steps, text in ((of.M, "arrives"), (of.N, "next fix")):
        axes.axvline(of.ms(steps), color=GREY, lw=0.7, ls=(0, (2, 1.5)), zorder=1)
        note = axes.annotate(
            text, (of.ms(steps), top), (2.5, -2), textcoords="offset points", size=SMALL_PT, va="top", color=INK
        )
        note.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
    axes.yaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))


def _curve(axes: Axes, of: Given, no_delay: float, curve: Curve, n: int, end: int) -> None:
    line = EVERY_LINES[n]
    shown = [
        (of.ms(L), 100 * (std / no_delay - 1)) for L, std in zip(curve.landings, curve.worst, strict=True) if end >= L
    ]
    at, over = zip(*shown, strict=True)
    axes.plot(
        at, over, line.marker, color=line.colour, ls=line.dashes, lw=1.2, ms=line.size, mew=0,
        markevery=[0, of.N - of.M], label=f"{ordinal(n)} fix",
    )  # fmt: skip


def slow_figure(choices: Sequence[Choice]) -> Figure:
    """The best worst-step deviation at each speed, with one frame in flight and with several; the n of each stretch."""
    with drawing():
        lines = FLIGHT_LINES
        names = {False: "one frame in flight, L ≤ n N", True: "several in flight"}
        legend = [line_entry(names[several], lines[several], dashes=True) for several in names]
        figure, ((axes,),) = sheet(1, 1, legend, height_mm=55.0, right_mm=8.0)
        speeds = {float(speed): pair for speed, pair in at_speeds(choices).items()}
        for several, line in lines.items():
            chosen = [(speed, pair[several]) for speed, pair in speeds.items() if pair[several] is not None]
            _stairs(
                axes,
                [(speed, choice) for speed, choice in chosen if choice is not None],
                line,
                names[several],
                above=not several,
            )
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlim(SLOWEST / BEFORE, FASTEST)
        shown = [1000 * best.worst for speed, (_, best) in speeds.items() if speed >= SLOWEST]
        axes.set_ylim(
            min(shown) / 1.15, max(1000 * c.worst for s, (c, _) in speeds.items() if c and s >= SLOWEST) * 1.15
        )
        for axis, ticks in (
            (axes.xaxis, (2, 3, 4, 5, 6, 8, 10, 20)),
            (axes.yaxis, (10, 20, 50, 100, 200)),
        ):
            low, high = axis.get_view_interval()
            axis.set_major_locator(FixedLocator([tick for tick in ticks if low <= tick <= high]))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        label(
            axes,
            "A camera at 50 Hz on a slow processor",
            "speed (HR jobs per HR period)",
            "worst std of the position (mm)",
        )
        return figure


def _stairs(axes: Axes, chosen: Sequence[tuple[float, Choice]], line: Line, name: str, *, above: bool) -> None:
    """A sign and the n where the number of frames in use changes."""
    speeds, levels = zip(*((speed, 1000 * choice.worst) for speed, choice in chosen if speed >= SLOWEST), strict=True)
    axes.step(
        [*speeds, FASTEST], [*levels, levels[-1]], where="post", color=line.colour, ls=line.dashes, lw=1.3, label=name
    )
    before = None
    for speed, choice in chosen:
        if choice.every != before and speed >= SLOWEST:
            axes.plot([speed], [1000 * choice.worst], line.marker, color=line.colour, ms=line.size, mew=0)
            note = axes.annotate(
                f"n = {choice.every}", (speed, 1000 * choice.worst), (2, 3) if above else (-2, -3),
                textcoords="offset points",
                size=SMALL_PT, ha="left" if above else "right", va="bottom" if above else "top", color=INK,
            )  # fmt: skip
            note.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
        before = choice.every
