"""The least time of several runs, and one line of the result."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from time import perf_counter, process_time
from typing import Any, NamedTuple

from filters.backends.choose import arguments_for, function_for
from filters.backends.repeat import repeat

REPETITIONS = 1000


class Result(NamedTuple):
    """A figure beside its target. higher: whether more is better."""

    name: str
    value: float
    target: float
    higher: bool = True
    unit: str = "times"

    @property
    def met(self) -> bool:
        return self.value >= self.target if self.higher else self.value <= self.target


def seconds(run: Callable[[], Any], repeats: int = 5) -> float:
    times = []
    for _ in range(repeats):
        start = perf_counter()
        run()
        times.append(perf_counter() - start)
    return min(times)


def core_seconds(run: Callable[[], Any]) -> float:
    """Of the processor, once: what other processes take on a busy machine is not counted."""
    start = process_time()
    run()
    return process_time() - start


def times_faster(ours: Callable[[], Any], theirs: Callable[[], Any], rounds: int = 7) -> float:
    """The least time of theirs over the least of ours, in turns, so that a slow minute of the machine hits both."""
    least_of_ours = least_of_theirs = inf
    for _ in range(rounds):
        least_of_theirs = min(least_of_theirs, seconds(theirs, 1))
        least_of_ours = min(least_of_ours, seconds(ours, 10))
    return least_of_theirs / least_of_ours


def repeated(function: Callable[..., Any], *arguments: Any) -> Callable[[], None]:
    """A run of the compiled function, REPETITIONS times; compiled already."""
    loop, job = function_for("compiled", repeat), arguments_for("compiled", function)
    bound = arguments_for("compiled", arguments)
    loop(job, bound, 1)
    return lambda: loop(job, bound, REPETITIONS)
