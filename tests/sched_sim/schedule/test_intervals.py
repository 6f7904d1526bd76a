"""What a Gantt chart draws is what the simulation did: intervals, not pixels."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from hypothesis import example, given, settings
from hypothesis import strategies as st

from sched_sim.design.least_speed import least_speed
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import bars, jobs, never_ran, overdue_work, rows, waits
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.tasks import Task
from tests.designs import Design, designs

overload = Design(DualRateCosts(63, 4, 3, 41, 0, 56), Timing(10, 4, 8), Options())


@st.composite
def schedules(draw: st.DrawFn) -> Schedule:
    """At speeds around the least, so that about half of them miss deadlines; some with context switches and tasks."""
    design = draw(designs)
    speed = least_speed(*design).speed * Fraction(draw(st.integers(2, 8)), 4)
    options = replace(design.options, context_switch=Fraction(draw(st.sampled_from([0, 0, 1, 3]))))
    task = Task("telemetry", Fraction(5, 2), speed / 3, draw(st.sampled_from([5, 15, 30])), cpu=options.cpus)
    tasks = [task] if draw(st.booleans()) else []
    return simulate(design.costs, design.timing, speed, 3, options, tasks, keep_slices=True)


too_slow = simulate(overload.costs, overload.timing, Fraction(30), 3, overload.options, keep_slices=True)
starved = simulate(
    overload.costs,
    overload.timing,
    Fraction(77),
    1,
    Options(),
    [Task("hog", Fraction(1), Fraction(77), 1)],
    keep_slices=True,
)


@settings(max_examples=30)
@example(too_slow)
@example(starved)
@given(schedules())
def test_bars_cover_the_slices_exactly_and_never_overlap(schedule: Schedule) -> None:
    drawn = bars(schedule)
    assert all(bar.start < bar.end for bar in drawn)
    assert sum(bar.end - bar.start for bar in drawn) == schedule.busy
    covered: Counter[tuple[int, int]] = Counter()
    for bar in drawn:
        assert bar.row.cpu is not None
        covered[bar.row.cpu, bar.start] += 1
        covered[bar.row.cpu, bar.end] -= 1
    ran: Counter[tuple[int, int]] = Counter()
    for piece in schedule.slices:
        ran[piece.cpu, piece.start] += 1
        ran[piece.cpu, piece.end] -= 1
    assert {at: change for at, change in covered.items() if change} == {at: c for at, c in ran.items() if c}
    for cpu in range(schedule.cpus):
        of_cpu = sorted((bar.start, bar.end) for bar in drawn if bar.row.cpu == cpu)
        assert all(before[1] <= after[0] for before, after in pairwise(of_cpu))


@settings(max_examples=30)
@example(too_slow)
@example(starved)
@given(schedules())
def test_misses_are_flagged_exactly_where_the_schedule_has_them(schedule: Schedule) -> None:
    flagged = Counter(job.kind for job in jobs(schedule) if job.missed)
    assert flagged == {kind: response.misses for kind, response in schedule.responses.items() if response.misses}
    seen = Counter(job.kind for job in jobs(schedule))
    assert seen == {kind: response.releases for kind, response in schedule.responses.items()}
    late = {(job.row, job.step) for job in jobs(schedule) if job.missed}
    for row, start, end in overdue_work(bars(schedule)):
        assert start < end
        assert any(row == of_job for of_job, _ in late)


@settings(max_examples=30)
@given(schedules())
def test_a_job_runs_or_waits_from_its_release_to_its_finish(schedule: Schedule) -> None:
    for job in jobs(schedule):
        end = schedule.horizon if job.finish is None else job.finish
        stretches = sorted([*job.runs, *waits(job, schedule.horizon)])
        assert stretches or job.release == end
        assert not stretches or [stretches[0][0], stretches[-1][1]] == [job.release, end]
        assert all(before[1] == after[0] for before, after in pairwise(stretches))


@given(schedules())
def test_every_bar_has_its_row_and_every_processor_one(schedule: Schedule) -> None:
    found = rows(schedule)
    assert {bar.row for bar in bars(schedule)} <= set(found)
    assert len(set(found)) == len(found)
    assert {row.cpu for row in found} >= set(range(schedule.cpus))


def test_a_starved_job_class_has_a_row_of_jobs_that_wait() -> None:
    assert [row.name for row in rows(starved)] == ["HR", "LR", "hog"]
    waiting = [job for job in jobs(starved) if not job.runs]
    assert never_ran(starved) == starved.misses == len(waiting) > 0
    assert all(waits(job, starved.horizon) == [(job.release, starved.horizon)] for job in waiting)


@example(too_slow)
@given(schedules())
def test_jobs_are_preempted_as_often_as_the_processor_counts(schedule: Schedule) -> None:
    counted = Counter[str]()
    for job in jobs(schedule):
        counted[job.kind] += job.preemptions
    assert counted == Counter({kind: figures.preemptions for kind, figures in schedule.responses.items()})
