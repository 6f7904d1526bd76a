"""What each method needs to keep an accuracy: the latest landing that does, its least speed, the cheapest part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from sched_sim.design.least_speed import has_closed_form
from studies.explorer.accuracy import curve_of, lacks
from studies.explorer.cheapest import cheapest
from studies.explorer.parts import on_parts
from studies.explorer.same import Same, contents, itself
from studies.selection.choice import Candidate
from studies.selection.considered import considered
from studies.selection.landing import earliest
from studies.selection.methods import METHODS
from studies.selection.parts import too_slow
from studies.selection.question import Question
from studies.selection.variants import Variant, variants


def keeping(question: Question, methods: Sequence[str], current: str) -> dict[str, Candidate]:
    """As `studies.choose_filter` says of each method, with every measurement and the options of the question alone; of
    its parts only the cheapest that does, or else the nearest.

    current: the one method that is looked at where each takes simulations.
    """
    simulated, same = not has_closed_form(question.options, question.tasks), _same(question)
    return {
        method: _none(question, method, OF_CURRENT) if simulated and method != current else _keeping(same, method)
        for method in methods
    }


KEPT = 256
"""Methods of questions, at most."""

OF_CURRENT = "each method takes simulations with such a processor: choose it"


def _same(question: Question) -> Same[Question]:
    """Known by all that it depends on; tables and parts by being the same ones."""
    arrays = question.model.linear, question.outputs, question.conditions
    objects = *question.tables, *question.parts
    return Same(
        question,
        (
            contents(arrays),
            tuple(map(itself, objects)),
            question.sampling,
            question.within,
            question.metric,
            question.options,
            question.statistic,
            tuple(question.tasks),
        ),
    )


@lru_cache(maxsize=KEPT)
def _keeping(same: Same[Question], method: str) -> Candidate:
    question = same.value
    if reason := lacks(question, method):
        return _none(question, method, reason)
    variant = next(variants([method], (1,), question.tables, question.options, question.ways), None)
    if variant is None:
        return _none(question, method, f"the cost table {question.tables[0].name} has no costs of it")
    return _on_cheapest(question, considered(question, lambda of: curve_of(question, of.method), variant))


def _none(question: Question, method: str, reason: str) -> Candidate:
    """Of a method that is not looked at."""
    variant = Variant(method, 1, question.tables[0], question.options)
    first = earliest(method, question.sampling.M, question.options) if method in METHODS else 0
    return Candidate(variant, question.sampling.N, first, float("inf"), reason=reason)


def _on_cheapest(question: Question, found: Candidate) -> Candidate:
    rate, method = question.sampling.hr_hz, found.variant.method
    if rate is None or found.L is None:
        return found
    table, options = found.variant.table, found.variant.options
    delay = 0 if METHODS[method].landing == "at once" else question.sampling.M
    places = on_parts(table, question.parts, question.statistic).places(table, method, rate, options)
    looked = cheapest(places, question.sampling.timing(delay, found.L), options, question.tasks)
    curve = curve_of(question, method)
    parts = tuple(
        replace(on, std=None if on.landed is None else curve.at(max(on.landed, found.first))) for on in looked
    )
    reason = "" if not parts or parts[0].fits else too_slow(parts)
    return replace(found, parts=parts, reason=reason)
