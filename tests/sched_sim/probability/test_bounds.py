"""Costs rounded to bins bound what exact ticks say."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import Phase, given, seed, settings
from hypothesis import strategies as st

from sched_sim.design.options import Options
from sched_sim.design.pieces import CarriedGainCosts, CloneCosts, DualRateCosts, LarsenCosts, RecalculateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.probability.outcome import Bounds, Floats
from sched_sim.schedule.tasks import Task
from tests.exhaust import share_of

T, BINS = 60, 12
ROUNDING = 1e-12


class Design:
    """timing, options: of the costs; task: one beside, with its cost, if any."""

    def __init__(self, costs: Any, timing: Timing, options: Options, of_task: CostDistribution | None) -> None:
        self.costs, self.timing, self.options, self.of_task = costs, timing, options, of_task

    def __repr__(self) -> str:
        return f"{self.costs} {self.timing} {self.options} {self.of_task}"


def costs_up_to(most: int) -> st.SearchStrategy[CostDistribution]:
    values = st.lists(st.integers(0, most), min_size=1, max_size=3)
    return values.map(lambda several: CostDistribution.of_samples([Fraction(value) for value in several]))


@st.composite
def designs(draw: st.DrawFn) -> Design:
    kind = draw(
        st.sampled_from([DualRateCosts, DualRateCosts, RecalculateCosts, LarsenCosts, CloneCosts, CarriedGainCosts])
    )
    N = draw(st.integers(1, 4))
    of_task = draw(st.none() | costs_up_to(20))
    if kind is not DualRateCosts:
        pieces = [draw(costs_up_to(35)) for _ in range(3 if kind in (RecalculateCosts, LarsenCosts) else 4)]
        M = draw(st.integers(0, N))
        return Design(kind(*pieces), Timing(N, M, M), Options(), of_task)
    high, low = costs_up_to(45), costs_up_to(60)
    nothing = CostDistribution.certain(0)
    costs = DualRateCosts(draw(high), draw(high), draw(costs_up_to(20)), draw(low), nothing, draw(low))
    M = draw(st.integers(0, 4))
    if of_task is None and draw(st.booleans()):
        options = Options(feedback="same-step")
        return Design(costs, Timing(N, M, M + 1), options, None)
    return Design(costs, Timing(N, M, M + draw(st.integers(1, 3))), Options(), of_task)


def bins_bound_the_exact(design: Design) -> None:
    tasks, of_tasks = [], {}
    if design.of_task is not None:
        tasks = [Task("t", period=Fraction(3, 2), cost=Fraction(7), priority=5, offset=Fraction(1, 2))]
        of_tasks = {"t": design.of_task}
    exact, rounded = (
        probabilities(design.costs, design.timing, T, 4, design.options, tasks, task_costs=of_tasks, bins=bins, debt=2)
        for bins in (None, BINS)
    )
    assert exact.exact
    assert rounded.ticks == BINS
    pairs = [*zip(exact.cycles, rounded.cycles, strict=True)]
    if exact.long_run is not None and rounded.long_run is not None:
        pairs.append((exact.long_run, rounded.long_run))
    for inner, outer in pairs:
        holds(outer.late, inner.late)
        for kind in inner.misses:
            holds(outer.misses[kind], inner.misses[kind])
        for landed in inner.landing.keys() | outer.landing.keys():
            holds(*(each.landing.get(landed, Bounds(0, each.behind)) for each in (outer, inner)))
        for kind in inner.responses:
            for number in range(4 * BINS):
                exactly = Bounds(*(at(tail, number * exact.ticks // BINS) for tail in inner.responses[kind]))
                holds(Bounds(*(at(tail, number) for tail in outer.responses[kind])), exactly)


def holds(outer: Bounds, inner: Bounds) -> None:
    """There is something between both."""
    assert outer.lower <= inner.upper + ROUNDING
    assert inner.lower <= outer.upper + ROUNDING


def at(tail: Floats, number: int) -> float:
    return float(tail[min(number, len(tail) - 1)])


@settings(phases=[Phase.generate])  # to shrink one takes minutes
@given(designs())
def test_bins_bound_the_exact(design: Design) -> None:
    bins_bound_the_exact(design)


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(4))
def test_bins_bound_the_exact_of_many(part: int, record_property: Callable[[str, object], None]) -> None:
    count = share_of(400)

    @seed(part)
    @settings(max_examples=count, phases=[Phase.generate])
    @given(designs())
    def law(design: Design) -> None:
        bins_bound_the_exact(design)

    law()
    record_property("designs", count)


def test_a_response_is_followed_beyond_the_backlog_that_is() -> None:
    costs = CloneCosts(*(CostDistribution.of_samples(each) for each in ([0, 4, 30], [5, 8, 31], [17], [0, 4, 30])))
    task = Task("t", period=Fraction(3, 2), cost=Fraction(17), priority=5, offset=Fraction(1, 2))
    few, many = (
        probabilities(costs, Timing(1, 0, 0), T, 4, tasks=[task], debt=debt).cycles[3].responses["hr"]
        for debt in (2, 6)
    )
    beyond = 235
    assert 0 < few.lower[beyond] <= many.lower[beyond] <= few.upper[beyond]


def test_corrections_that_land_together_may_do_so_where_longer_costs_part_them() -> None:
    high = CostDistribution.of_samples([0, 0, 19])
    nothing = CostDistribution.certain(0)
    low = CostDistribution.of_samples([10, 42]), nothing, CostDistribution.of_samples([41, 42])
    bins_bound_the_exact(Design(DualRateCosts(high, high, high, *low), Timing(2, 0, 1), Options(), None))


def test_what_is_too_far_behind_to_be_followed_may_be_late() -> None:
    certain = CostDistribution.certain
    overloaded = RecalculateCosts(certain(Fraction(40)), certain(Fraction(1)), certain(Fraction(1)))
    found = probabilities(overloaded, Timing(4, 1, 1), 30, cycles=21)
    assert found.cycles[0].late == Bounds(1.0, 1.0)
    assert (found.cycles[-1].behind, found.cycles[-1].late.upper) == (1.0, 1.0)


def test_a_bound_with_too_many_HR_updates_to_follow_does_not_spoil_that_with_fewer() -> None:
    certain = CostDistribution.certain
    lr_update = CostDistribution((20, 22), (0.5, 0.5))
    costs = DualRateCosts(certain(50), certain(50), certain(20), certain(10), certain(0), lr_update)
    beside = [Task("control", period=4, cost=25, priority=5, offset=2)]
    found = probabilities(costs, Timing(4, 0, 4), 80, 9, tasks=beside, bins=100)
    assert found.long_run is not None
    for cycle in found.cycles:
        assert cycle.behind == 0
        assert cycle.late == Bounds(0, 0)
        assert cycle.hr_miss.upper <= found.long_run.hr_miss.upper + ROUNDING


@pytest.mark.parametrize("delays", [None, CostDistribution((0, 1, 2), (0.5, 0.25, 0.25))])
@pytest.mark.parametrize("bins", [None, 7])
def test_a_correction_of_which_nothing_is_followed_may_be_late(
    delays: CostDistribution | None, bins: int | None
) -> None:
    """The load is 7: from some cycle on all is further behind than is followed."""
    certain = CostDistribution.certain
    costs = RecalculateCosts(certain(40), certain(30), certain(30))
    found = probabilities(costs, Timing(2, 1, 1), 10, 4, delays=delays, bins=bins)
    for cycle in found.cycles:
        assert cycle.late.upper == pytest.approx(1)
