"""Least speed by bisection on the simulation: context switches and the user's tasks."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import StandardCosts
from sched_sim.design.search import least_speed_by_simulation, search_resolution
from sched_sim.design.simulate import simulate
from sched_sim.design.steady import run_until_steady
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task
from tests.designs import Design, designs

PAPER = select(load_costs("steffes2014"), "dual-rate", Options())
FIGURE_3 = Timing(10, 4, 8)


def test_a_context_switch_costs_what_one_counts_by_hand() -> None:
    """Steps 4-7: four HR jobs and four dispatches of the LR update, 0.01 each: (4 x 0.63 + 0.56 + 8 x 0.01) / 4."""
    options = Options(context_switch=Fraction("0.01"))
    assert least_speed(PAPER, FIGURE_3, options) == (Fraction("0.79"), "lr_update")


@settings(max_examples=40)
@given(designs, st.fractions(Fraction(1, 10), 3, max_denominator=10))
def test_with_context_switches_it_is_exact_to_one_tick(design: Design, context_switch: Fraction) -> None:
    costs, timing, options = design
    options = replace(options, context_switch=context_switch)
    speed = least_speed(costs, timing, options).speed
    assert simulate(costs, timing, speed, 80, options).misses == 0
    slower = speed - Fraction(1, search_resolution(costs, options, ()))
    assert not run_until_steady(costs, timing, slower, options).repeats


@pytest.mark.parametrize(
    ("timing", "options", "binding"),
    [
        (FIGURE_3, Options(), "lr_update"),
        (Timing(100, 10, 80), Options(), "hr"),
        (Timing(10, 1, 8), Options(), "lr_propagate"),
        (Timing(10, 1, 8), Options(lr_propagate_by="l"), "lr_total"),
        (Timing(10, 0, 3), Options(), "lr_total"),
    ],
)
def test_it_names_the_demand_that_binds_as_the_closed_form_does(timing: Timing, options: Options, binding: str) -> None:
    assert least_speed(PAPER, timing, options).binding == binding
    assert least_speed_by_simulation(PAPER, timing, options, ())[1] == binding


def test_rate_monotonic_tasks_need_what_liu_and_layland_say() -> None:
    """C. L. Liu and J. W. Layland (1973), Theorem 3: two tasks of periods 1 and sqrt(2), here 5 and 7, costs 2 and 3
    per the worst case C1 = T2 - T1, C2 = 2 T1 - T2: they fully use the processor, at 2/5 + 3/7 = 0.829."""
    step = StandardCosts(Fraction(1), Fraction(1))  # the filter itself is the faster task: cost 2 each 1 HR period
    slow = Task("slow", period=Fraction(7, 5), cost=Fraction(3), priority=20)
    least = least_speed(step, Timing(1, 0, 1), tasks=[slow])
    assert least.speed == 5  # one HR period is 5 units long: T1 = 5, C1 = 2, T2 = 7, C2 = 3
    assert least.binding == "task:slow"


def test_of_a_filter_without_work_the_least_speed_is_that_of_the_tasks() -> None:
    nothing, task = StandardCosts(Fraction(0), Fraction(0)), Task("a", Fraction(1), Fraction(4), 20)
    assert least_speed(nothing, Timing(5, 0, 5), Options(), [task]).speed == 4
