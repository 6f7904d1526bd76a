"""Executions are kept in their order, block by block, and blocks in which the system ran something else timed again."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.jobs import Job
from filters.modular import ModularFilter, Sensor, linear_corrector, linear_predictor
from studies.measurement import executions
from studies.measurement.clock import monotonic
from studies.measurement.executions import TRIES, Course, Wanted, alone, in_order, run
from studies.measurement.job_times import silent
from studies.measurement.loop_order import loops_of, order_of

WANTED = Wanted(executions=400, seconds=5.0)


def course(*names: str, count: int, block: int, start: int = 0, seen: list[int] | None = None) -> Course:
    """Executions that take as many ns as their number; its jobs by turns."""

    def numbers(first: int, size: int) -> Any:
        if seen is not None:
            seen.append(first)
        return start + np.arange(first, first + size)

    return Course(names, np.arange(count) % len(names), numbers, block)


@pytest.mark.parametrize("block", [1, 7, 100, 1000])
def test_all_are_kept_in_their_order_whatever_the_blocks(block: int) -> None:
    found = run([course("predict", count=100, block=block), course("a", "b", count=9, block=2)], WANTED, 0, silent)
    assert found.ns["predict"].tolist() == [*range(100)]
    assert (found.ns["a"].tolist(), found.ns["b"].tolist()) == ([0, 2, 4, 6, 8], [1, 3, 5, 7])
    assert (found.blocks, found.again, found.disturbed) == (-(-100 // block) + 5, 0, 0)


def test_of_a_job_in_two_courses_the_first_counts_and_no_more_than_wanted() -> None:
    courses = [course("predict", count=500, block=100), course("predict", "carry", count=8, block=4, start=1000)]
    found = run(courses, WANTED, 0, silent).ns
    assert found["predict"].tolist() == [*range(400)]
    assert found["carry"].tolist() == [1001, 1003, 1005, 1007]


def test_blocks_come_by_turns() -> None:
    """So that what slows the machine for a while slows all: no half of the time has less than a third of any."""
    seen: list[int] = []
    marked = [course(name, count=30, block=1, start=100 * n, seen=seen) for n, name in enumerate("ab")]
    order: list[str] = []

    def noting(one: Course) -> Course:
        return one._replace(run=lambda first, size: (order.append(one.names[0]), one.run(first, size))[1])

    run([noting(one) for one in marked], WANTED, 0, silent)
    assert 10 <= order[:30].count("a") <= 20


@pytest.mark.parametrize("disturbed_times", [0, 1, TRIES - 1, TRIES, TRIES + 5])
def test_a_disturbed_block_is_timed_again_and_at_last_kept(
    disturbed_times: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = [0]

    def once_more(_first: int, size: int) -> Any:
        runs[0] += 1
        return np.full(size, runs[0])

    monkeypatch.setattr(executions, "switches", lambda: min(runs[0], disturbed_times))
    found = run([Course(["predict"], np.zeros(3, dtype=np.int64), once_more, 3)], WANTED, 0, silent)
    assert runs[0] == min(disturbed_times + 1, TRIES)
    assert found.ns["predict"].tolist() == [runs[0]] * 3
    assert (found.again, found.disturbed) == (min(disturbed_times, TRIES), int(disturbed_times >= TRIES))


def add_up(numbers: Any, out: Any) -> None:
    for i in range(len(numbers)):
        out[0] += numbers[i]


def job(count: int) -> Job:
    return Job("sum", add_up, lambda index: (np.full(count, 1.0 + index), np.zeros(1)))


def test_a_job_runs_as_often_as_wanted() -> None:
    for caches in ("warm", "cold"):
        found = run(
            [alone("sum", job(50), caches, Wanted(250, 5.0), monotonic(), np.random.default_rng(0))],
            Wanted(250, 5.0),
            0,
            silent,
        )
        assert len(found.ns["sum"]) == 250
        assert (found.ns["sum"] >= 0).all()


def test_of_a_long_job_there_are_fewer() -> None:
    long = alone("sum", job(1000), "warm", Wanted(100_000, 1e-9), monotonic(), np.random.default_rng(0))
    assert len(long.jobs) == executions.LEAST


def test_jobs_in_order_run_until_there_are_enough_of_the_rarest() -> None:
    order = np.array([0, 0, 0, 1])
    found = run(
        [in_order(["short", "long"], [job(2), job(3000)], order, WANTED, monotonic(), np.random.default_rng(0))],
        WANTED,
        0,
        silent,
    )
    assert {name: len(ns) for name, ns in found.ns.items()} == {"short": 400, "long": 400}
    assert np.median(found.ns["long"]) > np.median(found.ns["short"])


def cart(*every: Any) -> ModularFilter:
    sensors = [
        Sensor(name, linear_corrector([[1.0, 0.0]], [[1.0]]), each) for name, each in zip("gr", every, strict=True)
    ]
    return ModularFilter(linear_predictor(np.eye(2), np.eye(2)), sensors)


def test_a_loop_predicts_in_each_step_and_corrects_by_what_is_due() -> None:
    loop = ["predict", "correct.g", "correct.r"]
    assert order_of(loop, cart(4, 2), 5).tolist() == [0, 1, 2, 0, 0, 2, 0, 0, 1, 2]


def test_there_is_a_loop_for_each_way_with_late_measurements_that_has_its_parts() -> None:
    assert loops_of(["predict", "correct.g", "correct.r"]) == [["predict", "correct.g", "correct.r"]]
    assert loops_of(["predict"]) == [["predict"]]
    parts = ["predict", "correct.g", "carry.g", "beside.g", "land.g", "hr_propagate", "gain.g"]
    assert loops_of(parts) == [
        ["predict", "correct.g"],
        ["predict", "carry.g", "correct.g", "beside.g", "land.g"],
        ["hr_propagate", "gain.g"],
    ]


def test_what_is_of_any_sensor_runs_with_each() -> None:
    loop = ["hr_propagate", "hr_restart", "gain.g"]
    assert order_of(loop, cart(4, 3), 5).tolist() == [0, 1, 2, 0, 0, 0, 1, 0, 1, 2]
