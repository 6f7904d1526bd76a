"""How long single executions take: each timed by itself, in the order in which they ran.

Each has inputs drawn among several. They run in blocks of about a millisecond, each one compiled call, so that blocks
of all jobs come by turns, and what slows the machine for a while slows all. The first executions of a block bring back
what Python has driven out of the caches, in a loop until its rarest job has run, and are not kept. A block in which the
system ran something else in place of this thread is timed again.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from time import perf_counter
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.random import Generator

from filters.backends.choose import arguments_for
from filters.backends.compiled import machine_code
from filters.backends.numba_error import gist, is_numbas
from filters.backends.timed import Clock, one_of, timed, timed_cold, timed_in_order
from filters.jobs import Job
from filters.kernels.place import IntArray
from sched_sim.errors import InputError
from studies.measurement.busy import Clocks, clocks
from studies.measurement.clock import switches
from studies.measurement.inputs import Inputs, inputs_of
from studies.measurement.job_times import Progress, no_garbage_collection

Caches: TypeAlias = Literal["warm", "cold"]

BLOCK_SECONDS = 1e-3
MOST_IN_BLOCK = 4000
MOST_IN_ORDER = 20_000_000
WARM_UP = 20
FEW, MANY = 1, 200
"""Executions that tell how long one takes, and how long the call."""
TRIES = 10
FLUSHED = 8 << 20
LINE = 64
"""Bytes that are written to before each execution with cold caches, one word in each line of so many."""
LEAST = 100
"""Executions of a job, however long it takes."""


class Wanted(NamedTuple):
    """executions: of each job; fewer of one that would take longer than so many seconds."""

    executions: int
    seconds: float


class Course(NamedTuple):
    """Executions that belong together: of one job, or of the jobs of a loop.

    run(first, count): what count executions take from the first on, in ns, and all that two readings of the clock take.
    jobs: of each of its executions, which of `names` runs.
    """

    names: Sequence[str]
    jobs: IntArray
    run: Callable[[int, int], IntArray]
    block: int


class Executions(NamedTuple):
    """ns: of each job, in order. began: when. blocks: how many there were; again: how many were timed once more, for
    the system ran something else; disturbed: of how many it did so each time."""

    ns: dict[str, IntArray]
    began: Clocks
    blocks: int
    again: int
    disturbed: int


def alone(name: str, job: Job, caches: Caches, wanted: Wanted, clock: Clock, random: Generator) -> Course:
    """A job by itself. Raises InputError if numba cannot compile it."""
    inputs = inputs_of([job])
    function, arguments = arguments_for("compiled", (job.function, inputs.arguments[0]))
    others, warm_up = [], WARM_UP
    if caches == "cold":
        others, warm_up = [np.zeros((FLUSHED // LINE, LINE // 8), dtype=np.int64)], 1
    loop = _loop(name, timed_cold if others else timed, function, arguments, inputs, clock, *others)

    def spans(count: int) -> IntArray:
        found = np.zeros(warm_up + count, dtype=np.int64)
        loop(function, arguments, inputs.varied(len(found), random), clock, found, *others)
        return found[warm_up:]

    each = _seconds_of_each(spans)
    count = max(LEAST, min(wanted.executions, int(wanted.seconds / each)))
    return Course([name], np.zeros(count, dtype=np.int64), lambda _first, size: spans(size), _block(each))


def in_order(
    names: Sequence[str], jobs: Sequence[Job], order: IntArray, wanted: Wanted, clock: Clock, random: Generator
) -> Course:
    """Jobs that run in an order of their numbers, again and again, until there are as many of the rarest as wanted.

    Raises InputError if numba cannot compile one of them.
    """
    inputs = inputs_of(jobs)
    use, arguments = arguments_for("compiled", (one_of(tuple(job.function for job in jobs)), _nested(inputs.arguments)))
    loop = _loop(" ".join(names), timed_in_order, use, arguments, inputs, clock, order)
    interval = len(order) // int(np.bincount(order, minlength=len(jobs)).min())  # of the rarest, in executions
    warm_up = WARM_UP + min(interval, MOST_IN_BLOCK // 2)

    def spans(first: int, count: int) -> IntArray:
        found = np.zeros(warm_up + count, dtype=np.int64)
        runs = np.take(order, np.arange(first - warm_up, first + count), mode="wrap")
        loop(use, arguments, inputs.varied(len(found), random), clock, found, runs)
        return found[warm_up:]

    each = _seconds_of_each(partial(spans, 0))
    count = min(wanted.executions * interval, int(len(jobs) * wanted.seconds / each), MOST_IN_ORDER)
    ran = np.take(order, np.arange(max(LEAST, 2 * interval, count)), mode="wrap")
    return Course(names, ran, spans, max(_block(each), 2 * warm_up))


def run(courses: Sequence[Course], wanted: Wanted, seed: int, progress: Progress) -> Executions:
    """All of them, their blocks by turns. Of a job that is in several the first counts, and no more than are wanted."""
    began = clocks()
    random = np.random.default_rng(seed)
    turns = []
    for number, course in enumerate(courses):
        firsts = range(0, len(course.jobs), course.block)
        when = (np.arange(len(firsts)) + random.random(len(firsts))) / len(firsts)
        turns += [(at, number, first) for at, first in zip(when.tolist(), firsts, strict=True)]
    spans = [np.zeros(len(course.jobs), dtype=np.int64) for course in courses]
    again = disturbed = 0
    with no_garbage_collection():
        for done, (_, number, first) in enumerate(sorted(turns)):
            if done % 100 == 0:
                progress(done, len(turns), "timing")
            course, kept = courses[number], spans[number][first : first + courses[number].block]
            for _ in range(TRIES):
                before = switches()
                kept[:] = course.run(first, len(kept))
                if switches() == before:
                    break
                again += 1
            else:
                disturbed += 1
    progress(len(turns), len(turns), "timed")
    ns: dict[str, IntArray] = {}
    for course, found in zip(courses, spans, strict=True):
        for number, name in enumerate(course.names):
            if name not in ns:
                ns[name] = found[course.jobs == number][: wanted.executions]
    return Executions(ns, began, len(turns), again, disturbed)


def _nested(arguments: Sequence[tuple[Any, ...]]) -> Any:
    """As `timed.one_of` takes them."""
    nested: Any = ()
    for each in reversed(arguments):
        nested = (each, nested)
    return nested


def _loop(name: str, loop: Any, job: Any, arguments: Any, inputs: Inputs, clock: Clock, *rest: Any) -> Any:
    one = np.zeros(1, dtype=np.int64)
    try:
        return machine_code(loop, job, arguments, inputs.varied(1, np.random.default_rng(0)), clock, one, *rest)
    except Exception as error:
        if is_numbas(error):
            raise InputError(f"{name} cannot be compiled by numba: {gist(error)}") from error
        raise


def _seconds_of_each(spans: Callable[[int], IntArray]) -> float:
    """With the work between, and without the call."""
    few, many = (min(_took(spans, count) for _ in range(3)) for count in (FEW, MANY))
    return max(many - few, 1e-9) / (MANY - FEW)


def _took(spans: Callable[[int], IntArray], count: int) -> float:
    start = perf_counter()
    spans(count)
    return perf_counter() - start


def _block(seconds_of_each: float) -> int:
    return max(1, min(MOST_IN_BLOCK, int(BLOCK_SECONDS / seconds_of_each)))
