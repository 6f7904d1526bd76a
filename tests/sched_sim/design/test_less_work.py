"""Work that takes less than its costs: where that misses nothing, and where it does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any
from unittest.mock import patch

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.design.least_speed import least_speed
from sched_sim.design.less_work import TRIES, enough_for_less, less_work
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, LarsenInFlightCosts, MultirateCosts, works
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.jobs import Job
from sched_sim.schedule.tasks import Task
from tests.designs import Design, designs, designs_in_flight, loaded_designs

TIMING, TASK = Timing(4, 0, 4), Task("control", Fraction(4), Fraction(25), 5, Fraction(2))


def costs(lr_update: int) -> DualRateCosts[Fraction]:
    return DualRateCosts(*map(Fraction, (50, 50, 20, 10, 0, lr_update)))


@pytest.mark.parametrize(
    ("lr_update", "lands", "misses"), [(55, 3, 0), (51, 3, 0), (50, 2, 50), (21, 2, 50), (20, 1, 0), (0, 1, 0)]
)
def test_a_correction_that_lands_earlier_lands_beside_the_task(lr_update: int, lands: int, misses: int) -> None:
    """By hand: 130 are left for LR jobs by step 3, 105 by step 2 but 25 of the task; with 70 and 25 step 2 is late."""
    schedule = simulate(costs(lr_update), TIMING, 80, 50, Options(), [TASK])
    assert (schedule.achieved, schedule.responses["hr"].misses) == ({lands: 50}, misses)


def test_the_counterexample_is_found_and_fails() -> None:
    found = less_work(costs(54), TIMING, 80, Options(), [TASK])
    assert found.holds is False
    assert isinstance(found.costs, DualRateCosts)
    assert 20 < found.costs.lr_update <= 50
    assert simulate(found.costs, TIMING, 80, 50, Options(), found.tasks).misses > 0


def test_a_least_speed_with_a_task_is_not_that_of_less_work() -> None:
    least = least_speed(costs(54), TIMING, Options(), [TASK]).speed
    assert least == Fraction(309, 4)
    assert enough_for_less(costs(54), TIMING, Options(), [TASK], least) == 95  # HR job, HR update and task in one step
    assert less_work(costs(54), TIMING, 95, Options(), [TASK]).holds


def test_what_does_not_hold_for_the_costs_needs_no_less() -> None:
    assert less_work(costs(54), TIMING, 94, Options(), [TASK]) == (False, costs(54), (TASK,), 0)


def test_what_is_not_found_is_not_proven() -> None:
    found = less_work(costs(54), TIMING, 200, Options(feedback="same-step"), [TASK])
    assert found == (None, None, (), TRIES)


def test_alone_it_may_land_in_the_restart() -> None:
    """Which is the longest HR job: 100 and 20 are due in one step; least speed is that of a landing in another."""
    restart = replace(costs(54), hr_restart=Fraction(100))
    least = least_speed(restart, TIMING).speed
    assert least < 120
    assert less_work(restart, TIMING, least).holds is False
    assert enough_for_less(restart, TIMING, Options(), (), least) == 120


def test_a_job_that_is_not_preempted_may_begin_where_another_ends_early() -> None:
    """In periods of 10: the LR job takes all that the first HR job leaves, and the driver of 8 begins at 14. With less
    it begins in the first step, and the second HR job, of 4, ends after 20."""
    driver = Task("driver", Fraction(4), Fraction(8), 30, Fraction(1, 2), preemptive=False)
    work, of = MultirateCosts(Fraction(4), Fraction(6)), Timing(2, 0, 2)
    assert simulate(work, of, 10, 50, Options(), [driver]).misses == 0
    assert simulate(replace(work, covariance_gain=Fraction(5)), of, 10, 50, Options(), [driver]).misses > 0
    assert less_work(work, of, 10, Options(), [driver]).holds is False
    assert less_work(work, of, 10, Options(), [replace(driver, preemptive=True)]).holds


def test_less_of_a_step_is_not_more_of_its_products() -> None:
    """Ten are on their way, so that a step takes 10 and nine times 2; its task 4. Less in all never misses 34."""
    work = LarsenInFlightCosts(*map(Fraction, (10, 12, 0, 0, 1, 0)))
    options, task = Options(context_switch=Fraction(1, 100)), Task("task", Fraction(1), Fraction(4), 20, Fraction(0))
    assert less_work(work, Timing(1, 10, 10), 34, options, [task]) == (None, None, (), TRIES)


@contextmanager
def shorter(random: Random, share: float) -> Iterator[None]:
    """So large a share of all jobs take less than their cost, each another part of it."""
    made = Job.__init__

    def make(self: Job, kind: str, step: int, priority: int, release: int, due: int, work: int, *more: Any) -> None:
        work = random.randint(0, work) if random.random() < share else work
        made(self, kind, step, priority, release, due, work, (("less", work),), *more[1:])

    with patch.object(Job, "__init__", make):
        yield


@st.composite
def asked(draw: st.DrawFn) -> tuple[Design, list[Task]]:
    if draw(st.booleans()):
        design, tasks = draw(loaded_designs())
        tasks = [replace(task, offset=draw(st.sampled_from([task.offset, "any"]))) for task in tasks]
        return design._replace(options=replace(design.options, context_switch=Fraction(0))), tasks
    design = draw(designs | designs_in_flight())
    switch = draw(st.sampled_from([Fraction(0), Fraction(3)]))
    return design._replace(options=replace(design.options, context_switch=switch)), []


@given(asked(), st.sampled_from([Fraction(1), Fraction(11, 10), Fraction(3, 2)]), st.integers(0, 2**31))
def test_what_is_said_to_hold_holds(drawn: tuple[Design, list[Task]], more: Fraction, seed: int) -> None:
    """At the least speed, above it, and at that which is enough, whatever each job takes and the phases are."""
    (of_ticks, timing, options), tasks = drawn
    random = Random(seed)
    work = type(of_ticks)(*map(Fraction, works(of_ticks)))
    least = least_speed(work, timing, options, tasks).speed
    speeds = [enough_for_less(work, timing, options, tasks, least)]
    if less_work(work, timing, least * more, options, tasks, tries=2).holds:
        speeds.append(least * more)
    for speed in filter(None, speeds):
        for share in (0.2, 1.0):
            beside = [
                replace(task, offset=task.period * random.randint(0, 8) / 8 if task.offset == "any" else task.offset)
                for task in tasks
            ]
            with shorter(random, share):
                assert simulate(work, timing, speed, 8, options, beside).misses == 0
