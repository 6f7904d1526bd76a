"""Landing later against using fewer measurements: the two ways to get along with a slow processor."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt
from typing import NamedTuple

import numpy as np

from filters.accuracy import Accuracy, latest_landing, lossless, lossless_each
from filters.accuracy.periodic import steady
from filters.arrays import FloatArray
from studies.accuracy.given import Given

EVERY = (1, 2, 3, 4)
"""Every n-th measurement is used."""
SEARCHED = 100
"""Intervals of measurements: so late a landing is looked at."""


class Curve(NamedTuple):
    """worst: the standard deviation in the worst step of a cycle, for each landing L of `landings`."""

    landings: range
    worst: FloatArray


class Landing(NamedTuple):
    """One model. at_arrival, at_next: landing at L = M and at L = N. skipping: by n, every n-th measurement is used,
    landing at M.

    rule: sqrt(tr P^- / tr P^+) - 1 of the output at a measurement, what one correction takes away. as_late: the last L
    at which every measurement, late, is still better than every second one at once; None if beyond `SEARCHED` N.
    curves: by n, L from M on.
    """

    given: Given
    at_arrival: Accuracy
    at_next: Accuracy
    skipping: Mapping[int, Accuracy]
    rule: float
    as_late: int | None
    curves: Mapping[int, Curve]

    @property
    def no_delay(self) -> float:
        return self.at_arrival.no_delay

    @property
    def waiting(self) -> float:
        """By how much the worst grows if corrections land at the next measurement instead of on arrival; 0.1: 10 %."""
        return self.at_next.worst / self.at_arrival.worst - 1.0

    def leaving_out(self, n: int) -> float:
        """By how much the worst grows if every n-th measurement is used instead of each; both land on arrival."""
        return self.skipping[n].worst / self.at_arrival.worst - 1.0


def landing(of: Given) -> Landing:
    at_arrival, at_next = lossless_each(of.model, of.states, of.N, [of.M, of.N])
    skipping = {n: lossless(of.model, of.states, n * of.N, of.M) for n in EVERY}
    latest = latest_landing(of.model, of.states, of.N, skipping[2].worst, of.M, most=SEARCHED * of.N)
    return Landing(
        of,
        at_arrival,
        at_next,
        skipping,
        _rule(of),
        latest.L if latest.bounded else None,
        {n: _curve(of, n) for n in EVERY},
    )


def _rule(of: Given) -> float:
    regime = steady(of.model, np.eye(of.model.states)[of.states], [of.N], 0)
    before, after = (sum(P[0, i, i] for i in of.states) for P in (regime.before, regime.after))
    return sqrt(before / after) - 1.0


def _curve(of: Given, n: int) -> Curve:
    """To the end of the interval of the measurements in use, at least 2 N."""
    landings = range(of.M, max(n, 2) * of.N + 1)
    every = lossless_each(of.model, of.states, n * of.N, landings)
    return Curve(landings, np.array([accuracy.worst for accuracy in every]))
