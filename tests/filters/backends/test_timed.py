"""Each execution is timed by itself: by a clock of which the answers are known, and compiled, by that of the system."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.choose import arguments_for, function_for
from filters.backends.timed import Clock, Varied, now, one_of, timed, timed_cold, timed_in_order, vary

NUMBER = 7


class Hands:
    """A clock that stands still, but for what jobs take and for each reading."""

    def __init__(self, at_reading: int = 0) -> None:
        self.ns = 2_999_999_000
        self.reading = np.zeros(2, dtype=np.int64)
        self.at_reading = at_reading

    def gettime(self, number: int, _address: Any) -> int:
        assert number == NUMBER
        self.reading[:] = divmod(self.ns, 1_000_000_000)
        self.ns += self.at_reading
        return 0

    def takes(self, ns: int) -> None:
        self.ns += ns

    @property
    def clock(self) -> Clock:
        return Clock(self.gettime, NUMBER, self.reading)


def work(hands: Hands, durations: list[int]) -> None:
    hands.takes(durations.pop(0))


def system_clock() -> Clock:
    gettime = ctypes.CDLL(None).clock_gettime
    gettime.argtypes, gettime.restype = [ctypes.c_int, ctypes.c_void_p], ctypes.c_int
    return Clock(gettime, time.CLOCK_MONOTONIC, np.zeros(2, dtype=np.int64))


def places(count: int) -> Any:
    return np.zeros(count, dtype=np.int64)


def varied(executions: int, *, memory: Any = (), bounds: Any = (0, 0, 0, 0), values: Any = ((),)) -> Varied:
    """Two sets by turns, if there are two, after pauses of 0, 1, 2, ... turns."""
    which = np.arange(executions) % len(values)
    return Varied(np.array(memory), np.array(bounds), np.array(values), which, np.arange(executions), np.zeros(1))


def test_inputs_of_an_execution_are_those_of_its_set_and_of_no_other_job() -> None:
    given = varied(2, memory=[0.0] * 3, bounds=[0, 1, 3], values=[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    vary(given, 1, 1)
    assert given.memory.tolist() == [0, 5, 6]
    vary(given, 0, 0)
    assert given.memory.tolist() == [1, 5, 6]


def test_a_pause_is_work_of_its_length() -> None:
    given = varied(4)
    vary(given, 3, 0)
    assert given.scratch.tolist() == [1.75]  # 1, 1.5, 1.75: more with each turn


def test_each_execution_has_the_inputs_of_its_set() -> None:
    given, seen = varied(4, memory=[0.0], bounds=[0, 1], values=[[7.0], [8.0]]), []
    timed(lambda: seen.append(given.memory[0]), (), given, Hands().clock, places(4))
    assert seen == [7, 8, 7, 8]


def test_each_execution_is_timed_in_its_order_over_full_seconds_too() -> None:
    hands, spans = Hands(), places(4)
    timed(work, (hands, [300, 1_000_000_500, 0, 2]), varied(4), hands.clock, spans)
    assert spans.tolist() == [300, 1_000_000_500, 0, 2]


def test_one_reading_of_the_clock_is_in_each() -> None:
    hands, spans = Hands(at_reading=20), places(3)
    timed(work, (hands, [300, 0, 2]), varied(3), hands.clock, spans)
    assert spans.tolist() == [320, 20, 22]


def test_all_lines_are_written_to_before_each_cold_execution() -> None:
    hands, spans, others = Hands(), places(3), np.zeros((5, 8), dtype=np.int64)
    seen: list[int] = []

    def job() -> None:
        seen.append(int(others[:, 0].min()))
        hands.takes(9)

    timed_cold(job, (), varied(3), hands.clock, spans, others)
    assert spans.tolist() == [9, 9, 9]
    assert seen == [1, 2, 3]


def test_jobs_run_in_the_order_of_their_numbers() -> None:
    hands, order = Hands(), np.array([2, 0, 0, 1, 2])
    jobs: tuple[Callable[[int], None], ...] = tuple(
        lambda ns, factor=factor: hands.takes(factor * ns) for factor in (1, 10, 100)
    )
    spans = places(len(order))
    timed_in_order(one_of(jobs), ((1,), ((2,), ((3,), ()))), varied(5), hands.clock, spans, order)
    assert spans.tolist() == [300, 1, 1, 20, 300]


def spin(times: int, at: FloatArray) -> None:
    for _ in range(times):
        at[0] = 0.5 * at[0] + 1.0


def test_compiled_work_takes_as_long_as_there_is_of_it() -> None:
    """By the least of many executions, which no other work of the machine makes longer."""
    clock, at = system_clock(), np.zeros(1)
    loop, job = function_for("compiled", timed), arguments_for("compiled", spin)

    def least(times: int) -> int:
        spans = places(200)
        loop(job, (times, at), varied(200), clock, spans)
        return int(spans.min())

    once, thrice = least(10_000), least(30_000)
    assert 2.5 < thrice / once < 3.5


def test_compiled_jobs_run_in_order_too() -> None:
    def mark(number: int, log: Any) -> None:
        log[log[0]] = number
        log[0] += 1

    def mark_more(number: int, log: Any) -> None:
        mark(10 * number, log)

    log, order = np.ones(6, dtype=np.int64), np.array([1, 0, 1, 1, 0])
    use, arguments = arguments_for("compiled", (one_of((mark, mark_more)), ((3, log), ((4, log), ()))))
    spans = places(len(order))
    function_for("compiled", timed_in_order)(use, arguments, varied(5), system_clock(), spans, order)
    assert log.tolist() == [6, 40, 3, 40, 40, 3]
    assert (spans >= 0).all()


def test_machine_code_with_a_clock_is_kept_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The address of the C function differs from process to process, and is an argument."""

    def reads(clock: Clock) -> int:
        return now(clock)

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    function_for("compiled", reads)(system_clock())
    assert len([*tmp_path.rglob("*.nbc")]) == 1
