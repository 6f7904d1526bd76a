"""A composed filter on the processor, against what is known of it from elsewhere: the single-filter simulation and
probability."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import product
from math import sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.design.pieces import JobCosts, LarsenCosts, RecalculateCosts, StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Late, Scenario
from sched_sim.schedule.tasks import Task
from tests.scenarios import BY_HAND, HR, LR, scenario, sensor


def near(share: float, probability: float, count: int) -> bool:
    """Within 4.5 standard deviations of so many independent trials."""
    return abs(share - probability) <= 4.5 * sqrt(probability * (1 - probability) / count)


# ------------------------------------------------------------------------------- one sensor is the single filter

CONTROL = Task("control", period=Fraction(3), cost=Fraction("0.1"), priority=5, offset=Fraction(0))


def assert_same(
    single: JobCosts, M: int, speed: str, late: Late, entries: dict[str, Any], more: Fraction = Fraction(0)
) -> None:
    """There, predict and correction of step m are one job, and it is the correction that ends it. more: work that the
    composed filter has to do in each cycle."""
    N, cycles = 10, 20
    expected = simulate(single, Timing(N, M, N), Fraction(speed), cycles, tasks=[CONTROL])
    steps = cycles * N + (M == N)  # the last measurement arrives when the others would end
    gps = sensor("gps", N, M, priority=HR, land_by=M)
    found = run_scenario(scenario(speed, entries, gps, late=late, steps=steps, tasks=[CONTROL]))
    longest = max(*found.jobs["predict"].responses, *found.jobs["correct gps"].responses)
    assert found.sensors["gps"].achieved == expected.achieved
    assert longest == expected.responses["hr"].worst / expected.period
    assert max(found.jobs["task:control"].responses) == expected.responses["task:control"].worst / expected.period
    assert found.schedule.utilization == expected.utilization + more * cycles / (steps * Fraction(speed))
    assert (found.misses == 0) == (expected.misses == 0)


@pytest.mark.parametrize("speed", ["0.9", "1.3", "4"])
@pytest.mark.parametrize("M", [0, 1, 4, 10])
def test_recalculate_at_the_predictors_priority_is_recalculate(M: int, speed: str) -> None:
    """Most of these overrun: 4 replayed steps take 2 at a speed of 0.9."""
    single = RecalculateCosts(Fraction("0.5"), Fraction("0.7"), Fraction("0.5"))
    assert_same(single, M, speed, "recalculate", {"predict": 0.5, "correct.gps": 0.7})


@pytest.mark.parametrize("speed", ["1.7", "1.8", "4"])
@pytest.mark.parametrize(("M", "accumulate"), [(1, "0.5"), (4, "0.7"), (10, "0.7")])
def test_larsen_at_the_predictors_priority_is_larsen(M: int, accumulate: str, speed: str) -> None:
    """The single filter has nothing to multiply in step k + 1: there the product is the transition itself."""
    single = LarsenCosts(Fraction("0.5"), Fraction(accumulate), Fraction("0.9"))
    entries = {"predict": 0.5, "predict_accumulate": accumulate, "correct_late.gps": 0.9}
    assert_same(single, M, speed, "larsen", entries, single.accumulate - single.propagate)


def test_a_task_may_begin_within_a_step() -> None:
    """Released at 10/3 of a period of 10, behind a predict job of 4 it ends at 5."""
    task = Task("control", Fraction(2), Fraction(1), priority=30, offset=Fraction(1, 3))
    found = run_scenario(scenario(10, BY_HAND, sensor("gps", 20, offset=2), steps=2, tasks=[task]))
    assert found.jobs["task:control"].responses == [pytest.approx((5 - 10 / 3) / 10)]


@pytest.mark.parametrize("late", ["recalculate", "larsen"])
def test_without_delay_both_are_the_standard_filter(late: Late) -> None:
    single = StandardCosts(Fraction("0.5"), Fraction("0.7"))
    assert_same(single, 0, "1.3", late, {"predict": 0.5, "correct.gps": 0.7})


# ------------------------------------------------------------------------------- probability


def test_the_probability_of_a_miss_is_that_of_the_sum_of_two_draws() -> None:
    """Predict and correction take longer than 8 in 3 of the 9 pairs; an overrun is over in the next step."""
    predict, correct = [2, 3, 5], [3, 4, 6]
    exact = sum(sum(pair) > 8 for pair in product(predict, correct)) / 9
    gps = sensor("gps", 2, priority=HR, land_by=0, dropout=0.25)
    found = run_scenario(scenario(8, {"predict": predict, "correct.gps": correct}, gps, steps=6_000))
    figures = found.jobs["correct gps"]
    assert figures.decided == found.sensors["gps"].arrived
    assert figures.miss_probability == figures.misses / figures.decided
    assert near(figures.misses / figures.decided, exact, figures.decided)
    least, most = figures.miss_interval or (1, 0)
    assert least < exact < most
    sums = Counter(sum(pair) for pair in product(predict, correct))
    responses = Counter(round(8 * response) for response in figures.responses)
    assert responses.keys() == sums.keys()
    assert all(near(responses[total] / figures.decided, count / 9, figures.decided) for total, count in sums.items())
    assert found.jobs["predict"].misses == 0


@pytest.mark.parametrize("priority", [HR, LR])
def test_on_a_fast_processor_the_achieved_l_is_the_delay(priority: int) -> None:
    entries = {"predict": [1, 2], "correct.gps": 1}
    gps = sensor("gps", 2, [3, 3, 4, 6], priority=priority)
    found = run_scenario(scenario(1000, entries, gps, steps=4_000))
    assert found.schedule.responses["correct gps"].worst_lateness == 0
    achieved = found.sensors["gps"].achieved
    total = achieved.total()
    assert achieved.keys() == {3, 4, 6}
    assert near(achieved[3] / total, 1 / 2, total)
    assert near(achieved[4] / total, 1 / 4, total)


@pytest.mark.parametrize(("dropout", "arrived"), [(0.0, 100), (1.0, 0)])
def test_dropout_of_all_or_nothing(dropout: float, arrived: int) -> None:
    gps = sensor("gps", 4, dropout=dropout)
    found = run_scenario(scenario(10, {"predict": 1, "correct.gps": 1}, gps, steps=400))
    figures = found.sensors["gps"]
    assert (figures.taken, figures.dropped, figures.arrived) == (100, 100 - arrived, arrived)
    assert figures.on_the_way == 0
    assert found.jobs["correct gps"].released == arrived
    assert found.jobs["correct gps"].miss_probability is None  # none missed, or none was there to
    assert found.jobs["correct gps"].miss_interval == ((0.0, 3 / 100) if arrived else None)


def test_dropout_is_a_probability() -> None:
    gps = sensor("gps", 1, dropout=0.8)
    figures = run_scenario(scenario(10, {"predict": 1, "correct.gps": 1}, gps, steps=4000)).sensors["gps"]
    assert near(figures.dropped / figures.taken, 0.8, figures.taken)


RANDOM = {"predict": [1, 2, 3], "correct.gps": [2, 3], "correct.imu": [1, 2]}


def random_scenario(seed: int, gps_dropout: float = 0.2) -> Scenario:
    gps, imu = sensor("gps", 10, range(2, 8), dropout=gps_dropout), sensor("imu", 3, [0, 1], dropout=0.5)
    return scenario(10, RANDOM, gps, imu, steps=400, seed=seed)


def figures(of: Outcome) -> object:
    return [(kind, list(jobs.responses)) for kind, jobs in of.jobs.items()], of.sensors


def test_the_seed_decides_everything() -> None:
    assert figures(run_scenario(random_scenario(3))) == figures(run_scenario(random_scenario(3)))
    assert figures(run_scenario(random_scenario(3))) != figures(run_scenario(random_scenario(4)))


def test_the_dropout_of_one_sensor_changes_no_draw_of_the_others() -> None:
    """Without gps corrections in the way, all else takes as long as with them, if more urgent."""
    some, none = (run_scenario(random_scenario(3, dropout)) for dropout in (0.2, 1.0))
    assert some.jobs["predict"].responses == none.jobs["predict"].responses
    assert some.sensors["imu"].taken == none.sensors["imu"].taken
    assert some.sensors["imu"].dropped == none.sensors["imu"].dropped
    assert some.jobs["correct imu"].released == none.jobs["correct imu"].released


# ------------------------------------------------------------------------------- deadlines


@given(
    speed=st.integers(5, 14),
    delays=st.lists(st.integers(0, 6), min_size=1, max_size=3),
    more=st.integers(0, 4),
    priority=st.sampled_from([HR, LR]),
    late=st.sampled_from(["recalculate", "larsen"]),
)
@settings(max_examples=60, deadline=None)
def test_a_correction_has_met_its_deadline_exactly_if_it_lands_in_step_land_by_or_before(
    speed: int, delays: list[int], more: int, priority: int, late: Late
) -> None:
    land_by = min(delays) + more
    gps, imu = sensor("gps", 7, delays, priority=priority, land_by=land_by), sensor("imu", 3)
    entries = {"predict": [1, 3], "correct.gps": [2, 4], "correct.imu": 1}
    larsens = {"predict_accumulate": [2, 3], "correct_late.gps": [2, 5], "correct_accumulate.imu": 2}
    found = run_scenario(scenario(speed, entries | larsens, gps, imu, late=late, steps=60))
    achieved, jobs = found.sensors["gps"].achieved, found.jobs["correct gps"]
    waiting = jobs.decided - len(jobs.responses)  # not landed, although due
    assert jobs.misses - waiting == sum(count for step, count in achieved.items() if step > land_by)


def test_progress_is_told_and_changes_nothing() -> None:
    told: list[tuple[int, int, str]] = []
    of = random_scenario(3)
    found = run_scenario(of, on_progress=lambda *progress: told.append(progress))
    assert figures(found) == figures(run_scenario(of))
    assert told == [(step, 400, "HR steps") for step in range(0, 400, 4)]
