"""Delayed horizon, PX4's predictor, augmentation, and late measurements taken for new ones: what they need, by hand."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.systems.example import example_system
from sched_sim.costs.methods import CAVEATS, DELAYED_METHODS
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.pieces import AugmentationCosts, DelayedHorizonCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from studies.measurement.methods import measure
from tests.designs import Design, horizon_designs

COUNTED = load_costs("counted-9-3-3")
LATE = ("delayed-horizon", "px4-predictor", "augmentation", "fuse-as-fresh")
INS = Timing(80, 44, 48)


@pytest.fixture(scope="module")
def short() -> CostTable:
    """Counts at 9 states, 3 inputs and 3 measurements in the cheapest form."""
    return measure(example_system(9, 3, 3), "counted", "short", name="short", methods=("standard", *LATE))


def to_land_at(costs: DelayedHorizonCosts[Fraction], N: int, M: int, L: int) -> Fraction:
    """One processor, M > 0: update and replay between m and l, and all LR work in a cycle, beside the HR jobs."""
    soon = costs.update + L * costs.replay
    return costs.predict + max(soon / (L - M), (soon + N * costs.propagate) / N)


def test_the_delayed_horizon_of_an_inertial_navigation(short: CostTable) -> None:
    """207 operations in each step; 1,397 and 207 for each step replayed; 2,835 for each covariance: 3,184, at l = 48.
    (One with nine fewer in the update, which leaves the sum of state and correction to the replay, needs the same.)"""
    costs = select(short, "delayed-horizon")
    assert costs == DelayedHorizonCosts(207, 1397, 207, 2835)
    least = least_speed(costs, INS)
    assert least == (Fraction(1397 + 207 * 48 + 80 * 2835, 80) + 207, "lr_propagate")
    assert round(least.speed) == round(to_land_at(DelayedHorizonCosts(207, 1388, 207, 2835), 80, 44, 48)) == 3184
    assert achieved_l(costs, INS, least.speed) == 48
    assert simulate(costs, INS, least.speed, 3).achieved == {48: 3}


@given(horizon_designs().filter(lambda design: design.options.cpus == 1 and design.timing.M > 0))
def test_it_needs_what_the_cheapest_landing_by_l_does(design: Design) -> None:
    costs, (N, M, L) = design.costs, (design.timing.N, design.timing.M, design.timing.L)
    exact = DelayedHorizonCosts(*map(Fraction, (costs.predict, costs.update, costs.replay, costs.propagate)))
    landings = [to_land_at(exact, N, M, c) for c in range(M + 1, L + 1)]
    assert least_speed(costs, design.timing).speed == min(landings)


def test_a_later_deadline_never_needs_more(short: CostTable) -> None:
    stairs = staircase(select(short, "delayed-horizon"), 80, 44)
    speeds = [stair.speed for stair in stairs]
    assert speeds == sorted(speeds, reverse=True)
    assert {stair.achieved for stair in stairs if stair.L >= 48} == {48}


def test_px4s_predictor_does_all_in_the_step_of_the_measurement(short: CostTable) -> None:
    """Each of 45 outputs is shifted in each step: 9 additions, beside 45 operations to know by how much."""
    in_each_step = 207 + 3042 + 45 + 9 * 45
    assert least_speed(select(short, "px4-predictor"), INS) == (in_each_step + 1397, "hr")
    busy = simulate(select(short, "px4-predictor"), INS, in_each_step + 1397, 3).utilization
    assert busy == Fraction(80 * in_each_step + 1397, 80 * (in_each_step + 1397))


def test_augmentation_is_no_answer_to_a_long_delay(short: CostTable) -> None:
    """From the costs at 0, 1 and 2 delayed states to those at 44."""
    costs = select(short, "augmentation")
    assert costs == AugmentationCosts(3042, 1377, 1443, 1620, 486)
    update = 1443 + 44 * 1620 + 44 * 43 // 2 * 486
    assert least_speed(costs, INS).speed == 3042 + 44 * 1377 + update
    assert least_speed(costs, INS).speed > 100 * least_speed(select(short, "fuse-as-fresh"), INS).speed


@given(st.lists(st.integers(1, 100), min_size=5, max_size=5), st.integers(0, 60))
def test_measured_costs_of_augmentation_are_never_negative(figures: list[int], M: int) -> None:
    kinds = ("predict_0", "predict_1", "update_0", "update_1", "update_2")
    measured = CostTable(
        "m", "us", {"augmentation": {k: Cost.of(Fraction(v)) for k, v in zip(kinds, figures, strict=True)}}
    )
    assert least_speed(select(measured, "augmentation"), Timing(60, M, 60)).speed >= figures[0] + figures[2]


def test_the_baseline_costs_what_the_standard_filter_does() -> None:
    baseline, standard = (least_speed(select(COUNTED, name), INS) for name in ("fuse-as-fresh", "standard"))
    assert baseline == standard
    assert simulate(select(COUNTED, "fuse-as-fresh"), INS, baseline.speed, 2).achieved == {44: 2}


def test_a_delayed_horizon_lands_after_the_step_of_the_measurement() -> None:
    costs = select(COUNTED, "delayed-horizon")
    with pytest.raises(InputError, match=r"L=4 must be > M=4: what is replayed .*; give L from 5 to N=10"):
        least_speed(costs, Timing(10, 4, 4))
    with pytest.raises(InputError, match=r"L=10 must be > M=10: .* recalculate or larsen"):
        simulate(costs, Timing(10, 10, 10), 10**6)


@pytest.mark.parametrize("method", LATE)
def test_the_shipped_counts_have_them(method: str) -> None:
    assert method in DELAYED_METHODS
    assert method in METHODS
    costs = select(COUNTED, method, Options())
    least = least_speed(costs, Timing(10, 4, 8))
    assert simulate(costs, Timing(10, 4, 8), least.speed, 5).misses == 0
    assert simulate(costs, Timing(10, 4, 8), least.speed - Fraction(1, 10**6), 5).misses > 0


def test_what_is_not_exact_says_so() -> None:
    assert set(CAVEATS) == {"px4-predictor", "fuse-as-fresh"}
