"""What each method needs to keep an accuracy: the latest landing that does, its least speed, the cheapest part."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace
from functools import lru_cache

from sched_sim.design.least_speed import has_closed_form
from studies.explorer.accuracy import curve_of, lacks
from studies.explorer.cheapest import cheapest
from studies.explorer.parts import Where
from studies.explorer.same import Same, contents, itself
from studies.selection.choice import Candidate
from studies.selection.considered import considered
from studies.selection.landing import earliest
from studies.selection.methods import METHODS
from studies.selection.parts import too_slow
from studies.selection.question import Question
from studies.selection.variants import Variant, variants


def keeping(question: Question, methods: Sequence[str], current: str, where: Where | None) -> dict[str, Candidate]:
    """As `studies.choose_filter` says of each method, with every measurement and the options of the question alone.

    question: with the costs that the least speed is of, and the tasks in their unit; its parts are not looked at.
    where: of these only the cheapest that does is looked for, or else the nearest. current: the one method that is
    looked at where each takes simulations.
    """
    simulated, same = not has_closed_form(question.options, question.tasks), _same(question)
    place = None if where is None else Same(where, _contents(where))
    return {
        method: _none(question, method, OF_CURRENT)
        if simulated and method != current
        else _keeping(same, method, place)
        for method in methods
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
    return table, parts, where.rate, where.options, where.statistic, where.tasks


@lru_cache(maxsize=KEPT)
def _keeping(same: Same[Question], method: str, where: Same[Where] | None) -> Candidate:
    question = same.value
    if reason := lacks(question, method):
        return _none(question, method, reason)
    variant = next(variants([method], (1,), question.tables, question.options, question.ways), None)
    if variant is None:
        return _none(question, method, f"the cost table {question.tables[0].name} has no costs of it")
    found = considered(question, lambda of: curve_of(question, of.method), variant)
    return found if where is None or found.L is None else _on_cheapest(question, found, where.value)


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
    looked = cheapest(where.places(method), timing, found.variant.options, where.tasks)
    parts = tuple(
        replace(on, std=None if on.landed is None else curve.at(max(on.landed, found.first))) for on in looked
    )
    reason = "" if not parts or parts[0].fits else too_slow(parts)
    return replace(found, parts=parts, reason=reason)
