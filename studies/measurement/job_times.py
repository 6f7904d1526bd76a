"""How long jobs take, one after the other on one machine.

Each job runs `repetitions` times inside one call, on arguments that rotate from call to call; jobs are shuffled in each
of `rounds` rounds, garbage collection is off, and the least time of a loop that does nothing with the same arguments is
subtracted (passing them costs as much as the smallest jobs). Time is what the processor spends on this thread: time in
which the operating system runs something else is not the job's.
"""

from __future__ import annotations

import gc
import random
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from time import thread_time_ns
from typing import Any, Generic, Literal, NamedTuple, TypeVar

from filters.backends.choose import arguments_for, function_for
from filters.backends.numba_error import gist, is_numbas
from filters.backends.repeat import repeat
from filters.jobs import Job
from sched_sim.compiled import compiles
from sched_sim.errors import InputError
from studies.measurement.busy import clocks, load, signs_of_others

ARGUMENT_SETS = 8

Progress = Callable[[int, int, str], None]
"""Called with (done, total, what)."""

Key = TypeVar("Key", bound=tuple[str, ...])


class Protocol(NamedTuple):
    """How often a job is timed; see the module."""

    rounds: int
    repetitions: int


class Timed(NamedTuple, Generic[Key]):
    """seconds: per run of each job, one figure a round. busy: what says that the machine was, empty if nothing does."""

    seconds: dict[Key, list[float]]
    busy: str


def silent(_done: int, _total: int, _what: str) -> None:
    """No progress shown."""


def time_jobs(
    jobs: Mapping[Key, Job],
    backend: Literal["compiled", "numpy", "c"],
    protocol: Protocol,
    seed: int,
    progress: Progress,
) -> Timed[Key]:
    """What each job takes; a key is the words that name the job.

    Raises InputError for a job with a function of the user's that numba cannot compile, and where it compiles nothing.
    """
    if backend == "compiled":
        check_compiles()
    before, total = load(), len(jobs) + protocol.rounds
    runs, empty_runs = {}, {}
    for done, (key, job) in enumerate(jobs.items()):
        progress(done, total, f"preparing {' '.join(key)}")
        try:
            runs[key] = _timer(job.function, job.arguments, backend, protocol.repetitions)
        except Exception as error:
            if is_numbas(error):
                raise InputError(f"{' '.join(key)} cannot be compiled by numba: {gist(error)}") from error
            raise
        if backend == "c":
            empty_runs[key] = _timer_in_c(job.function, job.arguments, 0)
        else:
            empty_runs[key] = _timer(_nothing, job.arguments, backend, protocol.repetitions)
    times: dict[Key, list[int]] = {key: [] for key in jobs}
    overhead: dict[Key, list[int]] = {key: [] for key in jobs}
    order, shuffle = list(jobs), random.Random(seed)
    start = clocks()
    with no_garbage_collection():
        for round_number in range(protocol.rounds):
            progress(len(jobs) + round_number, total, "timing")
            shuffle.shuffle(order)
            for key in order:
                times[key].append(runs[key](round_number))
                overhead[key].append(empty_runs[key](round_number))
    end = clocks()
    progress(total, total, "timed")
    scale = protocol.repetitions * 1e9
    seconds = {key: [max(each - min(overhead[key]), 1) / scale for each in times[key]] for key in jobs}
    return Timed(seconds, signs_of_others(before, start, end, times.values()))


def check_compiles() -> None:
    """Raises InputError where numba runs in Python what it was asked to compile: other times are measured then."""
    if not compiles():
        raise InputError("NUMBA_DISABLE_JIT is set, and compiled code is to be timed: unset it")


def _timer(
    function: Callable[..., Any],
    arguments: Callable[[int], tuple[Any, ...]],
    backend: Literal["compiled", "numpy", "c"],
    repetitions: int,
) -> Callable[[int], int]:
    """A function that runs the job and says how many nanoseconds all repetitions took; compiled and warm."""
    if backend == "c":
        return _timer_in_c(function, arguments, repetitions)
    sets = [arguments_for(backend, arguments(index)) for index in range(ARGUMENT_SETS)]
    if backend == "compiled":
        loop, job = function_for(backend, repeat), arguments_for(backend, function)
    else:
        loop, job = repeat, function_for(backend, function)

    def run(number: int) -> int:
        chosen = sets[number % ARGUMENT_SETS]
        start = thread_time_ns()
        loop(job, chosen, repetitions)
        return thread_time_ns() - start

    for number in range(ARGUMENT_SETS):
        run(number)
    return run


def _timer_in_c(
    function: Callable[..., Any], arguments: Callable[[int], tuple[Any, ...]], repetitions: int
) -> Callable[[int], int]:
    loops = [function_for("c", function).loop(*arguments(index)) for index in range(ARGUMENT_SETS)]

    def run(number: int) -> int:
        loop = loops[number % ARGUMENT_SETS]
        start = thread_time_ns()
        loop(repetitions)
        return thread_time_ns() - start

    for number in range(ARGUMENT_SETS):
        run(number)
    return run


def _nothing(*_arguments: Any) -> None:
    pass


@contextmanager
def no_garbage_collection() -> Iterator[None]:
    """While jobs are timed."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
