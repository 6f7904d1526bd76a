"""The rules of the simulated processor, each on the smallest schedule that shows it."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, LarsenCosts, MultirateCosts, RecalculateCosts, StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.jobs import Job
from sched_sim.schedule.processor import Platform, Processor
from sched_sim.schedule.tasks import Task

DUAL_RATE = DualRateCosts(hr=6, hr_restart=1, hr_update=2, lr_propagate=3, lr_gain=0, lr_update=5)
NEVER = 10**9


class Given:
    """A source that releases given jobs."""

    def __init__(self, *jobs: Job) -> None:
        self.jobs = sorted(jobs, key=lambda job: job.release)
        self.next_release = self.jobs[0].release

    def release(self) -> tuple[Job, ...]:
        job = self.jobs.pop(0)
        self.next_release = self.jobs[0].release if self.jobs else NEVER
        return (job,)

    def at_horizon(self) -> tuple[Job, ...]:
        return ()


def job(kind: str, priority: int, release: int, work: int, deadline: int = NEVER) -> Job:
    return Job(kind, 0, priority, release, deadline, work, ((kind, work),))


def ran(*jobs: Job, horizon: int = 100, context_switch: int = 0) -> list[tuple[str, int, int]]:
    """(kind, start, end) of every slice."""
    slices: list[tuple[str, int, int]] = []
    processor = Processor(
        [Given(job) for job in jobs],
        period=10,
        horizon=horizon,
        platform=Platform(1, context_switch),
        on_slice=lambda piece: slices.append((piece.kind, piece.start, piece.end)),
    )
    processor.run()
    return slices


def test_a_more_urgent_job_preempts_at_once_and_the_other_resumes_where_it_stopped() -> None:
    assert ran(job("low", 20, 0, 10), job("high", 10, 4, 3)) == [("low", 0, 4), ("high", 4, 7), ("low", 7, 13)]


def test_equal_priorities_run_in_order_of_release_and_do_not_preempt() -> None:
    jobs = job("first", 20, 0, 5), job("second", 20, 1, 5), job("third", 20, 2, 5)
    assert ran(*jobs) == [("first", 0, 5), ("second", 5, 10), ("third", 10, 15)]


def test_of_equal_priorities_released_at_one_instant_the_filter_goes_first() -> None:
    task = Task("control", Fraction(1), Fraction(1), priority=10, offset=Fraction(0))
    schedule = simulate(StandardCosts(4, 6), Timing(4, 0, 4), Fraction(20), 1, tasks=[task], keep_slices=True)
    assert [(piece.kind, piece.start) for piece in schedule.slices if piece.end > piece.start] == [
        ("hr", 0), ("task:control", 10), ("hr", 20), ("task:control", 24),
        ("hr", 40), ("task:control", 44), ("hr", 60), ("task:control", 64),
    ]  # fmt: skip


def test_a_preempted_job_stays_ahead_of_a_later_one_of_its_priority() -> None:
    jobs = job("early", 20, 0, 5), job("high", 10, 2, 4), job("late", 20, 3, 5)
    assert ran(*jobs) == [("early", 0, 2), ("high", 2, 6), ("early", 6, 9), ("late", 9, 14)]


def test_a_release_at_the_instant_of_a_completion_preempts_nothing() -> None:
    assert ran(job("low", 20, 0, 4), job("high", 10, 4, 3)) == [("low", 0, 4), ("high", 4, 7)]


def test_a_context_switch_is_charged_at_each_dispatch_of_another_job_than_ran_last() -> None:
    jobs = job("low", 20, 0, 10), job("high", 10, 4, 3)
    assert ran(*jobs, context_switch=1) == [("low", 0, 4), ("high", 4, 8), ("low", 8, 16)]


def test_a_job_that_is_preempted_during_its_context_switch_pays_the_rest_and_another_one() -> None:
    jobs = job("low", 20, 0, 10), job("high", 10, 1, 3)
    assert ran(*jobs, context_switch=3) == [("low", 0, 1), ("high", 1, 7), ("low", 7, 7 + 2 + 3 + 10)]


def test_a_job_that_finishes_exactly_at_its_deadline_has_met_it() -> None:
    meets = simulate(StandardCosts(4, 6), Timing(1, 0, 1), Fraction(10), cycles=5)
    assert (meets.misses, meets.utilization) == (0, 1)
    misses = simulate(StandardCosts(4, 6), Timing(1, 0, 1), Fraction(99, 10), cycles=5)
    assert misses.misses == 5


@pytest.mark.parametrize("late", [(3, 1), (1, 3), (3, 0, 2)])
def test_the_worst_lateness_is_that_of_the_job_that_missed_its_deadline_by_most(late: tuple[int, ...]) -> None:
    """Each alone, for 5 ticks."""
    jobs = [job("late", 10, 10 * i, 5, deadline=10 * i + 5 - ticks) for i, ticks in enumerate(late)]
    processor = Processor([Given(one) for one in jobs], 10, 100, Platform(1, 0))
    processor.run()
    found = processor.schedule().responses["late"]
    assert (found.worst_lateness, found.misses) == (3, sum(ticks > 0 for ticks in late))


def test_the_first_miss_is_that_of_the_earliest_deadline_and_of_several_the_one_that_is_found_first() -> None:
    """They finish at 8, 10, 12 and 14."""
    deadlines = {"a": 7, "b": 5, "c": 5, "d": 6}
    jobs = [job(kind, 10, 0, 8 if kind == "a" else 2, deadline) for kind, deadline in deadlines.items()]
    processor = Processor([Given(one) for one in jobs], 10, 100, Platform(1, 0))
    processor.run()
    assert processor.schedule().first_miss == ("b", False)


def test_a_job_that_goes_on_is_booked_once_and_its_companions_with_it() -> None:
    """It does 5, then 3 more, while something more urgent takes 2; a companion was released at 1 and is due at 9."""
    first = job("first", 20, 0, 5, deadline=20)
    first.then = lambda done, _now: (done.go_on((("more", 3),), None),)
    first.companions = (job("companion", 20, 1, 0, deadline=9),)
    slices: list[tuple[int, int, bool]] = []
    finishes: list[tuple[str, int]] = []
    processor = Processor(
        [Given(first), Given(job("urgent", 10, 6, 2))],
        10,
        100,
        Platform(1, 0),
        lambda piece: slices.append((piece.start, piece.end, piece.finished)),
        lambda done, now: finishes.append((done.kind, now)),
    )
    processor.run()
    responses = processor.schedule().responses
    assert slices == [(0, 5, False), (5, 6, False), (6, 8, True), (8, 10, True), (10, 10, True)]
    assert finishes == [("urgent", 8), ("first", 10), ("companion", 10)]
    assert (responses["first"].finished, responses["first"].worst, responses["first"].misses) == (1, 10, 0)
    assert (responses["companion"].finished, responses["companion"].worst, responses["companion"].misses) == (1, 9, 1)


def test_a_companion_of_a_job_that_has_not_finished_has_not_either() -> None:
    first = job("first", 20, 0, 200, deadline=200)
    first.companions = (job("companion", 20, 1, 0, deadline=90),)
    processor = Processor([Given(first)], 10, 100, Platform(1, 0))
    processor.run()
    companion = processor.schedule().responses["companion"]
    assert (companion.releases, companion.finished, companion.misses, companion.worst_lateness) == (1, 0, 1, 10)


@pytest.mark.parametrize(("now", "left", "overhead"), [(5, 12, 2), (6, 11, 1), (7, 10, 0), (9, 8, 0)])
def test_a_state_says_what_is_left_of_a_running_job_and_of_its_context_switch(
    now: int, left: int, overhead: int
) -> None:
    """Of 3 ticks of a switch and 10 of work, from 4 on, due at 20."""
    states: list[Any] = []

    class Observer(Given):
        def release(self) -> tuple[Job, ...]:
            states.append(processor.state(now))
            return super().release()

    sources = [Given(job("one", 10, 4, 10, deadline=20)), Observer(job("other", 20, now, 1))]
    processor = Processor(sources, 10, 100, Platform(1, 3))
    processor.run()
    assert states == [((("one", 4 - now, 20 - now, left, overhead), ()),)]


def test_an_lr_update_that_finishes_exactly_at_the_start_of_a_step_is_applied_in_it() -> None:
    """m = 1: 9 ticks are left in step 1 (restart) at a period of 10, 4 in each later one; the update takes 5."""
    exactly = DualRateCosts(hr=6, hr_restart=1, hr_update=2, lr_propagate=4, lr_gain=0, lr_update=9)
    assert simulate(exactly, Timing(5, 1, 4), Fraction(10), cycles=3).achieved == {2: 3}
    one_more = DualRateCosts(hr=6, hr_restart=1, hr_update=2, lr_propagate=4, lr_gain=0, lr_update=10)
    assert simulate(one_more, Timing(5, 1, 4), Fraction(10), cycles=3).achieved == {3: 3}


def test_same_step_feedback_lands_in_the_step_in_which_the_update_finishes() -> None:
    options = Options(feedback="same-step")
    schedule = simulate(DUAL_RATE, Timing(6, 1, 4), Fraction(10), 3, options)
    assert schedule.achieved == {1: 3}
    assert schedule.responses["hr_update"].finished == 3
    assert schedule.responses["hr_update"].worst == 2


def test_on_two_processors_the_lr_jobs_are_never_preempted() -> None:
    schedule = simulate(DUAL_RATE, Timing(6, 1, 4), Fraction(8), 3, Options(cpus=2))
    assert schedule.preemptions == 0
    assert schedule.responses["lr_propagate"].worst == 3
    assert schedule.responses["lr_update"].worst == 5 + (6 + 3 - 8)  # propagate ends one tick after m
    assert schedule.achieved == {2: 3}


def test_the_precomputed_gain_leaves_only_the_correction_after_the_measurement() -> None:
    split = DualRateCosts(hr=6, hr_restart=1, hr_update=2, lr_propagate=3, lr_gain=4, lr_update=1)
    schedule = simulate(split, Timing(6, 2, 4), Fraction(10), 3, Options(gain="precomputed"))
    assert schedule.responses["lr_gain"].finished == 3
    assert schedule.responses["lr_update"].worst == 6 + 1  # behind the HR job of step m
    assert schedule.achieved == {3: 3}


def test_with_m_equal_n_the_measurement_of_the_old_k_is_still_used() -> None:
    for costs, work in ((LarsenCosts(2, 3, 4), 3 + 4), (RecalculateCosts(2, 3, 1), 2 + 3 + 4)):
        schedule = simulate(costs, Timing(4, 4, 4), Fraction(work), cycles=3)
        assert (schedule.misses, schedule.achieved) == (0, {4: 3})
        assert schedule.responses["hr"].worst == work


@pytest.mark.parametrize(("M", "steps"), [(3, 8), (4, 9)])
@pytest.mark.parametrize("costs", [RecalculateCosts(1, 1, 1), LarsenCosts(1, 1, 1)])
def test_with_m_equal_n_it_is_a_step_longer(costs: RecalculateCosts | LarsenCosts, M: int, steps: int) -> None:
    schedule = simulate(costs, Timing(4, M, 4), Fraction(9), cycles=2)
    assert schedule.horizon == steps * schedule.period
    assert schedule.achieved == {M: 2}


def test_lr_propagate_is_released_when_the_hr_job_of_step_k_finishes() -> None:
    schedule = simulate(DUAL_RATE, Timing(4, 2, 4), Fraction(10), cycles=2, keep_slices=True)
    finish = {piece.step: piece.end for piece in schedule.slices if piece.kind == "hr"}
    released = {piece.step: piece.release for piece in schedule.slices if piece.kind == "lr_propagate"}
    assert released == {k: finish[k] for k in (0, 4)}


def test_the_hr_job_of_step_k_plus_1_is_the_restart() -> None:
    schedule = simulate(DUAL_RATE, Timing(4, 2, 4), Fraction(10), cycles=2, keep_slices=True)
    work = {piece.step: piece.parts[0][1] for piece in schedule.slices if piece.kind == "hr"}
    assert [j for j in sorted(work) if work[j] == DUAL_RATE.hr_restart] == [1, 5]


def test_the_standard_filter_ignores_the_delay() -> None:
    assert simulate(StandardCosts(2, 3), Timing(4, 3, 4), Fraction(5), cycles=3).achieved == {0: 3}


def test_an_overrun_keeps_running_late_and_is_reported() -> None:
    """Each cycle of one step brings 10 ticks of work to a period of 8: the n-th job is 2n late."""
    schedule = simulate(StandardCosts(4, 6), Timing(1, 0, 1), Fraction(8), cycles=8)
    hr = schedule.responses["hr"]
    assert (hr.releases, hr.finished, hr.misses) == (8, 6, 8)
    assert hr.worst == 6 * 10 - 5 * 8
    assert schedule.utilization == 1


def test_user_tasks_share_the_processor() -> None:
    tasks = [
        Task("control", period=Fraction(2), cost=Fraction(3), priority=5, offset=Fraction(1, 2)),
        Task("telemetry", period=Fraction(6), cost=Fraction(4), priority=30, offset=Fraction(0)),
    ]
    alone = simulate(DUAL_RATE, Timing(6, 1, 4), Fraction(10), 4)
    shared = simulate(DUAL_RATE, Timing(6, 1, 4), Fraction(10), 4, tasks=tasks)
    assert shared.responses["task:control"].worst * 10 == 3 * shared.period
    assert shared.responses["hr"].worst > alone.responses["hr"].worst
    assert shared.responses["task:telemetry"].misses == 0
    assert shared.utilization - alone.utilization == Fraction(12 * 3 + 4 * 4, 4 * 60)


def test_memory_does_not_grow_with_the_cycles_and_slices_are_kept_only_on_demand() -> None:
    assert simulate(DUAL_RATE, Timing(6, 1, 4), Fraction(10), 2).slices == ()
    seen: list[object] = []
    schedule = simulate(DUAL_RATE, Timing(6, 1, 4), Fraction(10), 2, keep_slices=True, on_slice=seen.append)
    assert list(schedule.slices) == seen


def test_an_l_that_dual_rate_cannot_have_is_refused() -> None:
    with pytest.raises(InputError, match=r"L=4 must be > M=4.*give L from 5 on"):
        simulate(DUAL_RATE, Timing(10, 4, 4), Fraction(10), 1)


@pytest.mark.parametrize(("timing", "said"), [
    (Timing(10, 0, 12), "L=12 must be <= N=10 with this method.*give L from 1 to N=10"),
])  # fmt: skip
def test_a_method_with_one_measurement_at_a_time_cannot_land_after_the_next(timing: Timing, said: str) -> None:
    with pytest.raises(InputError, match=said):
        simulate(MultirateCosts(4, 8), timing, Fraction(6), cycles=1)


def test_a_task_on_a_processor_that_is_not_there_is_refused() -> None:
    task = Task("camera", period=Fraction(2), cost=Fraction(1), priority=30, cpu=2)
    with pytest.raises(InputError, match="task 'camera': cpu 2 is not there; give cpus 2"):
        simulate(DUAL_RATE, Timing(10, 4, 8), Fraction(10), 1, tasks=[task])
    assert simulate(DUAL_RATE, Timing(10, 4, 8), Fraction(10), 1, Options(cpus=2), [task]).misses == 0


def test_a_speed_of_zero_is_refused() -> None:
    with pytest.raises(InputError, match="speed is 0"):
        simulate(DUAL_RATE, Timing(10, 4, 8), Fraction(0), 1)


def test_a_multirate_gain_is_computed_below_the_state_updates_and_used_from_the_next_step_on() -> None:
    """Covariance and gain, 8, fill what the state updates, 4 of each 6 ticks, leave: 2 in each of the steps 0 to 3."""
    schedule = simulate(MultirateCosts(4, 8), Timing(5, 0, 4), Fraction(6), cycles=2, keep_slices=True)
    runs = [(piece.start, piece.end) for piece in schedule.slices if piece.kind == "lr_gain" and piece.step == 0]
    assert runs == [(4, 6), (10, 12), (16, 18), (22, 24)]
    assert (schedule.misses, schedule.achieved) == (0, {4: 2})


def test_a_gain_that_is_not_ready_in_time_is_a_miss() -> None:
    assert simulate(MultirateCosts(4, 9), Timing(5, 0, 4), Fraction(6), cycles=2).responses["lr_gain"].misses == 2


def test_a_multirate_gain_cannot_land_in_the_step_it_is_computed_from() -> None:
    with pytest.raises(InputError, match="L=0 must be at least 1"):
        simulate(MultirateCosts(4, 8), Timing(5, 0, 0), Fraction(6), cycles=1)
