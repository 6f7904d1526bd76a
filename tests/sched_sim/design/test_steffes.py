"""Steffes (2014), Table 4, from the costs of its Tables 1-3 through the analysis."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing

PAPER = Options()
BY_L = Options(lr_propagate_by="l")


def costs(method: str):
    return select(load_costs("steffes2014"), method, PAPER)


@pytest.mark.parametrize(
    ("N", "M", "L", "options", "speed", "binding"),
    [
        (10, 4, 8, PAPER, "77/100", "lr_update"),
        (10, 2, 8, PAPER, "217/300", "lr_update"),
        (10, 2, 3, PAPER, "119/100", "lr_update"),
        (100, 10, 20, PAPER, "686/1000", "lr_update"),
        (100, 10, 80, PAPER, "66/100", "hr"),
        (10, 1, 8, PAPER, "104/100", "lr_propagate"),
        (10, 1, 8, BY_L, "6775/10000", "lr_total"),
    ],
)
def test_least_speed_of_dual_rate(N: int, M: int, L: int, options: Options, speed: str, binding: str) -> None:
    assert least_speed(costs("dual-rate"), Timing(N, M, L), options) == (Fraction(speed), binding)


@pytest.mark.parametrize(("M", "speed"), [(4, "2.81"), (2, "1.91"), (10, "5.51")])
def test_least_speed_of_recalculate_grows_with_the_delay(M: int, speed: str) -> None:
    assert least_speed(costs("recalculate"), Timing(100, M, 20)) == (Fraction(speed), "hr")


@pytest.mark.parametrize(("N", "M", "L"), [(10, 4, 8), (10, 2, 8), (10, 2, 3), (100, 10, 20), (100, 10, 80)])
def test_least_speed_of_larsen_is_the_same_for_all(N: int, M: int, L: int) -> None:
    assert least_speed(costs("larsen"), Timing(N, M, L)) == (Fraction("1.47"), "hr")


def test_the_standard_filter_is_the_unit() -> None:
    assert least_speed(costs("standard"), Timing(10, 4, 8)).speed == 1


def test_the_paper_asks_for_l_80_and_gets_29() -> None:
    """N = 100, M = 10: at the 0.66 that L = 80 needs, the correction already lands at L = 29 (and not at 28)."""
    speed = Fraction("0.66")
    assert achieved_l(costs("dual-rate"), Timing(100, 10, 80), speed) == 29
    schedule = simulate(costs("dual-rate"), Timing(100, 10, 80), speed, cycles=3)
    assert schedule.achieved == {29: 3}
    assert schedule.misses == 0
    by_L = {stair.L: stair for stair in staircase(costs("dual-rate"), 100, 10)}
    assert by_L[28].speed > speed
    assert {by_L[L].speed for L in range(29, 101)} == {speed}


def test_the_schedule_of_figure_3() -> None:
    """N = 10, M = 4, L = 8 at 0.77, worked out by hand in hundredths of a standard step.

    LR propagate: released when the HR job of step 0 finishes at 63; 14 ticks in step 0, the HR job of step 1 (4),
    the other 27 of 41: response 45. LR update: released at 4 x 77 = 308, then in each of steps 4-7 the 14 ticks that
    the HR job leaves, 56 in all: it finishes at 8 x 77, its deadline.
    """
    schedule = simulate(costs("dual-rate"), Timing(10, 4, 8), Fraction("0.77"), cycles=2)
    assert schedule.period == 77
    assert schedule.responses["lr_propagate"].worst == 45
    assert schedule.responses["lr_update"].worst == 4 * 77
    assert schedule.responses["hr"].worst == 66
    assert schedule.achieved == {8: 2}
    assert schedule.preemptions == 2 * (1 + 3)
    work = 2 * (9 * 63 + 4 + 3 + 41 + 56)
    assert schedule.busy == work
    assert schedule.utilization == Fraction(work, 2 * 770)
