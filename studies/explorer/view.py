"""All that is known of one design, as plain data: what the explorer shows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf
from typing import Any

from sched_sim.design.methods import method_of
from sched_sim.errors import InputError
from studies.explorer.accuracy import Accuracy, accuracy
from studies.explorer.answer import Answer, DesignFound, answer
from studies.explorer.choices import Choices, choices_of
from studies.explorer.commands import Commands, commands
from studies.explorer.current import Current, current_of, said_of
from studies.explorer.design import Design
from studies.explorer.document import document
from studies.explorer.front import FrontLine, front
from studies.explorer.given import Given
from studies.explorer.grounds import grounds
from studies.explorer.limits import Limits, limits
from studies.explorer.methods import MethodView, method_view, refused_view
from studies.explorer.part_views import PartView, part_view
from studies.explorer.parts import Where, verdicts, where_of
from studies.explorer.planned import Planned, planned
from studies.explorer.power import Power, power_of
from studies.explorer.question import question_of
from studies.explorer.resolved import Resolved, resolved
from studies.explorer.schedule import Timeline, timeline
from studies.explorer.searched import most_beside, searched
from studies.explorer.warnings import warnings
from studies.explorer.within import keeping
from studies.selection.choice import Candidate
from studies.selection.question import Question


@dataclass(frozen=True, slots=True)
class View:
    """What `explore` returns; `document` makes JSON of it. Fractions are exact; powers are floats, in the unit of
    `power`; lists are columns; None is what is not known or not there.

    query: the link; design: every key of it, with what the design comes to. limits: how far N, M and L may go. current:
    the design itself, schedule: what its processor does; methods: beside it all others, parts: where it may run.
    """

    query: str
    design: dict[str, Any]
    choices: Choices
    limits: Limits
    period_ms: float | None
    power: Power
    answer: Answer
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    current: Current
    schedule: Timeline
    methods: tuple[MethodView, ...]
    parts: tuple[PartView, ...]
    commands: Commands

    def document(self) -> dict[str, Any]:
        """Plain data: objects, lists, numbers, text and None."""
        found: dict[str, Any] = document(self)
        del found["power"]["per_unit"]
        return found


def explore(design: Design, given: Given = Given()) -> View:
    """All that is known of one design: its schedule, each method's least speed and landing, accuracy and parts.

        explore(Design(N=10, M=4, L=8))
        explore(Design(hr_hz=400, measurement_hz=5, delay_ms=110, model="ins-gps", within="0.4"))

    given: what was loaded beside what ships, by the names that the design has for it.

    Raises InputError that names what is wrong, its value and what to give.
    """
    asked = resolved(design, given)
    current, power = planned(asked, design.method), power_of(asked)
    plans, refused = _plans(asked, current)
    question = question_of(asked)
    figures = {} if question is None else _figures(question, plans, design.method)
    where, why_nowhere = _where(asked, current)
    kept = {} if question is None else _kept(question, plans, design.method, where)
    own = figures.get(design.method)
    looked = () if where is None else verdicts(where, design.method, current.timing, own.at if own else _unknown)
    period_ms = None if asked.rate is None else float(1000 / asked.rate)
    shown = timeline(
        current.costs, current.timing, current.speed, design.cycles, design.options, asked.tasks, period_ms
    )
    fronts = _fronts(plans, figures, power)
    found = DesignFound(asked, current, shown, own, kept, looked)
    return View(
        asked.queries.but(),
        said_of(asked, current),
        choices_of(asked),
        limits(asked),
        period_ms,
        power,
        answer(found),
        warnings(found),
        tuple(filter(None, [*asked.stated.words.split("\n"), *grounds(found), why_nowhere])),
        current_of(asked, current, power, own, shown.misses),
        shown,
        tuple(
            refused_view(asked, method, refused[method])
            if method in refused
            else method_view(asked, plans[method], power, figures.get(method), kept.get(method), fronts.get(method))
            for method in asked.methods
        ),
        tuple(part_view(asked, on) for on in looked),
        commands(asked, current),
    )


def _plans(asked: Resolved, current: Planned) -> tuple[dict[str, Planned], dict[str, str]]:
    """By method, and why others cannot be had."""
    plans, refused = {current.method: current}, {}
    for method in asked.methods:
        if method == current.method:
            continue
        try:
            plans[method] = planned(asked, method)
        except InputError as error:
            refused[method] = str(error)
    return plans, refused


def _figures(question: Question, plans: Mapping[str, Planned], current: str) -> dict[str, Accuracy]:
    return {
        method: accuracy(question, method, whole=method == current, last=plan.timing.L)
        for method, plan in plans.items()
    }


def _kept(question: Question, plans: Mapping[str, Planned], current: str, where: Where | None) -> dict[str, Candidate]:
    """What each method needs for the accuracy, if one is asked for; on parts where none takes a search, and on the
    machine whose times the costs are."""
    if question.within == inf:
        return {}
    closed = [
        method
        for method, plan in plans.items()
        if not searched(plan.costs, plan.timing, question.options, question.tasks)
    ]
    others = [method for method in plans if method not in closed]
    machine = None if where is None or where.parts else where
    return keeping(question, closed, current, where) | keeping(question, others, current, machine)


def _fronts(plans: Mapping[str, Planned], figures: Mapping[str, Accuracy], power: Power) -> dict[str, FrontLine]:
    stairs = {
        method: ([stair.L for stair in plan.stairs], [power.of(stair.speed) for stair in plan.stairs])
        for method, plan in plans.items()
    }
    return front(stairs, figures)


def _where(asked: Resolved, plan: Planned) -> tuple[Where | None, str]:
    """Where the design may run, and why nothing is known of other places: not where each takes a long search,
    but for the machine whose times the costs are, of which all is known already."""
    where, why = where_of(asked)
    options, timing = asked.design.options, plan.timing
    periods = searched(plan.costs, timing, options, asked.tasks)
    alone = method_of(plan.costs).law(options.feedback).one_in_flight(timing.N, timing.L)
    if where is None or not where.parts or periods == 0 or (alone and periods <= most_beside(asked.tasks)):
        return where, why
    if asked.part is None:
        return None, "no parts: on each the least speed takes a search by simulation: choose a processor"
    return replace(where, parts=(asked.part,)), "other parts: on each the least speed takes a search by simulation"


def _unknown(_L: int) -> None:
    return None
