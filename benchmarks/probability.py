"""Exact probability: one measurement cycle of ten steps, of costs of a thousand samples each, and a whole answer."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any, cast

import numpy as np

from benchmarks.timing import Result, seconds
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.probability.in_ticks import Given, grid_of, pieces_of
from sched_sim.probability.model import Model
from sched_sim.probability.tally import Tallies

TIMING = Timing(N=10, M=4, L=8)
MEANS = {"hr": 0.3, "hr_restart": 0.25, "hr_update": 0.05, "lr_propagate": 0.9, "lr_update": 1.4}
SAMPLES = 1000
SETTLED_AFTER = 20
"""Cycles."""


def results() -> Iterator[Result]:
    for ticks, target in ((592, 1000.0), (148, 30.0)):
        yield Result(
            f"probability: a cycle of dual-rate, {ticks} ticks a period",
            1000 * _cycle(ticks),
            target,
            higher=False,
            unit="ms",
        )
    costs = _costs(None)
    yield Result(
        "probability: dual-rate, 1,000 cycles and the long run, 512 bins",
        seconds(lambda: probabilities(costs, TIMING, 1), repeats=1),
        10,
        higher=False,
        unit="s",
    )


def _costs(ticks: int | None) -> DualRateCosts[Any]:
    """In HR periods; whole ticks, or as they were drawn."""
    random = np.random.default_rng(0)
    pieces = {"lr_gain": CostDistribution.certain(0)}
    for name, mean in MEANS.items():
        drawn = mean * np.exp(0.25 * random.standard_normal(SAMPLES))
        pieces[name] = CostDistribution.of_samples(
            [Fraction(round(value * ticks), ticks) if ticks else value for value in drawn.tolist()]
        )
    return DualRateCosts(**cast("dict[str, Any]", pieces))


def _cycle(ticks: int) -> float:
    """Once the law of what is left to do has settled."""
    costs = _costs(ticks)
    given = Given(pieces_of(costs), (), {}, Fraction(1))
    (process,), _ = Model(costs, TIMING, Options(), given, grid_of(given, TIMING.N, None), "down", None, 4).processes()
    process.advance(SETTLED_AFTER * TIMING.N, Tallies())
    return seconds(lambda: process.advance(process.step + TIMING.N, Tallies()))
