"""What a filter with late measurements is worth at the output: one record, whatever the method."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, sqrt
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from filters.accuracy.riccati import below_one
from filters.arrays import FloatArray

Verdict: TypeAlias = Literal["exact", "bound", "approximate", "unstable", "diverges"]


class Accuracy(NamedTuple):
    """The periodic regime. All of an output are standard deviations in its unit, of several rows together: the square
    root of the trace.

    N: steps between measurements; of a quotient the figures are those of all its intervals (`pattern`).
    L: steps from a measurement to the output in which it is first (the reaction time); None where none ever is.
    oldest, mean_age: steps since the newest measurement in an output was taken (the data age); its least is L.
    worst, rms: of the worst step of a cycle, and the root of the mean over its steps.
    no_delay: worst of the same model with the best gain and L = 0.
    jump: how far the output moves when a correction lands; where it moves in every step, the largest.
    believed: worst that the filter's own covariance says; None where that is the truth.
    bias: the largest norm of the mean error. total: the worst root of variance and squared bias.
    radius: spectral radius of the error from cycle to cycle where it may be unstable, else None.
    verdict: "exact": as good as the age of its measurements allows; "bound": that is no worse than the figures, for its
        intervals repeat too late to look at each; "approximate"; "unstable": the error grows because of the filter,
        "diverges": because nothing corrects it. In the last two the figures are infinite.
    """

    N: int | Fraction
    L: int | None
    oldest: int | None
    mean_age: float | None
    worst: float
    rms: float
    no_delay: float
    jump: float
    believed: float | None
    bias: float
    total: float
    radius: float | None
    verdict: Verdict

    @property
    def over_no_delay(self) -> float:
        """By how much the worst is above that without delay: 0.04 is 4 %."""
        return self.total / self.no_delay - 1.0 if self.no_delay > 0.0 else 0.0


def of_cycle(
    N: int | Fraction,
    L: int,
    variances: FloatArray,
    no_delay: float,
    jump: float,
    *,
    believed: float | None = None,
    means: FloatArray | None = None,
    radius: float | None = None,
    verdict: Verdict = "exact",
) -> Accuracy:
    """The record, from the variance of the output in each step (N,) of a cycle, or of all cycles that repeat.

    no_delay, jump, believed: variances too. means (as many, outputs): the mean error in each step.
    """
    if radius is not None and not below_one(radius):
        return _without_bound(N, L, no_delay, believed, radius, "unstable")
    squared = np.zeros(len(variances)) if means is None else np.square(means).sum(axis=-1)
    return Accuracy(
        N=N,
        L=L,
        oldest=ceil(N) + L - 1,
        mean_age=L + mean_wait(N),
        worst=_deviation(variances.max()),
        rms=_deviation(variances.mean()),
        no_delay=_deviation(no_delay),
        jump=_deviation(jump),
        believed=None if believed is None else _deviation(believed),
        bias=_deviation(squared.max()),
        total=_deviation((variances + squared).max()),
        radius=radius,
        verdict=verdict,
    )


def mean_wait(N: int | Fraction) -> float:
    """Steps since the last measurement, on average over all steps."""
    between = Fraction(N)
    short, longer = between // 1, between % 1  # so many of the intervals are a step longer
    return float(((1 - longer) * short * (short - 1) + longer * (short + 1) * short) / (2 * between))


def diverging(N: int | Fraction, no_delay: float, radius: float) -> Accuracy:
    """The record of a filter that nothing corrects. no_delay: a variance."""
    return _without_bound(N, None, no_delay, None, radius, "diverges")


def check_steps(name: str, value: int, least: int) -> None:
    """Raises ValueError, naming it, unless it is a whole number of steps and at least so many."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise ValueError(f"{name}={value!r} must be a whole number of steps, at least {least}")


def _without_bound(
    N: int | Fraction, L: int | None, no_delay: float, believed: float | None, radius: float, verdict: Verdict
) -> Accuracy:
    infinite = float("inf")
    return Accuracy(
        N=N,
        L=L,
        oldest=None if L is None else ceil(N) + L - 1,
        mean_age=None if L is None else L + mean_wait(N),
        worst=infinite,
        rms=infinite,
        no_delay=_deviation(no_delay),
        jump=infinite if L is not None else 0.0,
        believed=None if believed is None else _deviation(believed),
        bias=0.0,
        total=infinite,
        radius=radius,
        verdict=verdict,
    )


def _deviation(variance: float) -> float:
    return sqrt(max(float(variance), 0.0))
