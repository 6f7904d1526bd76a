"""The load in closed form is what the simulated processor does."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings

from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.load import utilization
from sched_sim.design.methods import method_of
from sched_sim.design.pieces import DelayedHorizonCosts, MultirateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from tests.designs import Design, designs


@settings(max_examples=60)
@given(designs)
def test_each_cycle_does_the_work_of_a_cycle(design: Design) -> None:
    costs, timing, options = design
    speed = least_speed(*design).speed

    def busy(cycles: int) -> Fraction:
        schedule = simulate(costs, timing, speed, cycles, options)
        return Fraction(schedule.busy) * speed / schedule.period

    work = sum(method_of(costs).work(costs, timing))
    if isinstance(costs, DelayedHorizonCosts):
        landed = achieved_l(costs, timing, speed, options)
        assert landed is not None
        work += (landed - timing.M - 1) * costs.replay
    assert busy(7) - busy(4) == 3 * work


@given(designs)
def test_at_the_least_speed_the_load_is_at_most_that_of_the_processors(design: Design) -> None:
    assert 0 < utilization(design.costs, design.timing, least_speed(*design).speed) <= design.options.cpus


def test_the_patents_loading_of_one_measurement_a_second_and_a_gain_every_five() -> None:
    """166,870 us / 5 s + 7,626 us / 1 s = 4.1 % (printed)."""
    costs = MultirateCosts(state_update=7626, covariance_gain=166870)
    assert utilization(costs, Timing(5, 0, 5), speed=Fraction(10**6)) == Fraction("0.0410")
