"""Windows of a scenario's run: the same as its slices."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from sched_sim.schedule.intervals import bars, jobs
from sched_sim.schedule.outcome import Schedule, Slice
from studies.explorer.scenario_trace import AHEAD, Trace
from studies.explorer.scenario_window import Document, window
from tests.random_scenarios import random_scenario
from tests.scenarios import BY_HAND, scenario, sensor

SEEDS = st.integers(0, 10**6)
LENGTHS = [1, 3, 20, 60, AHEAD + 60]


def run_of(of: Scenario) -> Schedule:
    slices: list[Slice] = []
    outcome = run_scenario(of, on_slice=slices.append)
    return Schedule(**{name: getattr(outcome.schedule, name) for name in FIGURES}, slices=tuple(slices))


FIGURES = ("period", "horizon", "cpus", "busy", "responses", "first_miss", "instants")


def known(of: Scenario, until: int, stride: int = 10**6) -> Trace:
    trace = Trace(of)
    while not trace.knows(until):
        trace.advance(stride)
    return trace


def rows_of(columns: dict[str, list[object]]) -> Iterator[tuple[object, ...]]:
    return zip(*columns.values(), strict=True)


@settings(max_examples=25)
@given(SEEDS, st.data())
def test_a_window_of_the_whole_run_has_its_slices_job_by_job(seed: int, data: st.DataObject) -> None:
    of = random_scenario(seed, LENGTHS)
    first = data.draw(st.integers(0, of.steps - 1))
    schedule, shown = run_of(of), window(known(of, of.steps), first, of.steps)
    period = schedule.period
    wanted = {
        (job.kind, job.step): (
            job.release / period,
            job.runs[0][0] / period if job.runs else None,
            None if job.finish is None else job.finish / period,
            job.deadline / period,
            job.missed,
        )
        for job in jobs(schedule)
        if job.finish is None or job.finish > first * period or job.release >= first * period
    }
    found = shown["jobs"]
    assert {
        (kind, step): rest
        for kind, step, *rest in zip(found["kind"], found["step"], *map(found.get, TIMES), strict=True)
    } == {key: list(values) for key, values in wanted.items()}
    assert sorted(_bars(shown)) == sorted(
        (bar.row.name, bar.style, bar.start / period, bar.end / period, bar.kind, bar.step)
        for bar in bars(schedule)
        if bar.end > first * period
    )


TIMES = ("release", "start", "finish", "deadline", "missed")


def _bars(shown: Document) -> Iterator[tuple[object, ...]]:
    """With its row's name, label, times and job."""
    found = shown["jobs"]
    for row, style, start, end, job in rows_of(shown["bars"]):
        of = found["kind"][job], found["step"][job]
        assert found["row"][job] == row
        yield (shown["rows"][row]["name"], shown["styles"][style]["label"], start, end, *of)


@settings(max_examples=25)
@given(SEEDS, st.data())
def test_a_window_is_the_same_however_far_the_run_was_simulated(seed: int, data: st.DataObject) -> None:
    of = random_scenario(seed, [AHEAD + 100])
    first = data.draw(st.integers(0, of.steps - 1))
    until = data.draw(st.integers(first + 1, min(of.steps, first + 40)))
    early = window(known(of, until, data.draw(st.integers(1, AHEAD))), first, until)
    assert early == window(known(of, of.steps), first, until)


@settings(max_examples=25)
@given(SEEDS, st.integers(1, 90), st.integers(2, 30))
def test_what_has_not_run_yet_waits_in_it(seed: int, until: int, slower: int) -> None:
    """As in a run that ends there. Larsen's method is another one where fewer measurements are taken; gains wait for
    predict jobs."""
    of = random_scenario(seed, [AHEAD + 100])
    assume(of.late != "larsen")
    of = replace(of, speed=of.speed / slower)
    schedule = run_of(replace(of, steps=until))
    wanted = [
        (job.kind, job.step, job.release / schedule.period, job.deadline / schedule.period)
        for job in jobs(schedule)
        if job.finish is None and job.release < schedule.horizon and not job.kind.startswith(WITHOUT)
    ]
    shown = window(known(of, until), until - 1, until)["jobs"]
    found = [
        (kind, step, release, deadline)
        for kind, step, release, deadline, finish in zip(*(shown[name] for name in WAITING), strict=True)
        if (finish is None or finish > until) and not kind.startswith(WITHOUT)
    ]
    assert sorted(found) == sorted(wanted)


WAITING = ("kind", "step", "release", "deadline", "finish")
WITHOUT = ("gain", "loss")


@settings(max_examples=25)
@given(SEEDS)
def test_it_counts_as_the_outcome_does(seed: int) -> None:
    of = random_scenario(seed, LENGTHS)
    outcome, trace = run_scenario(of), known(of, of.steps)
    shown = window(trace, 0, of.steps)
    assert shown["misses"] == outcome.misses == len(trace.misses.job)
    assert shown["busy"] == pytest.approx(float(outcome.schedule.utilization))
    assert len(shown["jobs"]["kind"]) == sum(figures.released for figures in outcome.jobs.values())


def test_where_work_piles_up_its_own_are_shown_and_what_waits_longest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of predict jobs that take two steps, ten wait in step 20, and the correction of step 0."""
    of = scenario(5, {"predict": 10, "correct.gps": 1}, sensor("gps", 100), steps=AHEAD + 100)
    monkeypatch.setattr("studies.explorer.scenario_window.MOST_JOBS", 8)
    shown = window(known(of, 21), 20, 21)
    found = list(zip(shown["jobs"]["kind"], shown["jobs"]["step"], strict=True))
    assert found == [*(("predict", step) for step in (*range(10, 16), 20)), ("correct gps", 0)]
    assert shown["cut"] == "without 4 more jobs that wait"


def test_late_measurements_are_marked() -> None:
    of = scenario(10, BY_HAND, sensor("gps", 10, 3), sensor("imu", 1), steps=100)
    lands = [l for _, l in run_scenario(of).sensors["gps"].landings]
    marks = [(mark["label"], mark["step"]) for mark in window(known(of, 60), 30, 60)["marks"]]
    assert sorted(marks) == sorted(
        [*(("k", step) for step in (30, 40, 50)), *(("m", step) for step in (33, 43, 53))]
        + [("l", step) for step in lands if 30 <= step < 60]
    )
