"""One method at the N, M and L of a design: what it needs, and where its corrections land."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from sched_sim.design.landing import landing
from sched_sim.design.least_speed import LeastSpeed, Stair, achieved_l, has_closed_form, least_speed
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from studies.explorer.resolved import Resolved
from studies.explorer.searched import MOST_WORK, MOST_WORK_BESIDE, check_beside, check_searched, patience
from studies.explorer.staircases import landings, stairs


@dataclass(frozen=True, slots=True)
class Planned:
    """One method at the design's N, M and L. speed: that it runs at, its least if none was asked for; landed: the L at
    which corrections land then, None if they do not; fits: whether every deadline holds then. stairs: what other L ask
    for; turns: speeds from which on it lands in another step."""

    method: str
    costs: Costs
    timing: Timing
    least: LeastSpeed
    speed: Fraction
    landed: int | None
    fits: bool
    stairs: Sequence[Stair]
    turns: Sequence[tuple[Fraction, int | None]]


def planned(asked: Resolved, method: str) -> Planned:
    """Raises InputError that says why the method cannot be had."""
    options, tasks = asked.design.options, asked.tasks
    timing, costs = asked.timing(method), asked.costs(method)
    current = method == asked.design.method
    (check_searched if current else check_beside)(costs, timing, options, tasks)
    least = least_speed(costs, timing, options, tasks, on_work=patience(MOST_WORK if current else MOST_WORK_BESIDE))
    speed = least.speed if asked.pace is None else asked.pace
    held = landing(costs, timing, speed, options, tasks, least.speed)
    landed = held
    if held is None and has_closed_form(options, tasks, costs, timing):
        landed = achieved_l(costs, timing, speed, options)
    known = stairs(costs, timing, options, tasks, least, beside=current)
    runs = [] if held is None else [Stair(timing.L, speed, least.binding, held)]
    turns = landings(costs, timing, options, tasks, [*known, *runs])
    return Planned(method, costs, timing, least, speed, landed, held is not None, known, turns)
