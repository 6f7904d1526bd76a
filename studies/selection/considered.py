"""One way to run a method: how late its corrections may land for an accuracy, and what processor it needs then."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from sched_sim.design.landing import landing
from sched_sim.design.least_speed import has_closed_form, least_speed
from sched_sim.design.method import Law
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.methods import select
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import phases_matter
from studies.selection.choice import Candidate
from studies.selection.curve import Curve
from studies.selection.landing import earliest
from studies.selection.methods import METHODS
from studies.selection.question import Question
from studies.selection.variants import Variant
from studies.selection.waiting import too_irregular, too_late


def considered(
    question: Question,
    curve_of: Callable[[Variant], Curve],
    variant: Variant,
    on_work: Callable[[int], None] = lambda _instants: None,
) -> Candidate:
    """The latest landing with which it keeps the accuracy, and the least speed for that, without parts.

    curve_of: the figure of the output by landing, ValueError where there is no regime; on_work: as of `least_speed`.
    """
    using = question.sampling.using(variant.every)
    first = earliest(variant.method, using.M, variant.options)
    delay = 0 if METHODS[variant.method].landing == "at once" else using.M
    if irregular := too_irregular(variant.method, using, variant.options):
        return Candidate(variant, using.N, first, float("inf"), reason=irregular)
    try:
        curve = curve_of(variant)
    except ValueError as error:
        return Candidate(variant, using.N, first, float("inf"), reason=str(error))
    curve = Curve(first, curve.figures[first - curve.first :])
    found = Candidate(variant, using.N, first, curve.at(first), curve.latest(question.within))
    if found.allowed is None:
        return replace(found, reason=too_coarse(question, found))
    if late := too_late(variant.method, question.sampling, variant.every, variant.options):
        return replace(found, reason=late)
    law = SCHEDULED[variant.method].law(variant.options.feedback)
    later = METHODS[variant.method].landing == "later"
    most: int | None = _last_known(question, law, using.N, delay)
    if variant.is_beside(question.options):
        most = law.last_alone(using.N, delay) if has_closed_form(variant.options, question.tasks_in_unit) else None
    if most is None:
        return replace(found, reason=NOT_TRIED)
    last = min(found.allowed, most) if later else found.first
    try:
        timing = using.timing(delay, max(last, delay))
        SCHEDULED[variant.method].check(timing, variant.options.feedback)
        costs = select(variant.table, variant.method, variant.options, question.statistic)
        least = least_speed(costs, timing, variant.options, question.tasks_in_unit, on_work=on_work)
    except InputError as error:
        return replace(found, reason=str(error))
    landed = landing(costs, timing, least.speed, variant.options, question.tasks_in_unit, least.speed)
    at = None if landed is None else (0 if delay == 0 and found.first == 0 else landed)
    return replace(
        found,
        L=timing.L,
        std=curve.at(timing.L),
        least=least,
        landed=at,
        landed_std=None if at is None else curve.at(max(at, first)),
    )


NOT_TRIED = "not tried"
"""Of a way beside the options that has no closed form."""


def _last_known(question: Question, law: Law, N: int, M: int) -> int:
    """By deadlines the worst phase of tasks is known with one correction on its way."""
    by_deadlines = question.options.policy == "edf" and phases_matter(question.tasks)
    return law.latest(N, M) if by_deadlines else law.last_of_use(N, M)


def too_coarse(question: Question, found: Candidate) -> str:
    """What it is at best, which is not enough."""
    measured = "" if found.variant.every == 1 else f" with every {ordinal(found.variant.every)} measurement"
    unit = f" {question.outputs.unit}" if question.outputs.unit else ""
    floor = "more than " if METHODS[found.variant.method].floored and found.variant.every > 1 else ""
    return f"{floor}{found.best:.4g}{unit} at best, landing at L={found.first}{measured}"


def ordinal(number: int) -> str:
    """second, third, 4th, ..."""
    return {2: "second", 3: "third"}.get(number, f"{number}th")
