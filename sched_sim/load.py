"""The share of its time that the processor works: exact, from the work of one measurement cycle."""

from __future__ import annotations

from fractions import Fraction

from sched_sim.costs import (
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
)
from sched_sim.timing import Timing


def load(costs: JobCosts, timing: Timing, speed: Fraction) -> Fraction:
    """Work per time, of one processor: 1 is all of it; without context switches. speed: cost units per HR period.

    That it is below 1 is needed, and does not suffice: a deadline may need more for a while (`least_speed`).
    """
    return Fraction(work_of_cycle(costs, timing)) / (timing.N * speed)


def work_of_cycle(costs: JobCosts, timing: Timing) -> Fraction:
    """All that is done in N steps, in cost units."""
    N, M = timing.N, timing.M
    work: Fraction
    match costs:
        case StandardCosts(propagate, update):
            work = N * propagate + update
        case RecalculateCosts(propagate, update, replay):
            work = N * propagate + update + M * replay
        case LarsenCosts(propagate, accumulate, update):
            products = max(M - 1, 0)
            work = (N - products) * propagate + products * accumulate + update
        case DualRateCosts(hr, hr_restart, hr_update, lr_propagate, lr_gain, lr_update):
            work = (N - 1) * hr + hr_restart + hr_update + lr_propagate + lr_gain + lr_update
        case MultirateCosts(high, low) | RobustCosts(high, low):
            work = N * high + low
    return work
