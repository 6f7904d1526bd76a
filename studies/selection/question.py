"""All that a choice depends on, and the accuracies that it asks for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from sched_sim.costs.table import SECONDS, CostTable
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.processors.part import Part
from sched_sim.schedule.tasks import Task
from studies.selection.compare import Metric
from studies.selection.conditions import Conditions
from studies.selection.curve import Curve, at_arrival, by_landing
from studies.selection.methods import METHODS
from studies.selection.model import Model
from studies.selection.outputs import Outputs
from studies.selection.sampling import Sampling
from studies.selection.variants import WAYS, Variant, Ways


@dataclass(frozen=True)
class Question:
    """All that a choice depends on. parts: none where the costs are no counts, of operations or instructions, or the
    rate is not known. tasks: their costs in seconds where there are parts, else in the unit of the cost tables."""

    model: Model
    outputs: Outputs
    sampling: Sampling
    within: float
    metric: Metric
    conditions: Conditions
    tables: Sequence[CostTable]
    parts: Sequence[Part] = ()
    options: Options = Options()
    ways: Ways = field(default_factory=lambda: WAYS)
    statistic: Statistic = "minimum"
    tasks: Sequence[Task] = ()

    @property
    def tasks_in_unit(self) -> Sequence[Task]:
        """Those that the least speed is with: none whose costs are seconds, beside counts of operations."""
        return () if self.parts else self.tasks

    @property
    def second(self) -> Fraction | None:
        """Seconds in the unit of the tasks' costs, None if that is no time."""
        return Fraction(1) if self.parts else SECONDS.get(self.tables[0].unit)


class Accuracies:
    """The curves of a question, each computed once. whole: also of what is known to be out of the bound anyway."""

    def __init__(self, question: Question, *, whole: bool = False) -> None:
        self.question = question
        self.whole = whole
        self._curves: dict[tuple[object, ...], Curve] = {}

    def of(self, variant: Variant) -> Curve:
        """By landing. Raises ValueError where there is no regime."""
        asked, using = self.question, self.question.sampling.using(variant.every)
        method = METHODS[variant.method]
        if method.lossless:
            most = using.M + using.N + 1
            key: tuple[object, ...] = (using.between, variant.options.low_rate_noise)
            if key not in self._curves:
                noise = variant.options.low_rate_noise
                self._curves[key] = by_landing(
                    asked.model.linear, asked.outputs.rows, using.between, most, noise, asked.metric
                )
        else:
            key = (using.between, variant.method)
            if key not in self._curves:
                self._curves[key] = self._at_arrival(variant, using)
        return self._curves[key]

    def _at_arrival(self, variant: Variant, using: Sampling) -> Curve:
        """Of what is never better than a method that loses nothing, only that where it is out of the bound: the rest
        takes long."""
        asked = self.question
        if METHODS[variant.method].floored and not self.whole:
            lossless = self.of(variant._replace(method="recalculate")).at(using.M)
            if lossless > asked.within:
                return Curve(using.M, np.array([lossless]))
        return at_arrival(
            asked.model, asked.outputs, variant.method, using.between, using.M, asked.conditions, asked.metric
        )
