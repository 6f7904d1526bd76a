"""The clock that single executions are timed by, and what it adds to them.

It is CLOCK_MONOTONIC, of which compiled code takes a reading in some 20 ns without asking the system. A reading of
CLOCK_THREAD_CPUTIME_ID is a call of the system: it takes longer than a small job, and leaves the caches otherwise than
it found them. So interrupts are in what is timed, as they would be on a board, and where the system ran something else
`switches` says it.
"""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import arguments_for, function_for
from filters.backends.timed import Clock, timed
from filters.jobs import Job
from filters.kernels.place import IntArray
from sched_sim.errors import InputError
from studies.measurement.inputs import inputs_of

READINGS = 10_000
LONGEST, AT_EACH = 150, 60
"""Spins of so many lengths, and how many of each."""


def monotonic() -> Clock:
    """Raises InputError on a system without it."""
    try:
        gettime = ctypes.CDLL(None).clock_gettime
        number = time.CLOCK_MONOTONIC
    except (AttributeError, OSError, TypeError):
        raise InputError(
            "this system has no clock_gettime, by which single executions are timed: measure on Linux or macOS, or "
            "give --backend counted"
        ) from None
    gettime.argtypes, gettime.restype = [ctypes.c_int, ctypes.c_void_p], ctypes.c_int
    return Clock(gettime, number, np.zeros(2, dtype=np.int64))


def described(clock: Clock) -> dict[str, Any]:
    """What two readings with nothing between them take, and by how much readings differ at the least, in ns."""
    nothing = _spans(_nothing, (), clock, READINGS)
    return {
        "name": "CLOCK_MONOTONIC",
        "resolution_ns": _resolution(clock),
        "least_ns": int(nothing.min()),
        "median_ns": int(np.median(nothing)),
        "p99_ns": int(np.quantile(nothing, 0.99)),
    }


def switches() -> int | None:
    """How often the system has run something else in place of this thread so far; None where it does not tell."""
    import resource  # Windows has none

    of_thread = getattr(resource, "RUSAGE_THREAD", None)
    if of_thread is None:
        return None
    usage = resource.getrusage(of_thread)
    return int(usage.ru_nvcsw + usage.ru_nivcsw)


def _resolution(clock: Clock) -> int:
    """Between neighbours of all that is read of work of every length; those 1 ns apart are one, rounded."""
    lengths = [_spans(_spin, (length, np.zeros(1)), clock, AT_EACH) for length in range(LONGEST)]
    read = np.unique(np.concatenate(lengths))
    read = read[read <= np.median(lengths[-1])]
    apart = np.diff(read[np.diff(read, prepend=read[0] - 2) > 1])
    return int(np.median(apart)) if len(apart) else 1


def _spans(job: Callable[..., None], arguments: tuple[Any, ...], clock: Clock, count: int) -> IntArray:
    inputs = inputs_of([Job("", job, lambda _index: arguments)])
    varied = inputs.varied(10 + count, np.random.default_rng(0))
    spans = np.zeros(10 + count, dtype=np.int64)
    function_for("compiled", timed)(arguments_for("compiled", job), arguments, varied, clock, spans)
    return spans[10:]


def _nothing() -> None:
    pass


def _spin(times: int, at: FloatArray) -> None:
    for _ in range(times):
        at[0] = 0.5 * at[0] + 1.0
