"""Analysis and simulation agree on every design of a grid, and on very many random ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from fractions import Fraction
from itertools import product
from random import Random

import pytest

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    AugmentationCosts,
    CarriedGainInFlightCosts,
    CloneCosts,
    CloneInFlightCosts,
    CloneSplitCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    FuseAsFreshCosts,
    JobCosts,
    LarsenCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    Px4PredictorCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
)
from sched_sim.design.timing import Timing
from tests.agreement import assert_agreement, legal_timings
from tests.exhaust import share_of

SHARES = [Fraction(2, 3), Fraction(1), Fraction(5, 4), Fraction(3)]

DUAL_RATE = [
    DualRateCosts(3, 4, 11, 6, 0, 4),  # the restart is the longest HR job, the HR update longer still
    DualRateCosts(60, 10, 5, 30, 0, 50),  # near those of Steffes 2014, Table 3
    DualRateCosts(2, 5, 1, 1, 0, 1),  # restart long, all else short: lands at once
    DualRateCosts(1, 1, 1, 1, 0, 1),  # everything ties
    DualRateCosts(1, 1, 9, 20, 0, 20),  # HR jobs hardly count
    DualRateCosts(40, 40, 30, 5, 0, 20),  # same-step feedback spills into the next step
    DualRateCosts(7, 2, 4, 3, 6, 1),  # precomputed gains from here on
    DualRateCosts(3, 4, 11, 6, 5, 4),
]
SERIAL = [
    StandardCosts(3, 2),
    RecalculateCosts(2, 3, 2),
    LarsenCosts(3, 4, 5),
    LarsenCosts(9, 1, 2),  # an ordinary step is the longest
    LarsenCosts(9, 4, 5),  # one that ties
    LarsenCosts(4, 9, 1),
    CloneCosts(3, 4, 2, 1),  # the start is the longest
    CloneCosts(3, 1, 2, 4),  # the update
    CloneCosts(3, 1, 5, 2),  # what is carried
    CloneInFlightCosts(3, 4, 2, 4, 3, 1),
    CloneInFlightCosts(3, 1, 5, 2, 7, 7),
    CloneSplitCosts(3, 2, 2, 3),
    CarriedGainInFlightCosts(3, 4, 2, 1, 1, 1),
    CarriedGainInFlightCosts(3, 1, 5, 2, 7, 7),
    Px4PredictorCosts(2, 7, 5, 3, 1),
    AugmentationCosts(7, 3, 3, 4, 2),
    AugmentationCosts(7, 0, 3, 0, 0),
    FuseAsFreshCosts(3, 2),
]
HORIZON = [
    DelayedHorizonCosts(2, 14, 2, 28),  # near 9 states, 3 measurements
    DelayedHorizonCosts(2, 60, 2, 3),  # the update is all
    DelayedHorizonCosts(1, 3, 9, 1),  # so is the replay
    DelayedHorizonCosts(1, 1, 1, 1),
    DelayedHorizonCosts(30, 1, 2, 2),  # HR jobs are the longest, on two processors
]
TWO_RATE = [MultirateCosts(3, 7), RobustCosts(5, 1), MultirateCosts(1, 1), RobustCosts(2, 40)]
WITHOUT_WORK = [
    DualRateCosts(1, 1, 0, 0, 0, 2),  # a loop and a long LR job
    DualRateCosts(1, 1, 0, 0, 0, 0),  # LR jobs take no time, and come when the next step begins
    DualRateCosts(2, 3, 1, 3, 3, 0),  # corrects at once what was computed before
    DualRateCosts(0, 2, 3, 1, 0, 0),
    MultirateCosts(2, 0),
    DelayedHorizonCosts(2, 0, 0, 0),
    DelayedHorizonCosts(2, 0, 2, 0),
    DelayedHorizonCosts(0, 1, 0, 0),
    LarsenCosts(2, 0, 0),  # the HR job of step m
    CloneCosts(0, 1, 0, 0),
    LarsenInFlightCosts(1, 0, 0, 1, 0, 0),
]


def every_option(costs: JobCosts) -> list[Options]:
    """All that make a difference to such costs."""
    if isinstance(costs, DualRateCosts):
        gain = "precomputed" if costs.lr_gain else "at-update"
        return [
            Options(feedback=feedback, lr_propagate_by=by, gain=gain, cpus=cpus)
            for feedback, by, cpus in product(("next-step", "same-step"), ("m", "l"), (1, 2))
        ]
    return (
        [Options(), Options(cpus=2)]
        if isinstance(costs, MultirateCosts | RobustCosts | DelayedHorizonCosts)
        else [Options()]
    )


def all_timings(costs: JobCosts, N: int, options: Options) -> list[Timing]:
    if isinstance(costs, MultirateCosts | RobustCosts):
        return [Timing(N, 0, L) for L in range(1, N + 1)]
    return legal_timings(costs, N, options)


COSTS = [*DUAL_RATE, *SERIAL, *TWO_RATE, *HORIZON, *WITHOUT_WORK]


@pytest.mark.parametrize(
    "costs",
    [pytest.param(costs, marks=pytest.mark.exhaust if at % 2 else ()) for at, costs in enumerate(COSTS)],
    ids=str,
)
def test_they_agree_on_every_design_of_up_to_five_steps(costs: JobCosts) -> None:
    for options in every_option(costs):
        timings = [timing for N in range(1, 6) for timing in all_timings(costs, N, options)]
        assert_agreement(costs, options, timings, SHARES)


# ------------------------------------------------------------------------------------------------------- exhaust


BATCH = 50


def random_costs(random: Random) -> JobCosts:
    """In ticks: small ones, which tie, and larger ones; sometimes of some pieces none, but of each HR job a part."""
    kinds = [DualRateCosts] * 5 + [
        StandardCosts,
        RecalculateCosts,
        LarsenInFlightCosts,
        CloneInFlightCosts,
        CarriedGainInFlightCosts,
    ]
    kinds += [MultirateCosts, RobustCosts]
    kinds += [DelayedHorizonCosts] * 3 + [Px4PredictorCosts, AugmentationCosts, FuseAsFreshCosts]
    kind, most = random.choice(kinds), random.choice([2, 5, 12, 100, 1000])
    least = random.choice([0, 1, 1])
    pieces = [random.randint(least, random.choice([2, most])) for _ in fields(kind)]
    pieces[0] = max(pieces[0], 1)
    if kind is DualRateCosts and random.random() < 0.7:
        pieces[4] = 0  # no precomputed gain
    if kind is DualRateCosts:
        pieces[1] = max(pieces[1], 1)
    return kind(*pieces)


@pytest.mark.exhaust
@pytest.mark.parametrize("seed", range(100))
def test_they_agree_on_a_million_random_designs(seed: int, record_property: Callable[[str, object], None]) -> None:
    random = Random(seed)
    batches = -(-share_of(10_000) // BATCH)
    for _ in range(batches):
        costs = random_costs(random)
        options = random.choice(every_option(costs))
        longest = random.choice([6, 12, 12, 30])
        timings = [random.choice(all_timings(costs, random.randint(1, longest), options)) for _ in range(BATCH)]
        share = Fraction(random.randint(1, 60), random.randint(15, 30))
        assert_agreement(costs, options, timings, [share])
    record_property("designs", batches * BATCH)


@pytest.mark.exhaust
@pytest.mark.parametrize("costs", COSTS, ids=str)
@pytest.mark.parametrize("N", [6, 7, 8])
def test_they_agree_on_every_design_of_six_to_eight_steps(costs: JobCosts, N: int) -> None:
    for options in every_option(costs):
        assert_agreement(costs, options, all_timings(costs, N, options), [*SHARES, Fraction(9, 10), Fraction(11, 10)])
