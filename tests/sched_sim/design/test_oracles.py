"""The analysis and the simulation are each other's oracle: over random costs, N, M, L, methods and options."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.options import Options
from sched_sim.design.pieces import DelayedHorizonCosts, DualRateCosts
from sched_sim.design.search import least_speed_by_simulation
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from tests.agreement import landing
from tests.designs import Design, designs, dual_rate_designs

CYCLES = 4

lands_at_once_or_later = Design(DualRateCosts(6, 1, 5, 1, 0, 1), Timing(6, 0, 6), Options())
feedback_spills = Design(DualRateCosts(40, 40, 30, 5, 0, 20), Timing(9, 2, 6), Options(feedback="same-step"))
horizon_piles_up = Design(DelayedHorizonCosts(1, 1, 1, 1), Timing(2, 0, 2), Options())
horizon_is_late_and_keeps_up = horizon_piles_up._replace(options=Options(cpus=2))


@settings(max_examples=120)
@example(lands_at_once_or_later)
@example(feedback_spills)
@given(designs)
def test_the_simulation_meets_every_deadline_at_the_least_speed_and_misses_one_tick_below(design: Design) -> None:
    least = least_speed(*design).speed
    assert simulate(design.costs, design.timing, least, CYCLES, design.options).misses == 0
    slower = least - Fraction(1, least.denominator)
    assume(slower > 0)
    assert simulate(design.costs, design.timing, slower, CYCLES, design.options).misses > 0


@settings(max_examples=60)
@given(designs, st.fractions(Fraction(1, 100), Fraction(99, 100), max_denominator=100))
def test_no_speed_below_the_least_meets_every_deadline(design: Design, share: Fraction) -> None:
    slower = least_speed(*design).speed * share
    assert simulate(design.costs, design.timing, slower, CYCLES, design.options).misses > 0


@settings(max_examples=120)
@example(horizon_piles_up, Fraction(33, 34))
@example(horizon_is_late_and_keeps_up, Fraction(33, 34))
@given(designs, st.fractions(Fraction(1, 4), 4, max_denominator=64))
def test_achieved_l_agrees_at_random_speeds(design: Design, share: Fraction) -> None:
    costs, timing, options = design
    speed = least_speed(*design).speed * share
    simulated = landing(costs, timing, speed, options)
    assert achieved_l(costs, timing, speed, options) == (None if simulated == NOT_LANDED else simulated)


def test_a_delayed_horizon_that_is_late_on_its_own_processor_lands_if_the_next_cycle_finds_nothing_left() -> None:
    """LR work of 1 + 2 + 2 at 99/34 a step begins when the HR job of k, 1, is done: late by 6/99 of a step, before
    the HR job of the next k is done. On one processor each cycle leaves more."""
    costs, timing, shared, separate = *horizon_piles_up, Options(cpus=2)
    speed = Fraction(99, 34)
    schedule = simulate(costs, timing, speed, 100, separate)
    assert schedule.achieved == {2: 100}
    assert schedule.responses["lr_propagate"].misses == 100
    assert Fraction(schedule.responses["lr_propagate"].worst_lateness, schedule.period) == Fraction(6, 99)
    assert achieved_l(costs, timing, speed, separate) == 2
    slower = least_speed(costs, timing, shared).speed * Fraction(33, 34)
    assert max(simulate(costs, timing, slower, 100, shared).achieved) > 2
    assert achieved_l(costs, timing, slower, shared) is None


def every_faster_processor_does(design: Design) -> bool:
    """Not so where landing earlier lands in a longer HR job, or lets the HR update spill into the next step."""
    costs = design.costs
    return not isinstance(costs, DualRateCosts) or (
        costs.hr_restart <= costs.hr and design.options.feedback == "next-step"
    )


@settings(max_examples=60)
@given(designs.filter(every_faster_processor_does))
def test_bisection_on_the_simulation_finds_the_closed_form(design: Design) -> None:
    found, _ = least_speed_by_simulation(*design, tasks=())
    assert 0 <= found - least_speed(*design).speed < Fraction(1, 1000)


@settings(max_examples=60)
@given(designs.filter(every_faster_processor_does), st.fractions(1, 3, max_denominator=50))
def test_a_faster_processor_does_too(design: Design, times: Fraction) -> None:
    assert simulate(design.costs, design.timing, least_speed(*design).speed * times, CYCLES, design.options).misses == 0


def test_where_the_restart_is_the_longest_hr_job_a_faster_processor_may_miss() -> None:
    """At 10/3 the correction lands in step 2 or 3, whose HR job is 1 + 2; at 4 already in step 1, which is 3 + 2."""
    costs, timing = DualRateCosts(1, 3, 2, 1, 0, 2), Timing(3, 0, 3)
    assert least_speed(costs, timing).speed == Fraction(10, 3)
    assert simulate(costs, timing, Fraction(10, 3), CYCLES).misses == 0
    assert simulate(costs, timing, Fraction(4), CYCLES).misses > 0
    assert simulate(costs, timing, Fraction(5), CYCLES).misses == 0


@settings(max_examples=60)
@given(dual_rate_designs())
def test_a_later_l_never_needs_a_faster_processor_and_lands_no_later_than_asked(design: Design) -> None:
    stairs = staircase(design.costs, design.timing.N, design.timing.M, design.options)
    speeds = [stair.speed for stair in stairs]
    assert speeds == sorted(speeds, reverse=True)
    assert all(stair.achieved <= stair.L for stair in stairs)


@settings(max_examples=40)
@given(dual_rate_designs(), st.integers(1, 20))
def test_work_is_conserved(design: Design, share: int) -> None:
    """Utilization is the work of the jobs that ran, whatever preempted what: slices add up to it and never overlap."""
    speed = least_speed(*design).speed * Fraction(share, 10)
    schedule = simulate(design.costs, design.timing, speed, CYCLES, design.options, keep_slices=True)
    assert sum(piece.end - piece.start for piece in schedule.slices) == schedule.busy
    for cpu in range(schedule.cpus):
        mine = sorted((piece.start, piece.end) for piece in schedule.slices if piece.cpu == cpu)
        assert all(end <= start for (_, end), (start, _) in pairwise(mine))
    done: dict[tuple[str, int], int] = {}
    for piece in schedule.slices:
        assert piece.begin == done.get((piece.kind, piece.step), 0)
        done[piece.kind, piece.step] = piece.begin + piece.end - piece.start
        if piece.finished:
            assert done[piece.kind, piece.step] == sum(work for _, work in piece.parts)
