"""Every method side by side: what it needs, where it lands, and its staircase."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from sched_sim.design.binding import BINDING_WORDS
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import LeastSpeed, Stair, achieved_l, has_closed_form, least_speed
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from studies.explorer.power import Power
from studies.explorer.query import query_of
from studies.explorer.resolved import Resolved
from studies.explorer.searched import check_beside, check_searched
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
    least = least_speed(costs, timing, options, tasks)
    speed = least.speed if asked.pace is None else asked.pace
    held = landing(costs, timing, speed, options, tasks)
    landed = held
    if held is None and has_closed_form(options, tasks, costs, timing):
        landed = achieved_l(costs, timing, speed, options)
    known = stairs(costs, timing, options, tasks, least, beside=current)
    turns = landings(costs, timing, options, tasks, known)
    return Planned(method, costs, timing, least, speed, landed, held is not None, known, turns)


@dataclass(frozen=True, slots=True)
class Staircase:
    """Columns, by L: the power of the least speed, and the L at which corrections land then."""

    L: list[int]
    power: list[float]
    achieved: list[int]


@dataclass(frozen=True, slots=True)
class Landing:
    """Columns: from each power on corrections land at this L, until the next one; before the first they do not."""

    power: list[float]
    L: list[int | None]


@dataclass(frozen=True, slots=True)
class MethodView:
    """One method beside the others, at the same N, M and L. reason: why it cannot be had, empty if it can; query: of
    its design. power: of the least speed; achieved_l: as it runs, None if it does not land; fits: None where it runs at
    its least speed."""

    method: str
    reason: str
    query: str
    L: int | None = None
    least: Fraction | None = None
    power: float | None = None
    binding: str | None = None
    achieved_l: int | None = None
    landed_ms: float | None = None
    std: float | None = None
    fits: bool | None = None
    within: Any = None
    staircase: Staircase | None = None
    landing: Landing | None = None
    accuracy: Any = None
    front: Any = None


def method_view(asked: Resolved, plan: Planned, power: Power) -> MethodView:
    """Without what its accuracy says."""
    return MethodView(
        plan.method,
        "",
        query_of(replace(asked.design, method=plan.method)),
        plan.timing.L,
        plan.least.speed,
        power.of(plan.least.speed),
        binding_words(plan.least.binding),
        plan.landed,
        asked.sampling.ms(plan.landed),
        fits=None if asked.pace is None else plan.fits,
        staircase=Staircase(
            [stair.L for stair in plan.stairs],
            [power.of(stair.speed) for stair in plan.stairs],
            [stair.achieved for stair in plan.stairs],
        ),
        landing=Landing([power.of(speed) for speed, _ in plan.turns], [landed for _, landed in plan.turns]),
    )


def refused_view(asked: Resolved, method: str, why: InputError) -> MethodView:
    return MethodView(method, str(why), query_of(replace(asked.design, method=method)))


def binding_words(binding: str) -> str:
    """What fixes a least speed, as people read it."""
    return BINDING_WORDS.get(binding, binding)
