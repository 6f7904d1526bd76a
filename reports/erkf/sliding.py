"""The schedules of the robust step for several L, each at its least speed: on two rates, and in one period."""

from __future__ import annotations

from fractions import Fraction

from reports.erkf.schedule import millions, one_period, two_rates
from reports.pages.pictures import Frame, Sliding
from sched_sim.design.least_speed import least_speed
from sched_sim.design.pieces import RobustCosts
from sched_sim.design.timing import Timing
from studies.robust.costs import HR_HZ, N

ASKED = (1, 2, 3, 4, 5, 8, 10, 15, 20, 30, 40)
"""The L that the slider goes through."""
DRAWN = 10
"""The one that the file shows, and paper."""


def over_l(costs: RobustCosts[Fraction]) -> Sliding:
    """For each L the schedule at the least speed that it needs, and below it, at the same speed, the one with the
    robust step in one period. costs: in operations."""
    return Sliding("L asked for", [_frame(costs, L) for L in ASKED], at=ASKED.index(DRAWN))


def _frame(costs: RobustCosts[Fraction], L: int) -> Frame:
    timing = Timing(N, 0, L)
    speed = least_speed(costs, timing).speed
    pace = f"{millions(speed, HR_HZ):.3g} million operations/s"
    apart = two_rates(costs, timing, speed, f"Two rates, L = {L}", pace)
    together = one_period(costs, N, speed, "In one period, at the same speed", pace)
    return Frame(f"L = {L}: {pace}", [apart, together])
