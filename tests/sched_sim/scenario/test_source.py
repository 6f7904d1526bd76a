"""A composed filter on the processor, against schedules worked out by hand."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import count

import pytest

from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Late, Scenario
from sched_sim.scenario.source import ComposedFilter, Measurement
from tests.scenarios import BY_HAND, HR, LR, scenario, sensor, slices_of


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


def test_it_goes_back_to_that_step_and_no_further() -> None:
    """As above, with one of the imu's in the step before: what it corrected is in the prediction of step 3."""
    gps, imu = sensor("gps", 100, 1, offset=5), sensor("imu", 100, offset=2, priority=HR)
    camera = sensor("camera", 100, 4, offset=3, priority=HR)
    entries = {"predict": 2, "correct.gps": 8, "correct.camera": 1, "correct.imu": 1}
    of = scenario(10, entries, gps, camera, imu, steps=14)
    expected = [(62, 70), (83, 85), (85, 90), (92, 100), (102, 108), (108, 110), (112, 114), (114, 116)]
    assert slices_of(of, "correct gps") == expected


def test_one_of_its_own_step_that_comes_in_between_has_it_corrected_once_more() -> None:
    """Both are of step 5. At 79 the gps is through with step 6, and the camera's has landed at 77: 8 + 1 for both and
    steps 6 and 7, 4; then steps 8 and 9."""
    gps, camera = sensor("gps", 100, 1, offset=5), sensor("camera", 100, 2, offset=5, priority=HR)
    of = scenario(10, {"predict": 2, "correct.gps": 8, "correct.camera": 1}, gps, camera, steps=14)
    assert slices_of(of, "correct camera") == [(72, 77)]
    assert slices_of(of, "correct gps") == [(62, 70), (77, 79), (79, 80), (82, 90), (92, 96), (96, 100)]


def test_what_is_done_again_goes_by_the_steps_corrected_not_by_the_order_of_landing() -> None:
    """The imu's of step 4 landed in it, then the gps's of step 3, in step 6. The camera's of step 4 comes in step 8: 1,
    steps 5 to 8, 16, and the imu's, 1."""
    gps, imu = sensor("gps", 100, 3, offset=3, priority=HR), sensor("imu", 100, offset=4, priority=HR)
    camera = sensor("camera", 100, 4, offset=4, priority=HR)
    of = scenario(30, BY_HAND | {"correct.camera": 1}, gps, imu, camera, steps=10)
    assert slices_of(of, "correct gps") == [(184, 184 + 2 + 12 + 1)]
    assert slices_of(of, "correct camera") == [(244, 244 + 1 + 16 + 1)]


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


def test_larsen_one_that_is_not_late_for_once_is_not_in_flight_in_its_own_step() -> None:
    """It lands behind the more urgent imu of its step, and what the imu corrects is not carried anywhere."""
    entries = {
        "predict": 1,
        "predict_accumulate": 1,
        "correct.imu": 1,
        "correct_accumulate.imu": 2,
        "correct_late.gps": 3,
    }
    imu, gps = sensor("imu", 1, priority=HR), sensor("gps", 4, [0, 2])
    seed = next(seed for seed in count() if [*gps.measurements(1, seed)] == [(0, 0)])
    of = scenario(10, entries, imu, gps, late="larsen", steps=1, seed=seed)
    assert slices_of(of, "correct imu") == [(1, 2)]
    assert slices_of(of, "correct gps") == [(2, 5)]


def test_larsen_a_delay_as_long_as_the_time_between_measurements_is_one_flight_after_another() -> None:
    entries = {"predict": 3, "predict_accumulate": 4, "correct_late.gps": 1}
    of = scenario(10, entries, sensor("gps", 2, 2), late="larsen", steps=7)
    assert [end - start for start, end in slices_of(of, "predict")] == [3, *[4] * 6]
    assert run_scenario(of).sensors["gps"].achieved == {2: 3}


def test_larsen_a_late_one_is_done_again_in_the_step_in_which_it_landed() -> None:
    """The gps's of step 1 lands in step 5, after the baro's of step 3. The imu's of step 4 takes until 63: it has steps
    5 and 6 to do, 2, and the gps's, 3."""
    entries = {
        "predict": 1,
        "predict_accumulate": 2,
        "correct.baro": 1,
        "correct_accumulate.baro": 1,
        "correct.imu": 15,
        "correct_accumulate.imu": 15,
        "correct_late.gps": 3,
    }
    gps, baro = sensor("gps", 100, 4, offset=1, priority=HR), sensor("baro", 100, offset=3, priority=HR)
    of = scenario(10, entries, gps, baro, sensor("imu", 100, offset=4), late="larsen", steps=10)
    assert slices_of(of, "correct gps") == [(52, 55)]
    assert slices_of(of, "correct imu") == [(42, 50), (55, 60), (61, 63), (63, 63 + 2 + 3)]


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


CARRIED = {"predict": 3, "correct.gps": 2, "carry.gps": 1, "beside.gps": 1, "land.gps": 2}
CARRIED |= {"correct.imu": 1, "beside.imu": 2}
PRODUCTS = {"carry_product": 1} | {
    part.replace(".", "_product."): work for part, work in CARRIED.items() if "." in part
}


def works_of(of: Scenario, kind: str) -> list[int]:
    """Of what ran in one piece each."""
    return [end - start for start, end in slices_of(of, kind)]


def test_carried_gain_the_covariance_is_corrected_in_its_step_and_the_estimate_on_arrival() -> None:
    """The predict job of step 0 corrects, those of steps 1 and 2 carry, and behind the latter it lands."""
    of = scenario(10, CARRIED, sensor("gps", 20, 2), late="carried-gain", steps=5)
    assert slices_of(of, "predict") == [(0, 5), (10, 14), (20, 24), (30, 33), (40, 43)]
    assert slices_of(of, "correct gps") == [(24, 26)]
    assert run_scenario(of).sensors["gps"].achieved == {2: 1}


@pytest.mark.parametrize(("late", "costs"), [("carried-gain", CARRIED), ("larsen", CARRIED | PRODUCTS)])
def test_several_in_flight_are_each_carried_and_each_beside_a_correction(late: Late, costs: dict[str, int]) -> None:
    """Taken in every second step and 5 late: at the starts of the steps 0, 1, 1, 2, 2, 3, 2, 3, 2 are in flight."""
    of = scenario(20, costs, sensor("gps", 2, 5), late=late, steps=9)
    jobs = run_scenario(of).schedule
    pieces = slices_of(of, "predict")
    busy = [sum(end - start for start, end in pieces if start // 20 == step) for step in range(9)]
    flying = [0, 1, 1, 2, 2, 3, 2, 3, 2]
    assert busy == [3 + n + (2 + n if step % 2 == 0 else 0) for step, n in enumerate(flying)]
    assert works_of(of, "correct gps") == [2, 2]
    assert jobs.misses == 0


@pytest.mark.parametrize(("priority", "at_m"), [(HR - 1, 3 + 2), (HR, 3 + 1 + 2 + 1)])
def test_one_that_lands_before_the_predict_job_is_in_flight_for_it_no_more(priority: int, at_m: int) -> None:
    """Taken in every fourth step and 4 late: in step 4 one lands, and the next is taken."""
    of = scenario(10, CARRIED, sensor("gps", 4, 4, priority=priority), late="carried-gain", steps=5)
    assert works_of(of, "predict") == [5, 4, 4, 4, at_m]
    assert slices_of(of, "correct gps") == [(40, 42) if priority < HR else (40 + at_m, 42 + at_m)]


def test_carried_gain_what_never_arrives_is_in_flight_as_long_as_the_longest_delay() -> None:
    of = scenario(10, CARRIED, sensor("gps", 20, [2, 4], dropout=1.0), late="carried-gain", steps=7)
    assert [end - start for start, end in slices_of(of, "predict")] == [5, 4, 4, 4, 4, 3, 3]


@pytest.mark.parametrize(("priority", "imu_works"), [(HR, [3, 3, 1, 1]), (LR, [3, 3, 3, 1])])
def test_carried_gain_others_do_their_part_with_what_is_in_flight(priority: int, imu_works: list[int]) -> None:
    """The gps of step 0 is taken before the imu's correction; in step 2, if as urgent, it lands before it."""
    imu, gps = sensor("imu", 1, priority=HR), sensor("gps", 4, 2, priority=priority)
    of = scenario(10, CARRIED, imu, gps, late="carried-gain", steps=4)
    assert works_of(of, "correct imu") == imu_works


def test_carried_gain_one_that_is_not_late_for_once_is_corrected_at_once() -> None:
    gps = sensor("gps", 4, [0, 2])
    seed = next(seed for seed in count() if [*gps.measurements(1, seed)] == [(0, 0)])
    of = scenario(10, CARRIED, gps, late="carried-gain", steps=1, seed=seed)
    assert (works_of(of, "predict"), works_of(of, "correct gps")) == ([3], [2])


def test_carried_gain_in_any_order_of_arrival_nothing_is_done_again() -> None:
    """The camera's of step 1 overtakes the gps's of step 0. Both are in flight in steps 2 and 3."""
    costs = CARRIED | {"correct.camera": 2, "carry.camera": 2, "beside.camera": 1, "land.camera": 1}
    gps, camera = sensor("gps", 100, 5), sensor("camera", 100, 2, offset=1)
    of = scenario(20, costs, gps, camera, late="carried-gain", steps=7)
    pieces = slices_of(of, "predict")
    busy = [sum(end - start for start, end in pieces if start // 20 == step) for step in range(7)]
    assert busy == [3 + 2, 3 + 1 + 2 + 1, 3 + 1 + 2, 3 + 1 + 2, 3 + 1, 3 + 1, 3]
    assert slices_of(of, "correct camera") == [(66, 67)]
    assert slices_of(of, "correct gps") == [(104, 106)]


def test_carried_gain_a_correction_that_catches_up_corrects_the_covariance_once_more() -> None:
    """The imu's of step 0 takes until 27, in step 2. It has steps 1 and 2 to do, and what the gps, taken in step 1,
    does to the covariance: 8. Then step 3, until 46, then step 4."""
    imu, gps = sensor("imu", 100), sensor("gps", 100, 8, offset=1)
    of = scenario(10, CARRIED | {"correct.imu": 15}, imu, gps, late="carried-gain", steps=9)
    assert slices_of(of, "correct imu") == [
        (3, 10),
        (15, 20),
        (24, 27),
        (27, 30),
        (34, 39),
        (39, 40),
        (44, 46),
        (46, 49),
    ]
    assert run_scenario(of).sensors["imu"].achieved == {4: 1}


def test_on_two_processors_corrections_run_beside_the_predictor() -> None:
    """10 of work from 20 on, whatever the priority: it ends with step 2."""
    of = scenario(10, BY_HAND, sensor("gps", 20, 2, priority=HR), cpus=2, steps=8)
    assert slices_of(of, "correct gps") == [(20, 30)]
    found = run_scenario(of)
    assert found.sensors["gps"].achieved == {2: 1}
    assert set(found.jobs["predict"].responses) == {0.4}


def test_a_backlog_of_urgent_corrections_is_not_looked_through_for_each_of_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A fifth of the corrections is left behind; each of the others replays nothing."""
    looks = Counter[str]()
    is_ahead = ComposedFilter._is_ahead

    def counted(self: ComposedFilter, one: Measurement, together: tuple[Measurement, ...]) -> bool:
        looks["at"] += 1
        return is_ahead(self, one, together)

    monkeypatch.setattr(ComposedFilter, "_is_ahead", counted)
    steps, costs = 2000, {"predict": "0.2", "correct.s": "0.3"}
    outcome = run_scenario(scenario("0.4", costs, sensor("s", 1, priority=HR), steps=steps))
    assert outcome.sensors["s"].not_landed == steps // 5
    assert looks["at"] < steps
