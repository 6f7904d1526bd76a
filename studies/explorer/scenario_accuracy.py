"""The accuracy of a scenario's output, along its run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from filters.accuracy.trace import Spread
from studies.explorer.scenario_jobs import BINS, Floats, Histogram
from studies.selection.in_scenario import ScenarioAccuracy

CONSTANT = 1e-4
"""Relative: what differs by less is one bar."""


@dataclass(frozen=True, slots=True)
class SpreadView:
    """Over the steps that the figures are of; histogram: of those steps."""

    name: str
    unit: str
    median: float
    p95: float
    worst: float
    histogram: Histogram


@dataclass(frozen=True, slots=True)
class AccuracyView:
    """output: the standard deviation; ages: of each sensor's information in it, None if nothing of it has landed.
    first, last: the steps that the figures are of."""

    model: str
    output: SpreadView
    ages: Mapping[str, SpreadView | None]
    first: int
    last: int
    remarks: Sequence[str]
    sentence: str


def accuracy_view(found: ScenarioAccuracy) -> AccuracyView:
    outputs = found.question.outputs
    output = _spread(outputs.name, outputs.unit, found.spread, found.counted)
    return AccuracyView(
        model=found.question.model.name,
        output=output,
        ages={name: _age(found, name) for name in found.ages},
        first=found.first,
        last=found.last,
        remarks=found.remarks,
        sentence=(
            f"{outputs.name}: standard deviation {output.median:.4g} {output.unit}".rstrip()
            + f" in the median, within {output.p95:.4g} in 95 % of the steps, {output.worst:.4g} at worst"
        ),
    )


def _age(found: ScenarioAccuracy, sensor: str) -> SpreadView | None:
    ages, spread = found.ages[sensor], found.age(sensor)
    if ages is None or spread is None:
        return None
    return _spread(sensor, found.age_unit, spread, ages * found.age_scale)


def _spread(name: str, unit: str, spread: Spread, values: Floats) -> SpreadView:
    low, high = float(values.min()), float(values.max())
    same = high - low <= CONSTANT * abs(high)
    around = (0.99 * high, 1.01 * high) if high else (0.0, 1.0)
    counts, edges = np.histogram(values, bins=1 if same else BINS, range=around if same else (low, high))
    histogram = Histogram(edges.tolist(), counts.tolist())
    return SpreadView(name, unit, spread.median, spread.p95, spread.worst, histogram)
