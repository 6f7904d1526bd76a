"""Costs rounded to bins bound what exact ticks say."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.design.options import Options
from sched_sim.design.pieces import CarriedGainCosts, CloneCosts, DualRateCosts, LarsenCosts, RecalculateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.probability.outcome import Bounds, CycleProbabilities, Floats
from sched_sim.schedule.tasks import Task

T, BINS = 60, 12
ROUNDING = 1e-12


def costs_up_to(most: int) -> st.SearchStrategy[CostDistribution]:
    values = st.lists(st.integers(0, most), min_size=1, max_size=3)
    return values.map(lambda several: CostDistribution.of_samples([Fraction(value) for value in several]))


@st.composite
def dual_rate(draw: st.DrawFn) -> tuple[Any, Timing, Options]:
    high, low = costs_up_to(45), costs_up_to(60)
    costs = DualRateCosts(
        draw(high), draw(high), draw(costs_up_to(20)), draw(low), CostDistribution.certain(0), draw(low)
    )
    same_step = draw(st.booleans())
    N, M = draw(st.integers(1, 4)), draw(st.integers(0, 4))
    options = Options(feedback="same-step" if same_step else "next-step", cpus=1 if same_step else draw(CPUS))
    return costs, Timing(N, M, M + draw(st.integers(0 if same_step else 1, 3))), options


CPUS: st.SearchStrategy[Any] = st.sampled_from([1, 1, 1, 2])


@st.composite
def serial(draw: st.DrawFn) -> tuple[Any, Timing, Options]:
    kind = draw(st.sampled_from([RecalculateCosts, LarsenCosts, CloneCosts, CarriedGainCosts]))
    pieces = [draw(costs_up_to(35)) for _ in range(3 if kind in (RecalculateCosts, LarsenCosts) else 4)]
    N = draw(st.integers(1, 4))
    M = draw(st.integers(0, N))
    return kind(*pieces), Timing(N, M, M), Options()


@given(dual_rate() | serial())
def test_bins_bound_the_exact(design: tuple[Any, Timing, Options]) -> None:
    costs, timing, options = design
    exact = probabilities(costs, timing, T, 4, options, debt=2)
    rounded = probabilities(shifted(costs), timing, T, 4, options, bins=BINS, debt=2)
    assert exact.exact
    assert rounded.ticks == BINS
    pairs = list(zip(exact.cycles, rounded.cycles, strict=True))
    if exact.long_run is not None and rounded.long_run is not None:
        assert not exact.why_no_long_run + rounded.why_no_long_run
    for inner, outer in pairs:
        for kind, bounds in inner.misses.items():
            holds(outer.misses[kind], bounds)
        holds(outer.late, inner.late)
        for landed in inner.landing.keys() | outer.landing.keys():
            holds(outer.landing.get(landed, Bounds(0, 0)), inner.landing.get(landed, Bounds(0, 0)))
        tails_hold(outer, inner)


def shifted(costs: Any) -> Any:
    """The same, with nothing a whole number of bins that is not 0: no exact ticks."""
    return replace(costs)


def holds(outer: Bounds, inner: Bounds) -> None:
    """The true probability is between the inner ones; the outer ones hold one that they hold."""
    assert outer.lower <= inner.upper + ROUNDING
    assert inner.lower <= outer.upper + ROUNDING


def tails_hold(outer: CycleProbabilities, inner: CycleProbabilities) -> None:
    """At each bin."""
    for kind in inner.responses:
        exact = inner.responses[kind]
        for number in range(4 * BINS):
            ticks = number * T // BINS
            assert at(outer.responses[kind].lower, number) <= at(exact.upper, ticks) + ROUNDING
            assert at(exact.lower, ticks) <= at(outer.responses[kind].upper, number) + ROUNDING


def at(tail: Floats, number: int) -> float:
    return float(tail[min(number, len(tail) - 1)])


def test_with_tasks() -> None:
    of_task = CostDistribution.of_samples([7, 11, 26])
    task = Task("t", period=Fraction(3, 2), cost=Fraction(7), priority=5, offset=Fraction(1, 2))
    costs = DualRateCosts(
        CostDistribution.of_samples([13, 17, 41]),
        CostDistribution.certain(11),
        CostDistribution.of_samples([3, 9]),
        CostDistribution.certain(13),
        CostDistribution.certain(0),
        CostDistribution.of_samples([17, 31, 52]),
    )
    both = [
        probabilities(costs, Timing(4, 1, 3), T, 3, tasks=[task], task_costs={"t": of_task}, bins=bins)
        for bins in (None, 20)
    ]
    for inner, outer in zip(*(found.cycles for found in both), strict=True):
        for kind, bounds in inner.misses.items():
            holds(outer.misses[kind], bounds)
        assert np.diff([bounds.lower for bounds in (inner.late, outer.late)]) <= ROUNDING
