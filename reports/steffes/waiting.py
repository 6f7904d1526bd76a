"""Least speed of the dual-rate filter against L - M, the steps that it waits: all designs on one curve."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, METHOD_LINES, SMALL_PT, Line, drawing
from reports.steffes.signs import OUTLINE, hollow_entry
from reports.steffes.speeds import SPEED_UNIT, speed_ticks
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Timing

HEIGHT_MM = 52.0
FAMILIES = {
    "N = 10, M from 2": (10, range(2, 10)),
    "N = 10, M = 1": (10, range(1, 2)),
    "N = 100, M from 2": (100, (2, 10, 50)),
}
"""Designs by how they are drawn: N, and each M of which every L is taken."""
LINES: dict[str, Line] = {
    family: METHOD_LINES["dual-rate"]._replace(marker=marker, size=size)
    for family, marker, size in zip(FAMILIES, "ovs", (6.0, 4.6, 2.2), strict=True)
}
"""All are designs of the dual-rate filter, and have its colour."""


class Waited(NamedTuple):
    """A design, and its least speed."""

    family: str
    timing: Timing
    speed: Fraction

    @property
    def waits(self) -> int:
        """L - M."""
        return self.timing.L - self.timing.M


def waited(table: CostTable) -> list[Waited]:
    """The designs of all families, every L of each N and M."""
    costs = select(table, "dual-rate")
    return [
        Waited(family, Timing(N, M, stair.L), stair.speed)
        for family, (N, delays) in FAMILIES.items()
        for M in delays
        for stair in staircase(costs, N, M)
    ]


def by_wait(costs: DualRateCosts[Fraction], waits: int) -> Fraction:
    """The least speed if L - M alone mattered: the LR update in what the HR jobs of that many steps leave, and the HR
    job of step l."""
    return max(costs.hr + costs.lr_update / waits, costs.hr + costs.hr_update)


def off_the_curve(found: Sequence[Waited], table: CostTable) -> Iterator[Waited]:
    """The designs that need another speed than that of their L - M."""
    costs = select(table, "dual-rate")
    assert isinstance(costs, DualRateCosts)
    return (one for one in found if one.speed != by_wait(costs, one.waits))


def waiting_figure(table: CostTable) -> Figure:
    """table: normalised costs."""
    costs, found = select(table, "dual-rate"), waited(table)
    assert isinstance(costs, DualRateCosts)
    larsen = float(least_speed(select(table, "larsen"), found[0].timing).speed)
    curve, level = METHOD_LINES["dual-rate"], METHOD_LINES["larsen"]
    with drawing():
        legend = [
            *(hollow_entry(family, line, line.size, dashes=False) for family, line in LINES.items()),
            line_entry("if $L-M$ alone counts", curve._replace(marker="")),
            line_entry(f"Larsen, {larsen:.2f}", level._replace(marker="")),
        ]
        drawn = sheet(1, 1, legend, height_mm=HEIGHT_MM)
        ((axes,),) = drawn.plots
        limits = 0.93 * float(min(one.speed for one in found)), 1.08 * larsen
        most = max(one.waits for one in found)
        axes.set(xlim=(0.9, 1.15 * most), ylim=limits, xscale="log")
        axes.xaxis.set_major_locator(FixedLocator([1, 2, 4, 6, 10, 20, 50, most]))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        speed_ticks(axes, "y", limits)
        steps = range(1, most + 1)
        axes.plot(steps, [float(by_wait(costs, step)) for step in steps], color=curve.colour, lw=0.9, zorder=2)
        axes.axhline(larsen, color=level.colour, ls=level.dashes, lw=1.2, label="Larsen")
        for family, line in LINES.items():
            of = sorted({(one.waits, one.speed) for one in found if one.family == family})
            across, up = [waits for waits, _ in of], [float(speed) for _, speed in of]
            look: dict[str, Any] = {"mfc": "white", "mec": line.colour, "mew": 0.9, "ms": line.size}
            axes.plot(across, up, line.marker, color=line.colour, zorder=3, label=family, **look)
        knee = next(step for step in steps if by_wait(costs, step) == costs.hr + costs.hr_update)
        axes.axvline(knee, color=GREY, lw=0.7, ls=(0, (2, 1.5)), zorder=1)
        note = axes.annotate(
            f"{float(by_wait(costs, knee)):.2f} from {knee} steps on:\nwaiting longer buys nothing",
            (knee, 1.15),
            (4, 0),
            textcoords="offset points",
            size=SMALL_PT,
        )
        note.set_path_effects(OUTLINE)
        label(axes, "Dual-rate, by the costs of the paper", "steps to wait, $L-M$", f"least speed\n({SPEED_UNIT})")
        return drawn.figure
