"""Figures that were computed by other code than this."""

from fractions import Fraction
from typing import Any

import pytest

from sched_sim.design.pieces import DualRateCosts, RecalculateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.schedule.tasks import Task

certain = CostDistribution.certain


def rarely(usual: int, seldom: int, probability: float) -> CostDistribution:
    return CostDistribution.of_weights([(Fraction(usual), 1 - probability), (Fraction(seldom), probability)])


def test_one_late_execution_in_a_million() -> None:
    costs = DualRateCosts(certain(63), certain(4), certain(3), certain(41), certain(0), rarely(56, 61, 1e-6))
    found = probabilities(costs, Timing(N=10, M=4, L=8), 78, cycles=3)
    assert found.exact
    assert found.ticks == 78
    for cycle in (*found.cycles, found.long_run):
        assert cycle is not None
        assert {landed: share for landed, (share, _) in cycle.landing.items()} == pytest.approx({8: 0.999999, 9: 1e-6})
        assert cycle.late == pytest.approx((1e-6, 1e-6))
        assert cycle.hr_miss == (0, 0)


def test_one_late_execution_makes_every_later_cycle_late() -> None:
    """In the n-th cycle with probability 1 - (1 - p)^n, in the long run always."""
    costs = DualRateCosts(certain(10), certain(10), certain(1), certain(4), certain(0), rarely(16, 17, 1e-9))
    found = probabilities(costs, Timing(N=2, M=0, L=1), 30, cycles=300)
    for number in (1, 2, 17, 300):
        late = number * 1e-9 - number * (number - 1) / 2 * 1e-18
        assert found.cycles[number - 1].landing[2] == pytest.approx((late, late), rel=1e-12)
    assert found.long_run is not None
    assert found.long_run.landing == {2: pytest.approx((1, 1))}
    assert found.long_run.late == pytest.approx((1, 1))


def test_an_hr_job_that_overruns_delays_the_correction() -> None:
    hr = rarely(10, 31, 1e-3)
    costs = DualRateCosts(hr, hr, certain(1), certain(1), certain(0), certain(1))
    found = probabilities(costs, Timing(N=4, M=0, L=1), 30, cycles=2)
    for cycle in (*found.cycles, found.long_run):
        assert cycle is not None
        assert cycle.hr_miss == pytest.approx((1e-3, 1e-3), rel=1e-12)
        for landed in range(1, 8):
            share = 0.999 * 1e-3 ** (landed - 1)
            assert cycle.landing[landed] == pytest.approx((share, share), rel=1e-12)


def test_it_is_late_as_often_as_it_becomes_so_and_is_not_any_more() -> None:
    """On time it becomes late with probability a, late it catches up with b: it is late a / (a + b) of the time."""
    a, b = 1e-9, 1e-3
    update = CostDistribution.of_weights([(Fraction(15), b), (Fraction(16), 1 - a - b), (Fraction(17), a)])
    costs = DualRateCosts(certain(10), certain(10), certain(1), certain(4), certain(0), update)
    found = probabilities(costs, Timing(N=2, M=0, L=1), 30, cycles=1)
    assert found.long_run is not None
    assert found.long_run.late == pytest.approx((a / (a + b), a / (a + b)), rel=1e-9)


ACROSS = Task("across", period=Fraction(1), cost=Fraction(4), priority=5, offset=Fraction(9, 10))
"""Under way at the start of each step: there is always work left."""


@pytest.mark.parametrize(
    ("costs", "timing", "tasks"),
    [
        (RecalculateCosts(rarely(20, 41, 0.1), certain(5), rarely(3, 9, 0.3)), Timing(N=3, M=2, L=2), ()),
        (
            DualRateCosts(rarely(10, 31, 0.05), *map(certain, (10, 1, 4, 0)), rarely(16, 21, 0.05)),
            Timing(N=4, M=1, L=2),
            (),
        ),
        (RecalculateCosts(rarely(15, 26, 0.1), certain(5), certain(3)), Timing(N=3, M=2, L=2), (ACROSS,)),
    ],
)
def test_the_long_run_is_the_cycle_after_very_many(costs: Any, timing: Timing, tasks: tuple[Task, ...]) -> None:
    found = probabilities(costs, timing, 30, cycles=300, tasks=tasks, debt=8)
    last, settled = found.cycles[-1], found.long_run
    assert settled is not None
    assert settled.late == pytest.approx(last.late, rel=1e-9)
    assert settled.hr_miss == pytest.approx(last.hr_miss, rel=1e-9)
    assert {landed: share.lower for landed, share in settled.landing.items()} == pytest.approx(
        {landed: last.landing[landed].lower for landed in settled.landing}, rel=1e-7, abs=1e-25
    )


@pytest.mark.parametrize(("update", "misses"), [(20, 0), (21, 1), (22, 1), (52, 0), (54, 0)])
def test_shorter_work_can_cause_misses(update: int, misses: int) -> None:
    """The correction lands in the step in which the task is released."""
    task = Task("t", period=Fraction(4), cost=Fraction(25), priority=5, offset=Fraction(2))
    costs = DualRateCosts(*map(certain, (50, 50, 20, 10, 0, update)))
    found = probabilities(costs, Timing(N=4, M=0, L=4), 80, cycles=5, tasks=[task])
    assert [cycle.hr_miss for cycle in found.cycles] == [(misses / 4, misses / 4)] * 5
    bounds = probabilities(costs, Timing(N=4, M=0, L=4), 80, cycles=5, tasks=[task], bins=10).cycles[4].hr_miss
    assert bounds.lower <= misses / 4 <= bounds.upper
