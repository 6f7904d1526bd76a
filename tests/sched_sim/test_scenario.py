"""A composed filter on the processor, against what is known of it from elsewhere: the single-filter simulation,
probability, and schedules worked out by hand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import sqrt
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.costs import JobCosts, LarsenCosts, RecalculateCosts, StandardCosts
from sched_sim.errors import InputError
from sched_sim.scenario import Late, Scenario, Sensor
from sched_sim.scenario_run import Outcome, run_scenario
from sched_sim.simulate import simulate
from sched_sim.tasks import Task
from sched_sim.timing import Timing
from tests.scenarios import BY_HAND, HR, LR, scenario, sensor, slices_of


def near(share: float, probability: float, count: int) -> bool:
    """Within 4.5 standard deviations of so many independent trials."""
    return abs(share - probability) <= 4.5 * sqrt(probability * (1 - probability) / count)


# ------------------------------------------------------------------------------- one sensor is the single filter

CONTROL = Task("control", period=Fraction(3), cost=Fraction("0.1"), priority=5)


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
    achieved = run_scenario(scenario(1000, entries, gps, steps=4_000)).sensors["gps"].achieved
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
    assert found.jobs["correct gps"].released == arrived
    assert (found.jobs["correct gps"].miss_probability is None) == (arrived == 0)


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


# ------------------------------------------------------------------------------- worked out by hand


def test_a_preempted_correction_catches_up_with_the_steps_that_passed() -> None:
    """It arrives at 20, and has the correction and steps 1 and 2 to do: 10. It finishes them in step 3, then step 3
    itself in step 4, then step 4 exactly at its end."""
    gps = sensor("gps", 20, 2)
    of = scenario(10, BY_HAND, gps, steps=8)
    assert slices_of(of, "correct gps") == [(24, 30), (34, 38), (38, 40), (44, 46), (46, 50)]
    found = run_scenario(of)
    assert found.sensors["gps"].achieved == {4: 1}
    assert found.jobs["correct gps"].responses == [3.0]
    assert found.jobs["correct gps"].released == 1
    assert found.schedule.responses["correct gps"].finished == 1


def test_it_catches_up_with_the_corrections_made_meanwhile_too() -> None:
    """The other sensor's correction in step 3 is 1 more to replay, and that is a step more in the end."""
    gps, imu = sensor("gps", 20, 2), sensor("imu", 20, offset=3, priority=HR)
    of = scenario(10, BY_HAND, gps, imu, steps=8)
    assert slices_of(of, "correct gps") == [(24, 30), (35, 39), (39, 40), (44, 48), (48, 50), (54, 56), (56, 60)]
    assert run_scenario(of).sensors["gps"].achieved == {5: 1}


def test_an_older_measurement_that_comes_in_between_takes_the_correction_back_to_it() -> None:
    """The gps is of step 5, and of 10 ticks 8 are done when the camera's of step 3 arrives at 70, which lands at 81. At
    85 the gps is through with step 6; it goes back to step 3, for both corrections and steps 4 to 8: 19. Then steps 9
    and 10, then 11."""
    gps = sensor("gps", 100, 1, offset=5)
    camera = sensor("camera", 100, 4, offset=3, priority=HR)
    of = scenario(10, {"predict": 2, "correct.gps": 8, "correct.camera": 1}, gps, camera, steps=14)
    assert slices_of(of, "correct camera") == [(72, 81)]
    expected = [(62, 70), (83, 85), (85, 90), (92, 100), (102, 108), (108, 110), (112, 114), (114, 116)]
    assert slices_of(of, "correct gps") == expected
    assert run_scenario(of).sensors["gps"].achieved == {6: 1}


def test_a_late_correction_replays_what_other_sensors_saw_in_those_steps() -> None:
    """At 40: the correction of step 1, 2; steps 2 to 4, 12; the other sensor's of step 2, which landed in step 3."""
    gps, imu = sensor("gps", 100, 3, offset=1, priority=HR), sensor("imu", 100, 1, offset=2, priority=HR)
    of = scenario(30, BY_HAND, gps, imu, steps=6)
    assert slices_of(of, "correct gps") == [(124, 124 + 2 + 12 + 1)]


def test_a_more_urgent_correction_of_the_same_instant_is_replayed_without_catching_up() -> None:
    """Both arrive at 60, gps of step 0 and imu of step 2: the imu, 4 behind the predict, is 1 to replay for the gps."""
    gps, imu = sensor("gps", 100, 2), sensor("imu", 100, offset=2, priority=HR)
    of = scenario(30, BY_HAND, gps, imu, steps=4)
    assert slices_of(of, "correct gps") == [(65, 65 + 2 + 8 + 1)]


@pytest.mark.parametrize("priority", [HR, LR])
def test_late_corrections_of_one_step_and_priority_roll_back_once_and_land_together(priority: int) -> None:
    """Both arrive at 60, behind the predict: 2 + 1 for both, steps 1 and 2. The imu's is of step 1, due at 60."""
    gps = sensor("gps", 100, 2, priority=priority)
    imu = sensor("imu", 100, 1, offset=1, priority=priority, land_by=1)
    of = scenario(30, BY_HAND, gps, imu, steps=4)
    assert slices_of(of, "correct gps") == [(64, 64 + 2 + 1 + 8)]
    assert slices_of(of, "correct imu") == []
    found = run_scenario(of)
    assert found.jobs["correct gps"].responses == found.jobs["correct imu"].responses == [15 / 30]
    assert (found.sensors["gps"].achieved, found.sensors["imu"].achieved) == ({2: 1}, {1: 1})
    assert found.misses == 0


def test_each_of_those_that_land_together_has_its_own_deadline_and_l() -> None:
    """At 20 there are 3 + 8 to do in 6 a step, until 39; step 3 until 47, step 4 until 55, step 5 until 59."""
    gps, imu = sensor("gps", 100, 2, land_by=4), sensor("imu", 100, 1, offset=1, land_by=4)
    found = run_scenario(scenario(10, BY_HAND, gps, imu, steps=8))
    assert (found.sensors["gps"].achieved, found.sensors["imu"].achieved) == ({5: 1}, {4: 1})
    assert found.jobs["correct gps"].responses == found.jobs["correct imu"].responses == [3.9]
    assert (found.jobs["correct gps"].misses, found.jobs["correct imu"].misses) == (1, 0)
    assert found.first_miss == 5.0


def test_corrections_of_one_priority_run_one_after_another_and_wait_from_their_arrival() -> None:
    """Both arrive at 60; the second is not late and replays nothing."""
    gps, imu = sensor("gps", 100, 2), sensor("imu", 100, offset=2)
    of = scenario(30, BY_HAND, gps, imu, steps=4)
    assert slices_of(of, "correct gps") == [(64, 74)]
    assert slices_of(of, "correct imu") == [(74, 75)]
    assert run_scenario(of).jobs["correct imu"].responses == [15 / 30]


def test_going_back_to_a_step_repeats_its_other_corrections() -> None:
    """The imu's is of step 0 too, and landed there: at 60 it is corrected again, with the gps; then steps 1 and 2."""
    gps, imu = sensor("gps", 100, 2, priority=HR), sensor("imu", 100, priority=HR)
    of = scenario(30, BY_HAND, gps, imu, steps=4)
    assert slices_of(of, "correct gps") == [(64, 64 + 2 + 1 + 8)]


def test_catching_up_is_no_context_switch_unless_something_runs_in_between() -> None:
    """A switch takes 1. From 29, behind the predict, 6 of 10; from 41 the other 4, and at once 2 of step 3 until 48;
    from 53 the other 2, and at once step 4 until it ends."""
    of = scenario(12, BY_HAND, sensor("gps", 20, 2), steps=8, context_switch=Fraction(1))
    assert slices_of(of, "correct gps") == [(29, 36), (41, 46), (46, 48), (53, 56), (56, 60)]
    assert run_scenario(of).sensors["gps"].achieved == {4: 1}


def test_corrections_that_waited_go_back_together_and_land_together() -> None:
    """The gps lands at 50, as above. Those of steps 3 and 4 waited: 2 for both, steps 4 and 5, then 6, then 7, until
    80."""
    gps, imu = sensor("gps", 20, 2), sensor("imu", 1, offset=3)
    of = scenario(10, BY_HAND, gps, imu, steps=8)
    assert slices_of(of, "correct imu") == [(54, 60), (64, 68), (68, 70), (74, 76), (76, 80)]
    found = run_scenario(of)
    assert found.sensors["imu"].achieved == {4: 1, 3: 1}
    assert found.jobs["correct imu"].responses == [5.0, 4.0]
    assert found.sensors["imu"].not_landed == 3
    assert (found.jobs["correct imu"].misses, found.first_miss) == (5, 4.0)


def test_a_processor_without_the_time_never_catches_up_and_drops_nothing() -> None:
    """4 ticks of each 10 are left, and each step that passes is 6 more to replay."""
    gps = sensor("gps", 10, 2, land_by=4)
    found = run_scenario(scenario(10, {"predict": 6, "correct.gps": 2}, gps, steps=50))
    figures, jobs = found.sensors["gps"], found.jobs["correct gps"]
    assert (figures.arrived, figures.achieved, figures.not_landed) == (5, {}, 5)
    assert (jobs.released, jobs.misses, jobs.decided, list(jobs.responses)) == (5, 5, 5, [])
    assert found.schedule.responses["correct gps"].worst_lateness == 450
    assert found.first_miss == 5.0
    assert found.schedule.utilization == 1 - Fraction(2 * 4, 500)  # idle until the first arrives


def test_what_has_not_arrived_or_is_not_yet_due_is_no_miss() -> None:
    gps = sensor("gps", 10, 9)
    found = run_scenario(scenario(10, {"predict": 6, "correct.gps": 2}, gps, steps=25))
    figures, jobs = found.sensors["gps"], found.jobs["correct gps"]
    assert (figures.taken, figures.arrived, figures.on_the_way) == (3, 2, 1)
    assert (jobs.released, jobs.misses, jobs.decided) == (2, 1, 1)  # due at 19 and 29


def test_larsen_lands_late_without_replay() -> None:
    """At 20, behind predict and accumulate, 6 of 8 run until 30; the rest in step 3."""
    entries = {"predict": 3, "predict_accumulate": 4, "correct_late.gps": 8}
    of = scenario(10, entries, sensor("gps", 20, 2), late="larsen", steps=6)
    assert slices_of(of, "correct gps") == [(24, 30), (34, 36)]
    assert run_scenario(of).sensors["gps"].achieved == {3: 1}
    assert slices_of(of, "predict") == [(0, 3), (10, 14), (20, 24), (30, 34), (40, 43), (50, 53)]


def test_larsen_accumulates_for_a_lost_measurement_until_the_next_is_taken() -> None:
    """From step 1 on there is always one that it waits for; in step 0 none is taken yet."""
    entries = {"predict": 3, "predict_accumulate": 4, "correct_late.gps": 8}
    of = scenario(10, entries, sensor("gps", 4, 2, dropout=1.0), late="larsen", steps=9)
    assert [end - start for start, end in slices_of(of, "predict")] == [3, *[4] * 8]


@pytest.mark.parametrize(("priority", "imu_works"), [(HR, [1, 2, 1, 1]), (LR, [1, 2, 2, 1])])
def test_larsen_other_sensors_accumulate_while_a_measurement_is_in_flight(priority: int, imu_works: list[int]) -> None:
    """The gps of step 0 arrives in step 2; if as urgent as the imu, it lands there before the imu's correction."""
    entries = {"predict": 1, "predict_accumulate": 1, "correct.imu": 1, "correct_accumulate.imu": 2}
    imu, gps = sensor("imu", 1, priority=HR), sensor("gps", 4, 2, priority=priority)
    of = scenario(10, entries | {"correct_late.gps": 3}, imu, gps, late="larsen", steps=4)
    assert [end - start for start, end in slices_of(of, "correct imu")] == imu_works
    assert slices_of(of, "correct gps") == ([(21, 24)] if priority == HR else [(23, 26)])


def test_larsen_a_delay_as_long_as_the_time_between_measurements_is_one_flight_after_another() -> None:
    entries = {"predict": 3, "predict_accumulate": 4, "correct_late.gps": 1}
    of = scenario(10, entries, sensor("gps", 2, 2), late="larsen", steps=7)
    assert [end - start for start, end in slices_of(of, "predict")] == [3, *[4] * 6]
    assert run_scenario(of).sensors["gps"].achieved == {2: 3}


def test_larsen_one_that_lands_after_the_next_was_taken_costs_no_second_product() -> None:
    """The gps of step 0 arrives at 20 and lands in step 4, when that of step 3 is already on its way."""
    entries = {"predict": 3, "predict_accumulate": 4, "correct_late.gps": 14}
    of = scenario(10, entries, sensor("gps", 3, 2), late="larsen", steps=9)
    assert [end - start for start, end in slices_of(of, "predict")] == [3, *[4] * 8]
    assert slices_of(of, "correct gps")[:3] == [(24, 30), (34, 40), (44, 46)]


def test_larsen_does_not_wait_for_a_lost_measurement_while_another_is_in_flight() -> None:
    """The gps of step 0 lands in step 4; what the camera took in step 1, and lost, is not waited for then."""
    entries = {"predict": 3, "predict_accumulate": 4, "correct_late.gps": 1, "correct_late.camera": 1}
    gps, camera = sensor("gps", 100, 4), sensor("camera", 100, 2, offset=1, dropout=1.0)
    of = scenario(10, entries, gps, camera, late="larsen", steps=8)
    assert [end - start for start, end in slices_of(of, "predict")] == [3, 4, 4, 4, 4, 3, 3, 3]


def test_on_two_processors_corrections_run_beside_the_predictor() -> None:
    """10 of work from 20 on, whatever the priority: it ends with step 2."""
    of = scenario(10, BY_HAND, sensor("gps", 20, 2, priority=HR), cpus=2, steps=8)
    assert slices_of(of, "correct gps") == [(20, 30)]
    found = run_scenario(of)
    assert found.sensors["gps"].achieved == {2: 1}
    assert set(found.jobs["predict"].responses) == {0.4}


def test_progress_is_told_and_changes_nothing() -> None:
    told: list[tuple[int, int, str]] = []
    of = random_scenario(3)
    found = run_scenario(of, on_progress=lambda *progress: told.append(progress))
    assert figures(found) == figures(run_scenario(of))
    assert told == [(step, 400, "HR steps") for step in range(0, 400, 4)]


# ------------------------------------------------------------------------------- what cannot be


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"every": 0}, "every 0 must be at least 1"),
        ({"offset": -1}, "offset -1 must be 0 or more"),
        ({"dropout": 1.2}, "dropout 1.2 must be from 0 to 1: it is a probability"),
        ({"delays": (-3,)}, "delay -3 must be 0 or more"),
        ({"delays": ()}, "delay has nothing to draw from"),
        ({"land_by": 3}, "land_by 3 must not be less than the least delay 4"),
    ],
)
def test_a_sensor_that_cannot_be_is_refused_by_name(settings: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=f"sensor 'gps': .*{said}"):
        Sensor(**({"name": "gps", "every": 10, "delays": (4,), "land_by": 10} | settings))


def test_two_sensors_of_one_name_are_refused() -> None:
    with pytest.raises(InputError, match="sensor 'gps' is there 2 times: give each its own name"):
        scenario(10, BY_HAND, sensor("gps", 20), sensor("gps", 10), steps=8)


def test_all_that_is_wrong_is_said_at_once() -> None:
    fine = scenario(10, BY_HAND, sensor("gps", 20, 2), steps=8)
    with pytest.raises(
        InputError, match=r"steps 0 must.*speed 0 must.*no costs of correct\.radar: give sensor 'radar' a"
    ):
        replace(fine, steps=0, speed=Fraction(0), sensors=[sensor("radar", 20, 2)])


@pytest.mark.parametrize("delays", [range(10**10), [0, 10**30]])
def test_a_scenario_of_more_steps_than_anyone_waits_for_is_refused_at_once(delays: Sequence[int]) -> None:
    with pytest.raises(
        InputError, match=r"sensor 'gps': delay (9999999999|10{30}) is above 10,000,000 HR steps: give fewer"
    ):
        Sensor("gps", 10, delays, land_by=10)
    with pytest.raises(InputError, match="steps 99999999999 is above 10,000,000: simulate fewer HR steps"):
        scenario(10, BY_HAND, sensor("gps", 20), steps=99999999999)


def test_larsen_needs_costs_of_its_own() -> None:
    said = r'no costs of predict_accumulate, correct_late\.gps: late = "larsen" needs linear or extended parts'
    with pytest.raises(InputError, match=said):
        scenario(10, BY_HAND, sensor("gps", 20, 2), steps=8, late="larsen")
