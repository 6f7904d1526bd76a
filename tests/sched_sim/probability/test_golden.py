"""Figures that were computed by other code than this."""

import pytest

from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities

certain = CostDistribution.certain


def rarely(usual: int, seldom: int, probability: float) -> CostDistribution:
    return CostDistribution.of_weights([(usual, 1 - probability), (seldom, probability)])


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
