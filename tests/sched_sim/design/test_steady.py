"""A schedule that has returned to an earlier state has shown all that will ever come."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given, seed, settings
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.load import loads
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, StandardCosts
from sched_sim.design.search import search_resolution
from sched_sim.design.simulate import simulate
from sched_sim.design.steady import run_until_steady
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task
from tests.designs import Design, loaded_designs
from tests.exhaust import share_of

FIGURE_3 = Timing(10, 4, 8)
OF_ONE_PRIORITY = [
    Task("control", period=Fraction(10), cost=Fraction(5), priority=30, offset=Fraction(0)),
    Task("telemetry", period=Fraction(10), cost=Fraction(5), priority=30, offset=Fraction(5)),
]


@pytest.mark.parametrize(("method", "least"), [("standard", "1.505"), ("larsen", "1.594"), ("dual-rate", "1.671")])
def test_tasks_of_one_priority_need_the_whole_load(method: str, least: str) -> None:
    """Larsen by hand: 7 x 0.45 + 3 x 0.66 + 0.81 for the filter and 2 x 5 for the tasks in 10 HR periods: 1.594."""
    costs = select(load_costs("steffes2014"), method, Options())
    found = least_speed(costs, FIGURE_3, tasks=OF_ONE_PRIORITY)
    assert found == (Fraction(least), "load")
    assert simulate(costs, FIGURE_3, found.speed, 100, tasks=OF_ONE_PRIORITY).misses == 0


def holds_for_ever(loaded: tuple[Design, list[Task]]) -> None:
    """At the least speed nothing is missed in 20 times as many cycles as the search has seen; one tick below is too
    slow."""
    (costs, timing, options), tasks = loaded
    speed = least_speed(costs, timing, options, tasks).speed
    assert all(share <= 1 for share in loads(costs, timing, speed, options, tasks))
    steady = run_until_steady(costs, timing, speed, options, tasks)
    assert steady.repeats
    assert simulate(costs, timing, speed, 20 * -(-steady.steps // timing.N), options, tasks).misses == 0
    slower = speed - Fraction(1, search_resolution(costs, options, tasks))
    assert not run_until_steady(costs, timing, slower, options, tasks).repeats


def test_a_task_that_makes_a_correction_land_later_may_help() -> None:
    """Without it the correction lands in step 1, whose HR job is 2 + 25; with it in step 2, whose job is 1 + 25."""
    costs, timing = DualRateCosts(1, 2, 25, 1, 0, 24), Timing(3, 0, 3)
    assert least_speed(costs, timing).speed == 27
    assert (
        least_speed(costs, timing, tasks=[Task("a", Fraction(3), Fraction(1), priority=5, offset=Fraction(0))]).speed
        == 26
    )


@pytest.mark.exhaust
def test_a_backlog_that_grows_slowly_takes_no_more_simulations_than_another() -> None:
    """A period that is a tick too short misses its first deadline a little later than one that is two too short."""
    late = Fraction(7, 3)
    tasks = [Task("a", 1, 4, 20, offset=0), Task("b", 1, 1, 20, offset=late), Task("c", 1, 56, 20, offset=late)]
    runs: list[int] = []
    options = Options(context_switch=Fraction(3, 2))
    least_speed(StandardCosts(Fraction(1), Fraction(1)), Timing(1, 0, 1), options, tasks, on_progress=runs.append)
    assert len(runs) < 200


test_what_holds_at_the_least_speed_holds_for_ever = settings(max_examples=60)(given(loaded_designs())(holds_for_ever))


@pytest.mark.exhaust
@pytest.mark.parametrize("number", range(10))
def test_it_does_on_ten_thousand_designs(number: int, record_property: Callable[[str, object], None]) -> None:
    examples = share_of(1000)
    seed(number)(settings(max_examples=examples)(given(loaded_designs())(holds_for_ever)))()
    record_property("designs", examples)


@settings(max_examples=60)
@given(loaded_designs(), st.fractions(Fraction(1, 2), 2, max_denominator=20))
def test_what_is_seen_until_it_repeats_is_all_that_comes(loaded: tuple[Design, list[Task]], share: Fraction) -> None:
    (costs, timing, options), tasks = loaded
    speed = max(loads(costs, timing, Fraction(1), options, tasks)) * share
    steady = run_until_steady(costs, timing, speed, options, tasks)
    cycles = 10 * -(-steady.steps // timing.N)
    longer = simulate(costs, timing, speed, cycles, options, tasks)
    assert (longer.misses == 0) == steady.repeats
    assert longer.misses or set(longer.achieved) == set(steady.schedule.achieved)
    assert longer.misses or share >= 1


def test_a_task_that_has_no_offset_and_no_backlog_repeats_after_one_hyperperiod() -> None:
    step, task = (
        StandardCosts(Fraction(1), Fraction(1)),
        Task("control", Fraction(3), Fraction(1), priority=30, offset=Fraction(0)),
    )
    steady = run_until_steady(step, Timing(2, 0, 2), Fraction(4), tasks=[task])
    assert steady.repeats
    assert steady.steps == 6


def test_work_that_piles_up_never_repeats() -> None:
    """15.94 units of work in ten HR periods (see above), at a speed of 1.593; the tasks may wait for ten periods."""
    costs = select(load_costs("steffes2014"), "larsen", Options())
    steady = run_until_steady(costs, FIGURE_3, Fraction("1.593"), tasks=OF_ONE_PRIORITY)
    assert not steady.repeats
    assert steady.schedule.misses > 0
    assert simulate(costs, FIGURE_3, Fraction("1.593"), 4, tasks=OF_ONE_PRIORITY).misses == 0


@pytest.mark.parametrize(
    ("task", "told"),
    [
        (Task("odd", Fraction("3.141592653"), Fraction(1), 30, Fraction(0)), r"round their periods \(odd 3\.14159\)"),
        (
            Task("late", Fraction(4), Fraction(1), 30, offset=Fraction(10**9)),
            r"'late': offset 1e\+09 .*below its period",
        ),
    ],
)
def test_what_takes_too_long_to_simulate_is_refused_by_name(task: Task, told: str) -> None:
    with pytest.raises(InputError, match=told):
        least_speed(StandardCosts(Fraction(1), Fraction(1)), FIGURE_3, tasks=[task])


def test_a_cycle_that_takes_too_long_to_simulate_is_refused_with_context_switches() -> None:
    with pytest.raises(InputError, match=r"N=1000000 .*leave out context_switch .*simulate --speed"):
        least_speed(
            StandardCosts(Fraction(1), Fraction(1)), Timing(10**6, 0, 1), Options(context_switch=Fraction(1, 100))
        )
