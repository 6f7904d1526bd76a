"""What each method needs to keep an accuracy: the latest landing that does, its least speed, the cheapest part."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace
from functools import lru_cache

from sched_sim.design.least_speed import has_closed_form
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.errors import InputError
from studies.explorer.accuracy import accuracy, curve_of, lacks
from studies.explorer.cheapest import cheapest
from studies.explorer.parts import Where
from studies.explorer.same import Same, contents, itself
from studies.explorer.searched import MOST_WORK_BESIDE, patience
from studies.selection.choice import Candidate
from studies.selection.considered import considered, too_coarse
from studies.selection.curve import Curve
from studies.selection.landing import earliest
from studies.selection.methods import METHODS
from studies.selection.parts import too_slow
from studies.selection.question import Question
from studies.selection.variants import Variant, variants


def keeping(question: Question, methods: Sequence[str], current: str, where: Where | None) -> dict[str, Candidate]:
    """As `studies.choose_filter` says of each method, with every measurement and the options of the question alone, and
    of landings before the next measurement, where there are any.

    question: with the costs that the least speed is of, and the tasks in their unit; its parts are not looked at.
    where: of these only the part that is chosen there, where it does, or the cheapest that does is looked for, or else
    the nearest. current: the one method that is
    looked at where each takes simulations, or a long sum.
    """
    simulated, same = not has_closed_form(question.options, question.tasks), _same(question)
    place = None if where is None else Same(where, _contents(where))
    looked = [method for method in methods if method == current or not (simulated or METHODS[method].floored)]
    return {
        method: _keeping(same, method, place) if method in looked else _accurate(question, method) for method in methods
    }


KEPT = 256
"""Methods of questions, at most."""

OF_CURRENT = "each method takes simulations with such a processor: choose it"


def _same(question: Question) -> Same[Question]:
    """Known by all that it depends on; tables and parts by being the same ones."""
    return Same(
        question,
        (
            contents((question.model.linear, question.outputs, question.conditions)),
            tuple(map(itself, question.tables)),
            question.sampling,
            question.within,
            question.metric,
            question.options,
            question.statistic,
            tuple(question.tasks),
        ),
    )


def _contents(where: Where) -> Hashable:
    table, parts = itself(where.table), tuple(map(itself, where.parts))
    return table, parts, where.rate, where.options, where.statistic, where.tasks, itself(where.chosen)


@lru_cache(maxsize=KEPT)
def _keeping(same: Same[Question], method: str, where: Same[Where] | None) -> Candidate:
    question = same.value
    if reason := lacks(question, method):
        return _none(question, method, reason)
    variant = next(variants([method], (1,), question.tables, question.options, question.ways), None)
    if variant is None:
        return _none(question, method, f"the cost table {question.tables[0].name} has no costs of it")
    found = considered(question, lambda of: _in_reach(question, of.method), variant, patience(MOST_WORK_BESIDE))
    if where is None or found.L is None:
        return found
    try:
        return _on_cheapest(question, found, where.value)
    except InputError as error:
        return replace(found, reason=str(error))


def _in_reach(question: Question, method: str) -> Curve:
    """By the landings that are looked at: those before the next measurement, where there are any, for of later ones the
    least speed may take a search."""
    sampling, curve = question.sampling, curve_of(question, method)
    last = SCHEDULED[method].law(question.options.feedback).last_alone(sampling.N, sampling.M)
    return curve if last is None else Curve(curve.first, curve.figures[: last + 1 - curve.first])


def _accurate(question: Question, method: str) -> Candidate:
    """Of a method whose schedule is not looked at: whether it is accurate enough."""
    figures = accuracy(question, method)
    if figures.curve is None:
        return _none(question, method, figures.reason)
    best, allowed = float(figures.curve.figures[0]), figures.curve.latest(question.within)
    found = replace(_none(question, method, OF_CURRENT), best=best, allowed=allowed)
    return found if allowed is not None else replace(found, reason=too_coarse(question, found))


def _none(question: Question, method: str, reason: str) -> Candidate:
    """Of a method that is not looked at."""
    variant = Variant(method, 1, question.tables[0], question.options)
    first = earliest(method, question.sampling.M, question.options) if method in METHODS else 0
    return Candidate(variant, question.sampling.N, first, float("inf"), reason=reason)


def _on_cheapest(question: Question, found: Candidate, where: Where) -> Candidate:
    method, curve = found.variant.method, curve_of(question, found.variant.method)
    assert found.L is not None
    delay = 0 if METHODS[method].landing == "at once" else question.sampling.M
    timing = question.sampling.timing(delay, found.L)
    places = where.places(method)
    chosen = [place for place in places if place.part is not None and place.part is where.chosen]
    looked = cheapest(chosen, timing, found.variant.options, where.tasks)
    if not looked or not looked[0].fits:
        looked = cheapest(places, timing, found.variant.options, where.tasks)
    parts = tuple(
        replace(on, std=None if on.landed is None else curve.at(max(on.landed, found.first))) for on in looked
    )
    reason = "" if not parts or parts[0].fits else too_slow(parts)
    return replace(found, parts=parts, reason=reason)
