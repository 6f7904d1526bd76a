"""How accurate each method is by where its corrections land; each curve is computed once, for all that it is of."""

from __future__ import annotations

from functools import lru_cache
from math import ceil, isfinite
from typing import NamedTuple

import numpy as np

from filters.accuracy.pattern import Interval
from filters.accuracy.predictor import predictor_multiplications
from filters.delayed.low_rate_noise import LowRateNoise
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.errors import option
from studies.explorer.same import Same, contents, itself
from studies.selection.compare import Metric
from studies.selection.conditions import Conditions, check_ages
from studies.selection.curve import Curve, at_arrival, by_landing
from studies.selection.landing import earliest
from studies.selection.methods import METHODS
from studies.selection.model import Model
from studies.selection.outputs import Outputs
from studies.selection.question import Question
from studies.selection.waiting import too_irregular, too_late

KEPT = 64
"""Curves, at most."""

MOST = 1e8
"""Multiplications of a long sum: some tenths of a second."""


class Accuracy(NamedTuple):
    """curve: standard deviations of the output by landing, from the first landing that the method can have; None where
    there is none, and the reason. only: it has no other, whatever L is asked for."""

    curve: Curve | None
    reason: str = ""
    only: bool = False

    def at(self, L: int | None) -> float | None:
        """None where it is not known, or grows without bound."""
        if self.curve is None or L is None:
            return None
        at = 0 if self.only else L - self.curve.first
        figures = self.curve.figures
        return float(figures[at]) if 0 <= at < len(figures) and isfinite(figures[at]) else None


def accuracy(question: Question, method: str, *, whole: bool = False, last: int = 0) -> Accuracy:
    """Up to the last landing of use, or to `last` where that is later.

    whole: of px4-predictor too, a long sum.
    """
    sampling, options = question.sampling, question.options
    if reason := _why_none(question, method, whole):
        return Accuracy(None, reason)
    first = earliest(method, sampling.M, options)
    delay = 0 if METHODS[method].landing == "at once" else sampling.M
    only = METHODS[method].landing != "later"
    until = first if only else max(SCHEDULED[method].law(options.feedback).last_of_use(sampling.N, delay), last)
    try:
        curve = curve_of(question, method, whole=whole, last=last)
    except ValueError as error:
        return Accuracy(None, str(error))
    return Accuracy(Curve(first, curve.figures[first - curve.first : until + 1 - curve.first]), only=only)


def curve_of(question: Question, method: str, *, whole: bool = False, last: int = 0) -> Curve:
    """As `studies.selection.question.Accuracies` has it. Raises ValueError where there is no regime."""
    sampling = question.sampling
    most = max(sampling.M + sampling.N + 1, last)
    check_ages(question.model, ceil(sampling.between) + most)
    if METHODS[method].lossless:
        noise: LowRateNoise = question.options.low_rate_noise if method == "dual-rate" else "exact"
        model, outputs, _ = _known(itself(question))
        return _by_landing(model, outputs, sampling.between, most, noise, question.metric)
    if METHODS[method].floored and not whole:
        lossless = curve_of(question, "recalculate").at(sampling.M)
        if lossless > question.within:
            return Curve(sampling.M, np.array([lossless]))
    if METHODS[method].floored:
        _check_effort(question, method)
    model, outputs, conditions = _known(itself(question))
    return _at_arrival(model, outputs, method, sampling.between, sampling.M, conditions, question.metric)


def _check_effort(question: Question, method: str) -> None:
    """Raises ValueError for a sum of more multiplications than MOST."""
    sampling, pull, (model, outputs, _) = question.sampling, question.conditions.pull, _known(itself(question))
    if pull is not None and _multiplications(model, outputs, sampling.between, sampling.M, pull) > MOST:
        raise ValueError(f"its accuracy is a sum over too many steps: `sched-sim accuracy --method {method}` takes it")


def lacks(question: Question, method: str) -> str:
    """What is not known of what the accuracy of a method depends on; empty if nothing."""
    if method not in METHODS:
        return f"{method} has no accuracy here"
    if METHODS[method].needs == "motion" and question.conditions.displacement is None:
        return (
            "its error is how far the measured quantities move during the delay, which is not known here: "
            "`sched-sim accuracy --motion` takes it"
        )
    if METHODS[method].needs == "hr_hz" and question.conditions.pull is None:
        return f"its time constant is in seconds: give {option('hr_hz')}, the rate of the HR loop"
    return ""


def _why_none(question: Question, method: str, whole: bool) -> str:
    known = lacks(question, method) or too_late(method, question.sampling, 1, question.options)
    if reason := known or too_irregular(method, question.sampling, question.options):
        return reason
    return _why_not_whole(question) if METHODS[method].floored and not whole else ""


def _why_not_whole(question: Question) -> str:
    """Of a long sum that is only known to be more than a figure."""
    try:
        lossless = curve_of(question, "recalculate").at(question.sampling.M)
    except ValueError as error:
        return str(error)
    unit = f" {question.outputs.unit}" if question.outputs.unit else ""
    return f"more than {lossless:.4g}{unit}: choose it to see how much"


class _Known(NamedTuple):
    """What of a question no hash is of, known by what is in it."""

    model: Same[Model]
    outputs: Same[Outputs]
    conditions: Same[Conditions]


@lru_cache(maxsize=2)
def _known(same: Same[Question]) -> _Known:
    question = same.value
    return _Known(
        Same(question.model, contents(question.model.linear)),
        Same(question.outputs, contents(question.outputs.rows)),
        Same(question.conditions, contents(question.conditions)),
    )


@lru_cache(maxsize=KEPT)
def _by_landing(
    model: Same[Model], outputs: Same[Outputs], between: Interval, most: int, noise: LowRateNoise, metric: Metric
) -> Curve:
    return by_landing(model.value.linear, outputs.value.rows, between, most, noise, metric)


@lru_cache(maxsize=KEPT)
def _multiplications(model: Same[Model], outputs: Same[Outputs], between: Interval, M: int, pull: float) -> float:
    return predictor_multiplications(model.value.linear, outputs.value.rows, between, M, pull)


@lru_cache(maxsize=KEPT)
def _at_arrival(
    model: Same[Model],
    outputs: Same[Outputs],
    method: str,
    between: Interval,
    M: int,
    conditions: Same[Conditions],
    metric: Metric,
) -> Curve:
    return at_arrival(model.value, outputs.value, method, between, M, conditions.value, metric)
