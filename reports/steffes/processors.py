"""The dual-rate filter on one processor or two, its gain computed early or not; and what switching tasks takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from reports.charts.panels import METHOD_NAMES
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import METHOD_LINES, PALE, Line, drawing
from reports.steffes.curves import achieved_curve, speed_grid
from reports.steffes.speeds import SPEED_UNIT
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing

HEIGHT_MM = 44.0
CURVE_POINTS = 300
VARIANTS = {
    "one CPU": Options(),
    "one CPU, early gain": Options(gain="precomputed"),
    "two CPUs": Options(cpus=2),
    "two CPUs, early gain": Options(cpus=2, gain="precomputed"),
}
LINES = dict(
    zip(
        VARIANTS,
        (
            METHOD_LINES["dual-rate"],
            Line("#1d8a8a", (0, (4.0, 1.5)), "<"),
            Line("#2e7d4f", (0, (1.0, 1.2)), "P", 4.4),
            Line("#5c3a6b", (0, (5.0, 1.5, 1.0, 1.5)), ">"),
        ),
        strict=True,
    )
)
"""Not the looks of other methods: all are the dual-rate filter."""
SWITCHES = tuple(Fraction(hundredths, 100) for hundredths in (0, 1, 2, 5, 10, 20, 40, 60, 80))
"""What a switch takes, in standard steps."""


class Variant(NamedTuple):
    """speed: the least; lands: where the correction does at that speed; beside: where at the least speed of one CPU."""

    name: str
    speed: Fraction
    lands: int | None
    beside: int | None


def variants(table: CostTable, timing: Timing) -> list[Variant]:
    """Of the dual-rate filter in one design. table: with the cost of the gain apart."""
    one_cpu = least_speed(select(table, "dual-rate"), timing).speed
    found = []
    for name, options in VARIANTS.items():
        costs = select(table, "dual-rate", options)
        speed = least_speed(costs, timing, options).speed
        at = [achieved_l(costs, timing, each, options) for each in (speed, one_cpu)]
        found.append(Variant(name, speed, *at))
    return found


def landings(table: CostTable, timing: Timing) -> dict[str, list[tuple[float, int]]]:
    """Of each variant the speeds, from the slowest, and where the correction lands at each."""
    table, N, M = table.normalised(), timing.N, timing.M
    stairs = {name: staircase(select(table, "dual-rate", of), N, M, of) for name, of in VARIANTS.items()}
    slowest = 0.93 * float(min(stair.speed for of in stairs.values() for stair in of))
    fastest = 1.05 * float(max(stair.speed for of in stairs.values() for stair in of))
    found = {}
    for name, options in VARIANTS.items():
        speeds = speed_grid(slowest, fastest, CURVE_POINTS, [stair.speed for stair in stairs[name]])
        curve = achieved_curve(select(table, "dual-rate", options), N, M, speeds, options)
        found[name] = [(float(speed), L) for speed, L in zip(speeds, curve, strict=True) if L is not None]
    return found


def steps_of(curve: Sequence[tuple[float, int]]) -> list[tuple[float, int]]:
    """Where it steps: the first speed of each L."""
    return [
        point for before, point in zip([None, *curve], curve, strict=False) if before is None or before[1] != point[1]
    ]


def processors_figure(landed: Mapping[str, Sequence[tuple[float, int]]], timing: Timing) -> Figure:
    """Where the correction lands against speed, for each variant, from the least speed on at which it does.

    landed: from `landings`.
    """
    N, M = timing.N, timing.M
    least, most = (end(speed for of in landed.values() for speed, _ in of) for end in (min, max))
    with drawing():
        drawn = sheet(1, 1, [line_entry(name, line) for name, line in LINES.items()], height_mm=HEIGHT_MM)
        ((axes,),) = drawn.plots
        for number, (name, points) in enumerate(landed.items()):
            line = LINES[name]
            across = [speed for speed, _ in points]
            up = [L - 0.09 * number for _, L in points]
            axes.step(across, up, where="post", color=line.colour, ls=line.dashes, lw=1.3, label=name)
            axes.plot(across[:1], up[:1], line.marker, color=line.colour, ms=line.size + 0.6, zorder=3)
        axes.set(xlim=(0.93 * least, most), ylim=(M, N + 0.7))
        axes.fmt_ydata = lambda at: f"L = {round(at + 0.1)}"
        axes.xaxis.set_major_locator(MultipleLocator(0.1))
        axes.grid(axis="x", color=PALE, lw=0.5)
        label(
            axes,
            f"Dual-rate, $N = {N}$, $M = {M}$, by counts",
            f"speed ({SPEED_UNIT})",
            "lands at $L$ (steps after $k$)",
        )
        return drawn.figure


def switched(table: CostTable, timing: Timing) -> dict[str, list[Fraction]]:
    """The least speed at each cost of a switch, by method."""
    return {
        method: [
            least_speed(select(table, method, options), timing, options).speed
            for options in (Options(context_switch=cost) for cost in SWITCHES)
        ]
        for method in ("larsen", "dual-rate")
    }


def switches_figure(speeds: Mapping[str, Sequence[Fraction]]) -> Figure:
    """speeds: from `switched`."""
    with drawing():
        legend = [line_entry(METHOD_NAMES[method], METHOD_LINES[method]) for method in speeds]
        drawn = sheet(1, 1, legend, height_mm=HEIGHT_MM)
        ((axes,),) = drawn.plots
        for method, of in speeds.items():
            line = METHOD_LINES[method]
            axes.plot(
                [float(cost) for cost in SWITCHES],
                [float(speed) for speed in of],
                marker=line.marker,
                color=line.colour,
                ls=line.dashes,
                ms=line.size,
                mew=0,
                clip_on=False,
                label=METHOD_NAMES[method],
            )
        axes.set(xlim=(0, 1.02 * float(SWITCHES[-1])), ylim=(0, None))
        label(
            axes,
            "By the costs of the paper",
            "cost of a context switch (standard steps)",
            f"least speed\n({SPEED_UNIT})",
        )
        return drawn.figure
