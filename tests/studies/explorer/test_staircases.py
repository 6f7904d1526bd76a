"""Staircases and landings are those of the library, thinned where there are many."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import Stair, achieved_l, has_closed_form, least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task
from studies.explorer.staircases import MOST_SIMULATED, MOST_STAIRS, landings, stairs
from tests.designs import Design, dual_rate_designs, horizon_designs, serial_designs

DUAL_RATE = select(load_costs("steffes2014"), "dual-rate")


def _stairs(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> list[Stair]:
    return stairs(costs, timing, options, tasks, least_speed(costs, timing, options, tasks))


@given(dual_rate_designs() | horizon_designs() | serial_designs())
def test_short_staircases_are_whole(design: Design) -> None:
    costs, timing, options = design
    assert _stairs(costs, timing, options, ()) == staircase(costs, timing.N, timing.M, options)


speeds = st.fractions(Fraction(1, 10), 500, max_denominator=50)


@given(dual_rate_designs() | serial_designs(), speeds)
def test_every_speed_lands_where_the_closed_form_says(design: Design, speed: Fraction) -> None:
    costs, timing, options = design
    assume(has_closed_form(options, (), costs, timing))
    turns = landings(costs, timing, options, (), _stairs(costs, timing, options, ()))
    overruns = [turn for turn, reached in turns if reached is None]
    if not any(turn * (1 - NEAR) < speed < turn for turn in overruns):
        assert _at(turns, speed) == achieved_l(costs, timing, speed, options)


@given(horizon_designs(), speeds)
def test_of_a_delayed_horizon_only_where_every_deadline_holds(design: Design, speed: Fraction) -> None:
    costs, timing, options = design
    turns = landings(costs, timing, options, (), _stairs(costs, timing, options, ()))
    if speed >= turns[0][0]:
        assert _at(turns, speed) == achieved_l(costs, timing, speed, options)


@given(dual_rate_designs())
def test_just_below_a_turn_corrections_land_as_at_the_one_before(design: Design) -> None:
    costs, timing, options = design
    turns = landings(costs, timing, options, (), _stairs(costs, timing, options, ()))
    assert turns == sorted(turns, key=lambda turn: turn[0])
    for speed, landed in turns:
        if landed is not None:
            below = speed * (1 - Fraction(1, 10**9))
            assert achieved_l(costs, timing, speed, options) == landed
            assert achieved_l(costs, timing, below, options) == _at(turns, below)


NEAR = Fraction(1, 100)


def _at(turns: list[tuple[Fraction, int | None]], speed: Fraction) -> int | None:
    return next((landed for turn, landed in reversed(turns) if turn <= speed), None)


@pytest.mark.parametrize(("N", "M", "L"), [(1000, 4, 733), (5000, 0, 4999)])
def test_of_long_staircases_some_stairs_are_kept_the_designs_own_among_them(N: int, M: int, L: int) -> None:
    found = _stairs(DUAL_RATE, Timing(N, M, L), Options(), ())
    kept = [stair.L for stair in found]
    assert len(kept) <= MOST_STAIRS + 1
    assert kept == sorted(set(kept))
    assert {M + 1, M + 2, L, N} <= set(kept)
    assert found == [stair for stair in staircase(DUAL_RATE, N, M) if stair.L in kept]


TASK = Task("control", Fraction(2), Fraction(1, 10), 5)


@pytest.mark.parametrize(
    ("timing", "options", "tasks"),
    [
        (Timing(10, 4, 8), Options(policy="edf"), ()),
        (Timing(10, 4, 8), Options(context_switch=Fraction(1, 100)), ()),
        (Timing(10, 4, 8), Options(), (TASK,)),
        (Timing(5, 12, 14), Options(), ()),
    ],
)
def test_without_a_closed_form_a_few_stairs_are_searched(
    timing: Timing, options: Options, tasks: tuple[Task, ...]
) -> None:
    assert not has_closed_form(options, tasks, DUAL_RATE, timing)
    found = _stairs(DUAL_RATE, timing, options, tasks)
    assert 1 < len(found) <= MOST_SIMULATED + 1
    assert timing.L in [stair.L for stair in found]
    for stair in found:
        of = Timing(timing.N, timing.M, stair.L)
        assert (stair.speed, stair.binding) == least_speed(DUAL_RATE, of, options, tasks)
        assert stair.achieved == landing(DUAL_RATE, of, stair.speed, options, tasks)
