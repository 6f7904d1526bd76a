"""The numbers behind the plots: least speed against L, and achieved L against speed. No graphics."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from sched_sim.design import analysis
from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.least_speed import Stair
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts, converted, works
from sched_sim.ticks import ticks_per_unit, to_ticks


class Knee(NamedTuple):
    """At `speed`, which the latest L asked for needs, corrections land at `achieved` already."""

    speed: Fraction
    achieved: int
    latest: int


def knee(stairs: Sequence[Stair]) -> Knee | None:
    """Where a later L asks for no less speed any more, so that waiting for it is waste; None if there is no such L.

    stairs: from `least_speed.staircase`, all of them; there are none for the dual-rate filter if M = N.
    """
    if not stairs:
        return None
    last = stairs[-1]
    return Knee(last.speed, last.achieved, last.L) if last.achieved < last.L else None


def achieved_curve(
    costs: Costs, N: int, M: int, speeds: Sequence[Fraction], options: Options = Options()
) -> list[int | None]:
    """The L at which corrections land at each speed; None where nothing lands. See `least_speed.achieved_l`."""
    resolution = ticks_per_unit([*works(costs), *speeds])
    in_ticks = converted(costs, lambda work: to_ticks(work, resolution))
    period = np.array([to_ticks(speed, resolution) for speed in speeds], dtype=object)
    landed = analysis.achieved_l(in_ticks, np.full_like(period, N), np.full_like(period, M), period, options)
    return [None if L == NOT_LANDED else int(L) for L in landed]


def speed_grid(slowest: float, fastest: float, points: int, exactly: Sequence[Fraction] = ()) -> list[Fraction]:
    """Speeds evenly spread on a logarithmic axis, to four digits, and those that must be among them."""
    spread = np.geomspace(slowest, fastest, points)
    return sorted({*exactly, *(Fraction(f"{value:.4g}") for value in spread)})


def hr_limit(costs: DualRateCosts[Fraction], N: int, options: Options = Options()) -> Fraction:
    """The speed below which some HR job of the dual-rate filter overruns its step: with next-step feedback that of
    step l, which also applies the correction."""
    ordinary = costs.hr if N > 1 else costs.hr_restart  # with N = 1, every step is a step k+1
    longest = max(ordinary, costs.hr_restart)
    limit: Fraction = max(longest, ordinary + costs.hr_update) if options.feedback == "next-step" else longest
    return limit
