"""N and L together: the formula of the study against the schedule's own least speed and simulation."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from studies.accuracy.slow_processor import DELAY_STEPS, FRAME_STEPS, at_speeds, best, choices, costs, needed

BY_L = Options(lr_propagate_by="l")


@pytest.mark.parametrize("every", [1, 2, 3])
def test_the_formula_is_the_least_speed(every: int) -> None:
    """Where several are in flight the least speed is of a bisection, exact to one tick."""
    N = every * FRAME_STEPS
    for L in range(DELAY_STEPS + 1, DELAY_STEPS + N + 4):
        least = least_speed(costs(), Timing(N, DELAY_STEPS, L), BY_L).speed
        if L <= N:
            assert least == needed(every, L)
        else:
            assert needed(every, L) <= least <= needed(every, L) + Fraction(1, 50_000)


@pytest.mark.parametrize(("every", "L"), [(1, 5), (1, 6), (2, 9), (2, 10), (3, 13)])
def test_in_flight_frames_land_there_and_no_slower_processor_does(every: int, L: int) -> None:
    timing, speed = Timing(every * FRAME_STEPS, DELAY_STEPS, L), needed(every, L)
    schedule = simulate(costs(), timing, speed, 100, BY_L)
    assert schedule.misses == 0
    assert max(schedule.achieved) == L
    assert achieved_l(costs(), timing, speed * Fraction(9_999, 10_000), BY_L) is None


def test_at_speed_6_every_frame_can_be_used() -> None:
    alone, several = (best(choices(), Fraction(6), several=several) for several in (False, True))
    assert alone is not None
    assert several is not None
    assert (alone.every, alone.L, f"{1000 * alone.worst:.1f}") == (2, 6, "22.0")
    assert (several.every, several.L, f"{1000 * several.worst:.1f}") == (1, 6, "14.9")


def test_several_in_flight_are_never_worse() -> None:
    for alone, several in at_speeds(choices()).values():
        assert alone is None or several.worst <= alone.worst


def test_nothing_runs_below_the_load() -> None:
    assert best(choices(), Fraction(1), several=True) is None
