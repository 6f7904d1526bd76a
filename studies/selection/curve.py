"""The figure of the output by where corrections land, for every L at once; and the latest L that keeps a bound."""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

import numpy as np

from filters.accuracy.assumed_regime import assumed_regime
from filters.accuracy.gains import halved_noise, summed_noise
from filters.accuracy.model import LinearModel
from filters.accuracy.pattern import Interval
from filters.accuracy.regime import mean_of, regime, worst_of
from filters.arrays import FloatArray
from filters.delayed.low_rate_noise import LowRateNoise
from studies.selection.compare import Metric, figure
from studies.selection.conditions import Conditions
from studies.selection.methods import METHODS, Asked
from studies.selection.model import Model
from studies.selection.outputs import Outputs


class Curve(NamedTuple):
    """figures: by L, from `first` on; standard deviations, infinite where the filter is unstable."""

    first: int
    figures: FloatArray

    def at(self, L: int) -> float:
        return float(self.figures[L - self.first])

    def latest(self, within: float) -> int | None:
        """The largest L such that it and all before it are within; None if the first is not."""
        over = np.flatnonzero(self.figures > within)
        kept = int(over[0]) if len(over) else len(self.figures)
        return self.first + kept - 1 if kept else None


def by_landing(
    model: LinearModel, rows: FloatArray, N: Interval, most: int, noise: LowRateNoise, metric: Metric
) -> Curve:
    """Of a method that is as good as the age of its measurements, but for the noise over N steps: L = 0 .. most.

    Raises ValueError where there is no regime.
    """
    oldest = ceil(N) + most
    if noise == "exact":
        found = regime(model, rows, N, oldest)
    else:
        found, _, radius = assumed_regime(model, rows, N, oldest, summed_noise if noise == "sum" else halved_noise)
        if not radius < 1.0:
            return Curve(0, np.full(most + 1, np.inf))
    figure_of = worst_of if metric == "worst" else mean_of
    return Curve(0, np.sqrt(np.maximum(figure_of(found, np.arange(most + 1)), 0.0)))


def at_arrival(
    model: Model, outputs: Outputs, method: str, N: Interval, M: int, conditions: Conditions, metric: Metric
) -> Curve:
    """Of a method that lands with its measurement's arrival, and is not as good as its age. Raises ValueError where
    there is no regime."""
    asked = Asked(model.linear, outputs.rows, N, M, M, displacement=conditions.displacement, pull=conditions.pull)
    return Curve(M, np.array([figure(METHODS[method].accuracy(asked), metric)]))
