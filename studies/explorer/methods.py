"""Every method side by side, as plain data: what it needs, where it lands, how accurate it is then."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from sched_sim.design.binding import BINDING_WORDS
from sched_sim.design.methods import METHODS
from sched_sim.text import visible
from studies.explorer.accuracy import Accuracy
from studies.explorer.front import FrontLine
from studies.explorer.planned import Planned
from studies.explorer.power import Power
from studies.explorer.resolved import Resolved
from studies.explorer.staircases import MOST_STAIRS
from studies.selection.choice import Candidate
from studies.selection.front import some_landings


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
class AccuracyCurve:
    """Columns: the standard deviation of the output by where corrections land, None where it has no bound."""

    L: list[int]
    std: list[float | None]


@dataclass(frozen=True, slots=True)
class Within:
    """What the method needs to keep the accuracy that is asked for. L: the latest landing that does, std: the figure
    then; least, power: the least speed for it. part: the cheapest that will do, needed: the share of its speed, else of
    the nearest; landed, landed_std: on it. reason: why it will not do; query: of that design on that part."""

    L: int | None
    std: float | None
    least: Fraction | None
    power: float | None
    part: str | None
    needed: Fraction | None
    landed: int | None
    landed_std: float | None
    reason: str
    query: str


@dataclass(frozen=True, slots=True)
class MethodView:
    """One method beside the others, at the same N, M and L. reason: why it cannot be had, empty if it can; query: of
    its design. power: of the least speed; achieved_l: as it runs, None if it does not land, std: the figure of the
    output then; fits: None where it runs at its least speed. within: None where no accuracy is asked for; accuracy,
    front: None where no model is, or it has none of this method."""

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
    within: Within | None = None
    staircase: Staircase | None = None
    landing: Landing | None = None
    accuracy: AccuracyCurve | None = None
    front: FrontLine | None = None


def method_view(
    asked: Resolved,
    plan: Planned,
    power: Power,
    figures: Accuracy | None,
    kept: Candidate | None,
    front: FrontLine | None,
) -> MethodView:
    return MethodView(
        plan.method,
        "",
        asked.queries.but(method=plan.method),
        asked.asked_L(plan.method),
        plan.least.speed,
        power.of(plan.least.speed),
        binding_words(plan.least.binding),
        plan.landed,
        asked.sampling.ms(plan.landed),
        None if figures is None else figures.at(plan.landed),
        None if asked.pace is None else plan.fits,
        None if kept is None else within_of(asked, plan.method, kept, power),
        Staircase(
            [stair.L for stair in plan.stairs],
            [power.of(stair.speed) for stair in plan.stairs],
            [stair.achieved for stair in plan.stairs],
        ),
        Landing([power.of(speed) for speed, _ in plan.turns], [landed for _, landed in plan.turns]),
        None if figures is None else _curve(figures, plan.timing.L),
        front,
    )


def refused_view(asked: Resolved, method: str, reason: str) -> MethodView:
    """Of one that cannot be had."""
    return MethodView(method, reason, asked.queries.but(method=method))


def within_of(asked: Resolved, method: str, kept: Candidate, power: Power) -> Within:
    on = kept.parts[0] if kept.parts else None
    part = None if on is None or not on.fits else on.name
    named = asked.design.processor if on is None or not on.fits or on.part is None else on.part.name
    at: dict[str, Any] = {"method": method, "processor": named}
    if kept.L is not None:
        only_first = METHODS[method].law(asked.design.options.feedback).only_first
        at |= {"L": None if only_first else kept.L, "land_within_ms": None}
    if named:
        at["speed"] = None
    least = None if kept.least is None else kept.least.speed
    return Within(
        kept.L,
        kept.std,
        least,
        None if least is None else power.of(least),
        part,
        None if on is None else on.needed,
        kept.landed if on is None else on.landed,
        kept.landed_std if on is None else on.std,
        kept.reason,
        asked.queries.but(**at),
    )


def _curve(figures: Accuracy, L: int) -> AccuracyCurve | None:
    if figures.curve is None:
        return None
    first = figures.curve.first
    last = first + len(figures.curve.figures) - 1
    at = sorted({*some_landings(first, last, MOST_STAIRS), *({L} & {*range(first, last + 1)})})
    return AccuracyCurve(at, [figures.at(landing) for landing in at])


def binding_words(binding: str) -> str:
    """What fixes a least speed, as people read it."""
    return visible(BINDING_WORDS.get(binding, binding))
