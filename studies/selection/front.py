"""Power against accuracy: what each method asks for by where it lands, and which designs no other one beats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from sched_sim.design.least_speed import has_closed_form, least_speed
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.methods import select
from sched_sim.errors import InputError
from studies.selection.compare import undelayed
from studies.selection.landing import earliest
from studies.selection.methods import METHODS
from studies.selection.question import Accuracies, Question
from studies.selection.unbeaten import unbeaten
from studies.selection.variants import Variant, variants

if TYPE_CHECKING:
    from studies.selection.curve import Curve

LANDINGS = 24
"""Looked at of one method, at most."""


@dataclass(frozen=True, slots=True)
class FrontPoint:
    """One design: the method with every so manieth measurement lands L steps after each; std: the figure of the output
    then; speed: the least, over all ways to run it, in the unit of the cost tables per HR period. on_front: no other
    design is as accurate with less."""

    method: str
    every: int
    L: int
    std: float
    speed: float
    on_front: bool = False


@dataclass(frozen=True)
class Front:
    """points: by method, then by how many measurements are used, then by landing. within: the accuracy asked for;
    no_delay: the figure of the filter without delay that uses every measurement."""

    points: tuple[FrontPoint, ...]
    within: float
    no_delay: float
    metric: str
    output: str
    output_unit: str
    cost_unit: str


def front(question: Question, methods: Sequence[str], every: Sequence[int]) -> Front:
    """Of these methods."""
    accuracy = Accuracies(question, whole=True)
    least: dict[tuple[str, int, int], FrontPoint] = {}
    for variant in variants(methods, every, question.tables, question.options, question.ways):
        for point in _points(question, accuracy, variant):
            key = point.method, point.every, point.L
            if key not in least or point.speed < least[key].speed:
                least[key] = point
    points = sorted(least.values(), key=lambda point: (methods.index(point.method), point.every, point.L))
    best = unbeaten([(point.speed, point.std) for point in points])
    return Front(
        tuple(replace(point, on_front=on_front) for point, on_front in zip(points, best, strict=True)),
        question.within,
        undelayed(question.model, question.outputs, question.sampling, question.metric),
        question.metric,
        question.outputs.name,
        question.outputs.unit,
        question.tables[0].unit,
    )


def _points(question: Question, accuracy: Accuracies, variant: Variant) -> Iterator[FrontPoint]:
    using = question.sampling.using(variant.every)
    delay = 0 if METHODS[variant.method].landing == "at once" else using.M
    first = earliest(variant.method, using.M, variant.options)
    law = SCHEDULED[variant.method].law(variant.options.feedback)
    last = first if METHODS[variant.method].landing != "later" else law.last_of_use(using.N, delay)
    try:
        curve: Curve = accuracy.of(variant)
        costs = select(variant.table, variant.method, variant.options, question.statistic)
    except ValueError:
        return
    for L in some_landings(first, min(last, curve.first + len(curve.figures) - 1)):
        std = curve.at(L)
        timing = using.timing(delay, max(L, delay))
        in_closed_form = has_closed_form(variant.options, question.tasks_in_unit, costs, timing)
        if variant.is_beside(question.options) and not in_closed_form:
            continue
        try:
            speed = least_speed(costs, timing, variant.options, question.tasks_in_unit).speed
        except InputError:
            continue
        if std < float("inf"):
            yield FrontPoint(variant.method, variant.every, L, std, float(speed))


def some_landings(first: int, last: int, most: int = LANDINGS) -> list[int]:
    """From the first to the last, denser where each step counts most; all where there are no more than `most`."""
    if last - first < most:
        return list(range(first, last + 1))
    ratio = (last - first) ** (1 / (most - 1))
    return sorted({first + round(ratio**number) - 1 for number in range(most - 1)} | {last})
