"""What is said of a run: of recorded ones, and of those that are made from a simulation, with something taken."""

from __future__ import annotations

from itertools import pairwise

import pytest

from studies.live.agreement import Agreement, agreement, together, would_do
from studies.live.jobs import Job, Ran, parsed
from studies.live.landed import achieved, wake_ups
from studies.live.measure import Measured, measured
from studies.live.slices import schedule_of
from studies.live.taken import busy_periods, taken_by_cycle
from tests.studies.live.recorded import MS, RECORDED, design, judged, perfect, recorded, simulated


def judged_jobs(jobs: list[Job], cycles: int = RECORDED) -> Measured:
    of = design(cycles=cycles)
    assert of.predicted == 7
    return measured(Ran(tuple(jobs), 0), of, 7)


def late(jobs: list[Job], cycles: list[int]) -> list[Job]:
    """Something has the core as LR is nearly done in these cycles, and their corrections land a step later."""
    changed = []
    for job in jobs:
        if job.kind == "lr_update" and job.step // 10 in cycles:
            changed.append(job._replace(end=job.end + 8 * MS))
        elif job.kind == "hr_update" and job.step // 10 in cycles:
            changed.append(a_step_later(job))
        else:
            changed.append(job)
    return sorted(changed, key=lambda job: (not job.high, job.start))


def a_step_later(job: Job) -> Job:
    return job._replace(step=job.step + 1, start=job.start + 10 * MS, end=job.end + 10 * MS)


def test_a_recorded_run_agrees() -> None:
    run = judged("ordinary")
    assert run.achieved == [7] * RECORDED
    assert run.agreement == Agreement(RECORDED, RECORDED, RECORDED, RECORDED)
    assert run.agreement.word == "inconclusive"  # eight are too few
    assert run.ran.differing == 0
    assert len(run.wake) == 10 * (RECORDED + 1)
    assert min(run.wake) > 0


def test_swapped_priorities_disagree() -> None:
    """HR waits for LR, which disturbs nothing: no cycle is excused."""
    run = judged("swapped")
    assert run.achieved == [5] * RECORDED
    assert not any(run.disturbed)
    assert run.agreement.word == "disagrees"


def test_of_a_perfect_kernel_nothing_is_taken() -> None:
    run = judged_jobs(perfect(design()))
    assert run.achieved == [7] * RECORDED
    assert max(run.taken) <= 20  # ns, of rounding
    assert max(map(abs, run.wake)) <= 1


@pytest.mark.parametrize(
    ("N", "M", "speed"),
    [(N, M, speed) for N, M in ((10, 4), (10, 0)) for speed in ("0.73", "0.75", "0.78", "0.85", "1.0", "1.2")]
    + [(7, 6, "1.2"), (3, 1, "1.1")],
)
def test_jobs_of_a_simulation_are_its_schedule(N: int, M: int, speed: str) -> None:
    of = design(speed, 4, N=N, M=M)
    jobs = perfect(of)
    assert set(achieved(jobs, of)) == {of.predicted}
    again = schedule_of(jobs, of)
    drawn = [(label, piece.step, start, end) for piece in again.slices for label, start, end in piece.pieces()]
    assert sorted(drawn) == sorted(simulated(of))
    assert again.misses == 0


def test_what_is_taken_disturbs_the_cycle_and_no_other() -> None:
    run = judged_jobs(late(perfect(design()), [3]))
    assert run.achieved == [7, 7, 8, 7, 7, 7, 7, 7]
    assert run.disturbed == [False, False, True, False, False, False, False, False]
    assert run.taken[2] > 0.5 * MS > 20 > max(run.taken[:2] + run.taken[3:])
    assert run.agreement == Agreement(8, 7, 7, 7)


def test_cpu_time_beyond_what_a_job_is_to_have_was_taken_from_it() -> None:
    jobs = [
        job._replace(cpu=job.cpu + MS, end=job.end + MS) if (job.kind, job.step) == ("lr_update", 30) else job
        for job in perfect(design())
    ]
    assert judged_jobs(jobs).disturbed == [False, False, True, False, False, False, False, False]


def test_a_disturbance_over_the_end_of_a_cycle_is_of_both() -> None:
    of = design()
    jobs = [
        job._replace(end=job.end + 40 * MS) if (job.kind, job.step) == ("lr_update", 20) else job for job in perfect(of)
    ]
    taken = taken_by_cycle(busy_periods(jobs, of), of)
    assert [time > 0.5 * MS for time in taken] == [False, True, True, False, False, False, False, False]


def test_too_many_disturbed_cycles_are_inconclusive_even_if_all_agree() -> None:
    jobs = [
        job._replace(cpu=job.cpu - MS) if job.kind == "hr_propagate" and job.step in (22, 45) else job
        for job in perfect(design())
    ]
    run = judged_jobs(jobs)
    assert run.agreement == Agreement(8, 8, 6, 6)
    assert run.agreement.word == "inconclusive"


def test_a_measurement_that_is_left_out_lands_nowhere() -> None:
    jobs = [job for job in perfect(design()) if (job.kind, job.step // 10) not in {("hr_update", 4), ("lr_update", 4)}]
    assert judged_jobs(jobs).achieved == [7, 7, 7, None, 7, 7, 7, 7]


def test_an_update_that_never_got_the_core_disturbs_all_that_is_left() -> None:
    """From cycle 5 on: HR sends nothing more, and leaves all later measurements out."""
    left = [
        job
        for job in recorded("ordinary").jobs
        if not (
            (job.kind == "lr_update" and job.step >= 50)
            or (job.kind in ("lr_propagate", "hr_restart") and job.step > 51)
            or (job.kind == "hr_update" and job.step > 50)
        )
    ]
    run = judged_jobs(left)
    assert run.achieved == [7, 7, 7, 7, None, None, None, None]
    assert run.disturbed == [False] * 4 + [True] * 4
    assert run.agreement.word == "inconclusive"
    idle = measured(Ran(tuple(left), 0, idle=300 * MS), design(), 7)
    assert idle.achieved == run.achieved
    assert not any(idle.disturbed)  # the core stood idle, so that LR had no excuse
    assert idle.agreement.word == "disagrees"
    assert measured(Ran(tuple(left), 0, idle=100 * MS), design(), 7).disturbed == run.disturbed


def test_the_latency_is_that_of_the_first_job_of_a_step() -> None:
    of = design(cycles=1)
    jobs = [
        Job("hr_propagate", 1, 10 * MS + 30, 11 * MS, MS),
        Job("hr_update", 1, 11 * MS, 12 * MS, MS),
        Job("hr_propagate", 2, 20 * MS + 50, 21 * MS, MS),
    ]
    assert wake_ups(jobs, of) == [30, 50]


@pytest.mark.parametrize(
    ("agreeing", "undisturbed", "of_these", "word"),
    [
        (500, 500, 500, "agrees"),
        (100, 480, 479, "agrees"),
        (100, 472, 471, "inconclusive"),
        (500, 400, 400, "agrees"),
        (100, 400, 396, "inconclusive"),
        (100, 400, 391, "disagrees"),
        (500, 399, 399, "inconclusive"),
        (0, 399, 0, "inconclusive"),
        (0, 0, 0, "inconclusive"),
    ],
)
def test_the_word(agreeing: int, undisturbed: int, of_these: int, word: str) -> None:
    assert Agreement(500, agreeing, undisturbed, of_these).word == word


def test_nothing_is_said_of_too_few_cycles() -> None:
    """At least 99 % with 95 % confidence: 0.99^n is at most 0.05 from n = 299 on; with one elsewhere, from 473 on."""
    for elsewhere, fewest in ((0, 299), (1, 473)):
        assert would_do(elsewhere) == fewest
        for number, word in ((fewest - 1, "inconclusive"), (fewest, "agrees")):
            of = Agreement(number, number - elsewhere, number, number - elsewhere)
            assert of.word == word
            assert not of.too_disturbed
    assert Agreement(1, 1, 1, 1).word == "inconclusive"
    assert 0.99**298 > 0.05 >= 0.99**299


def test_cycles_of_several_runs_together() -> None:
    assert together([Agreement(100, 99, 98, 97), Agreement(10, 9, 8, 7)]) == Agreement(110, 108, 106, 104)


def test_what_was_taken_is_never_more_than_all_time() -> None:
    """On a core that is so starved that the run takes three times as long as its periods."""
    of = design()
    jobs = [job._replace(end=3 * job.end) if job.kind == "lr_update" else job for job in perfect(of)]
    assert 0.5 < judged_jobs(jobs).taken_share <= 1


def test_agreement_is_of_where_it_was_predicted() -> None:
    assert agreement(7, [7, 8, None, 7], [False, False, True, True]) == Agreement(4, 2, 2, 1)


def test_the_cycle_of_a_picture_is_one_that_shows_what_is_wrong() -> None:
    jobs = perfect(design())
    assert judged_jobs(jobs).shown_cycle() == 1
    moved = [a_step_later(job) if (job.kind, job.step) == ("hr_update", 57) else job for job in jobs]
    assert judged_jobs(sorted(moved, key=lambda job: (not job.high, job.start))).shown_cycle() == 5
    assert judged_jobs(late(jobs, [1])).shown_cycle() == 2


def test_preempted_jobs_are_in_pieces_whoever_is_above() -> None:
    ordinary, swapped = recorded("ordinary"), recorded("swapped")
    for ran, kind in ((ordinary, "lr_update"), (swapped, "hr")):
        schedule = schedule_of(ran.jobs, design(), swapped=ran is swapped)
        assert schedule.responses[kind].preemptions > 0
        ends = [(piece.start, piece.end) for piece in sorted(schedule.slices, key=lambda piece: piece.start)]
        assert all(before <= start for (_, before), (start, _) in pairwise(ends))
    assert schedule_of(swapped.jobs, design(), swapped=True).responses["hr"].misses > 0


def test_what_the_program_prints_is_read() -> None:
    ran = parsed(["kind,step,start_ns,end_ns,cpu_ns", "hr_restart,1,10,20,9", "idle,70", "differing,3"])
    assert ran == Ran((Job("hr_restart", 1, 10, 20, 9),), 3, 70)
