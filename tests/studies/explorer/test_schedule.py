"""The columns of a schedule are what `simulate` does, job by job and bar by bar."""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from fractions import Fraction
from random import Random

from hypothesis import assume, given
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import works
from sched_sim.design.simulate import simulate, simulated_steps
from sched_sim.design.timing import Timing
from sched_sim.schedule import intervals
from sched_sim.schedule.labels import MEANINGS
from sched_sim.schedule.tasks import Task
from studies.explorer.design import Design
from studies.explorer.given import Given
from studies.explorer.schedule import MOST_BARS, Timeline, most_steps, timeline
from studies.explorer.view import explore
from tests.random_designs import Simulated, random_design

DUAL_RATE = select(load_costs("steffes2014"), "dual-rate")

random_designs = st.integers(0, 2**32).map(lambda seed: random_design(Random(seed)))


def _timeline(design: Simulated) -> Timeline:
    return timeline(*design, period_ms=None)


@given(random_designs)
def test_jobs_and_bars_are_those_of_the_simulation(design: Simulated) -> None:
    costs, timing, speed, cycles, options, tasks = design
    schedule = simulate(costs, timing, speed, cycles, options, tasks, keep_slices=True)
    shown, period = _timeline(design), schedule.period
    assert (shown.steps, shown.cut) == (simulated_steps(costs, timing, cycles, options), "")
    assert shown.steps * period == schedule.horizon
    names = [(line.name, line.cpu) for line in shown.rows]
    assert names == [tuple(row) for row in intervals.rows(schedule)]
    of_job = zip(
        shown.jobs.row,
        shown.jobs.kind,
        shown.jobs.step,
        shown.jobs.release,
        shown.jobs.deadline,
        shown.jobs.finish,
        shown.jobs.missed,
        strict=True,
    )
    assert [(names[row], *rest) for row, *rest in of_job] == [
        (
            tuple(job.row),
            job.kind,
            job.step,
            job.release / period,
            job.deadline / period,
            None if job.finish is None else job.finish / period,
            job.missed,
        )
        for job in intervals.jobs(schedule)
    ]
    bars = zip(shown.bars.row, shown.bars.style, shown.bars.start, shown.bars.end, shown.bars.job, strict=True)
    assert [
        (names[row], shown.styles[style].label, start, end, shown.jobs.kind[job], shown.jobs.step[job])
        for row, style, start, end, job in bars
    ] == [
        (tuple(bar.row), bar.style, bar.start / period, bar.end / period, bar.kind, bar.step)
        for bar in intervals.bars(schedule)
    ]
    assert shown.misses == schedule.misses == sum(shown.jobs.missed)
    assert shown.busy == float(schedule.utilization)


@given(random_designs)
def test_jobs_start_and_are_preempted_as_often_as_the_processor_counts(design: Simulated) -> None:
    assume(all(works(design.costs)))
    schedule = simulate(*design, keep_slices=True)
    shown, jobs = _timeline(design), _timeline(design).jobs
    counted = Counter[str]()
    for kind, preemptions in zip(jobs.kind, jobs.preemptions, strict=True):
        counted[kind] += preemptions
    assert counted == Counter({kind: figures.preemptions for kind, figures in schedule.responses.items()})
    begins: dict[int, list[float]] = defaultdict(list)
    for job, start in zip(shown.bars.job, shown.bars.start, strict=True):
        begins[job].append(start)
    for job, start in enumerate(jobs.start):
        assert start == min(begins[job]) if job in begins else start == jobs.finish[job]
        assert start is None or start >= jobs.release[job]


def test_the_steps_of_the_paper_are_marked_and_styles_have_a_meaning() -> None:
    shown = timeline(DUAL_RATE, Timing(10, 4, 8), Fraction(77, 100), 1, Options(), (), 2.5)
    assert [(mark.step, mark.label, mark.meaning) for mark in shown.marks] == [
        (0, "k", "measurement 1 is taken"),
        (4, "m", "measurement 1 arrives"),
        (8, "l", "correction 1 lands"),
        (10, "k+N", "measurement 2 is taken"),
    ]
    assert {style.label: style.meaning for style in shown.styles}.items() <= MEANINGS.items()
    assert shown.period_ms == 2.5


def test_of_a_long_schedule_the_first_steps_are_shown_and_it_is_said() -> None:
    shown = timeline(DUAL_RATE, Timing(10**6, 4, 8), Fraction(77, 100), 3, Options(), (), None)
    assert shown.cut == "the first 10,000 of 3,000,000 steps"
    assert shown.steps == most_steps(()) == 10_000
    assert MOST_BARS / 2 <= len(shown.bars.start) <= MOST_BARS
    assert [mark.label for mark in shown.marks] == ["k", "m", "l"]
    assert shown.bars.end[-1] <= shown.steps


def test_what_is_cut_is_the_start_of_the_whole() -> None:
    whole = timeline(DUAL_RATE, Timing(900, 4, 8), Fraction(77, 100), 11, Options(), (), None)
    cut = timeline(DUAL_RATE, Timing(900, 4, 8), Fraction(77, 100), 12, Options(), (), None)
    assert whole.cut == ""
    assert cut.cut == "the first 10,000 of 10,800 steps"
    assert cut.bars.start[: len(whole.bars.start)] == whole.bars.start
    assert [mark.step for mark in cut.marks if mark.label.startswith("k")] == list(range(0, 10_000, 900))


def test_what_cannot_be_seen_of_a_name_is_told_by_its_escape() -> None:
    """It would turn the direction of what is written behind it."""
    task = Task("a\u202eb", Fraction(2), Fraction(1, 2), priority=30)
    view = explore(Design(N=10, M=4, speed="0.9"), Given(tasks=[task]))
    told = json.dumps(view.document(), ensure_ascii=False)
    assert view.schedule.rows[-1].name == "a\\u202eb"
    assert "task a\\u202eb" in view.answer.sentence
    assert told.isprintable()
