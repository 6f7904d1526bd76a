"""Sampled runs of the simulation give what the exact probability says, within what so many cycles leave open."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from math import sqrt
from typing import Any

import numpy as np
import pytest

from sched_sim.design.options import Options
from sched_sim.design.pieces import CarriedGainCosts, DualRateCosts, LarsenCosts, RecalculateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.schedule.tasks import Task
from tests.drawn_costs import pieces, simulated
from tests.exhaust import share_of

T = 100
TASK = Task("t", period=Fraction(3, 2), cost=Fraction(8), priority=5, offset=Fraction(1, 2))
BLOCKS = 50
"""Misses come in a row: the spread of the mean is that of the means of so many blocks."""


def spread(mean: int, seed: int) -> CostDistribution:
    drawn = np.random.default_rng(seed).gamma(6.0, mean / 6.0, size=200)
    return CostDistribution.of_samples([Fraction(round(value)) for value in drawn])


DESIGNS: dict[str, tuple[Any, Timing, Options, tuple[Task, ...]]] = {
    "dual-rate": (
        DualRateCosts(
            spread(40, 1), spread(35, 2), spread(9, 3), spread(60, 4), CostDistribution.certain(0), spread(75, 5)
        ),
        Timing(5, 2, 4),
        Options(),
        (),
    ),
    "dual-rate with a task": (
        DualRateCosts(
            spread(35, 1), spread(35, 2), spread(9, 3), spread(50, 4), CostDistribution.certain(0), spread(55, 5)
        ),
        Timing(6, 2, 5),
        Options(),
        (TASK,),
    ),
    "same-step": (
        DualRateCosts(
            spread(40, 1), spread(35, 2), spread(9, 3), spread(60, 4), CostDistribution.certain(0), spread(75, 5)
        ),
        Timing(5, 2, 4),
        Options(feedback="same-step"),
        (),
    ),
    "recalculate": (RecalculateCosts(spread(50, 1), spread(30, 2), spread(20, 3)), Timing(5, 3, 3), Options(), (TASK,)),
    "larsen": (LarsenCosts(spread(50, 1), spread(70, 2), spread(40, 3)), Timing(5, 3, 3), Options(), ()),
    "carried-gain": (
        CarriedGainCosts(spread(50, 1), spread(40, 2), spread(20, 3), spread(40, 4)),
        Timing(5, 3, 3),
        Options(),
        (),
    ),
}


def sampled_is_exact(name: str, cycles: int, seed: int) -> None:
    costs, timing, options, tasks = DESIGNS[name]
    of_tasks = {task.name: spread(8, 9) for task in tasks}
    found = probabilities(costs, timing, T, 1, options, tasks, task_costs=of_tasks)
    assert found.exact
    assert found.long_run is not None
    generator = np.random.default_rng(seed)
    drawn = {
        name: iter(
            generator.choice([int(v) for v in law.values], p=law.probabilities, size=9 * timing.N * cycles).tolist()
        )
        for name, law in (pieces(costs) | of_tasks).items()
    }
    steps = timing.N * (cycles + 10)
    seen = simulated(costs, timing, T, steps, lambda name: next(drawn[name]), options, tasks)
    missed = [seen.missed("hr", step) for step in range(timing.N * cycles)]
    is_near(found.long_run.hr_miss.lower, np.array(missed, dtype=float))
    for task in tasks:
        kind = f"task:{task.name}"
        late = [seen.missed(kind, number) for number in range(int(timing.N * cycles / task.period))]
        is_near(found.long_run.misses[kind].lower, np.array(late, dtype=float))
    landed = np.array([seen.landed.get(cycle, -1) for cycle in range(cycles)])
    for lands, (lower, _) in found.long_run.landing.items():
        is_near(lower, landed == lands)
    due = timing.L if isinstance(costs, DualRateCosts) else timing.M
    is_near(found.long_run.late.lower, landed > due)
    responses, tail = Counter(seen.responses("hr")), found.long_run.responses["hr"].lower
    for ticks in (30, 60, 90):
        share = sum(count for response, count in responses.items() if response > ticks) / responses.total()
        assert share == pytest.approx(tail[ticks], abs=8 / sqrt(responses.total()))


def is_near(probability: float, events: Any) -> None:
    """Within five standard deviations of the mean, and some events."""
    usable = len(events) // BLOCKS * BLOCKS
    means = events[:usable].reshape(BLOCKS, -1).mean(axis=1)
    deviation = max(float(means.std()) / sqrt(BLOCKS), sqrt(probability / usable))
    assert abs(float(means.mean()) - probability) < 5 * deviation + 5 / usable


@pytest.mark.parametrize("name", ["dual-rate with a task", "recalculate", "larsen"])
def test_two_thousand_cycles(name: str) -> None:
    sampled_is_exact(name, 2_000, seed=7)


@pytest.mark.exhaust
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("name", DESIGNS)
def test_a_million_cycles(name: str, seed: int, record_property: Callable[[str, object], None]) -> None:
    cycles = share_of(100_000)
    sampled_is_exact(name, cycles, seed)
    record_property("cycles", cycles)
