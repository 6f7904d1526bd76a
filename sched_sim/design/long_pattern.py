"""Dual-rate corrections on their way where the steps in which measurements are taken repeat only after very many."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from sched_sim.design.pieces import Costs, DualRateCosts
from sched_sim.design.timing import Timing

LONGEST_PATTERN = 2_000
"""HR steps; those of a longer one are not simulated to find a least speed."""


def is_bound(costs: Costs, timing: Timing) -> bool:
    """Whether the least speed is an upper bound, with all intervals the shorter one (`of_bound`)."""
    return isinstance(costs, DualRateCosts) and timing.instants is not None and timing.taken.steps > LONGEST_PATTERN


def of_bound(costs: Costs, timing: Timing) -> tuple[Costs, Timing]:
    """What is looked at in place of a very long pattern: each interval the shorter one, so that no more are on their
    way at any time, and every HR job the longest, for there are fewer that restart than at that interval."""
    if isinstance(costs, DualRateCosts) and is_bound(costs, timing):
        return without_restarts(costs), replace(timing, instants=None)
    return costs, timing


def without_restarts(costs: DualRateCosts[Fraction]) -> DualRateCosts[Fraction]:
    longest = max(costs.hr, costs.hr_restart)
    return replace(costs, hr=longest, hr_restart=longest)
