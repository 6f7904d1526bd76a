"""Run a job many times within one compiled call, and time each execution by itself.

The clock is an argument, a function of C that numba calls through ctypes: so the machine code can be kept on disk. The
arguments of a job rotate between calls, as in `repeat`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from filters.kernels.place import IntArray

ALLOCATION_FREE = True


class Clock(NamedTuple):
    """clock_gettime of POSIX: gettime(number, address) writes seconds and nanoseconds of a clock to the address, which
    is that of `reading` (2,)."""

    gettime: Callable[..., Any]
    number: int
    reading: IntArray


def timed(job: Callable[..., Any], arguments: tuple[Any, ...], clock: Clock, spans: IntArray) -> None:
    """job(*arguments), as often as `spans` has places: what each execution took, in ns, with two readings' cost."""
    for i in range(len(spans)):
        start = now(clock)
        job(*arguments)
        spans[i] = now(clock) - start


def timed_cold(
    job: Callable[..., Any], arguments: tuple[Any, ...], clock: Clock, spans: IntArray, others: IntArray
) -> None:
    """As `timed`, with work on a line of the cache in each row of `others` (lines, 8) before each execution."""
    for i in range(len(spans)):
        for line in range(len(others)):
            others[line, 0] += 1
        now(clock)  # its own code and data are warm
        start = now(clock)
        job(*arguments)
        spans[i] = now(clock) - start


def timed_in_order(use: Callable[..., Any], arguments: Any, order: IntArray, clock: Clock, spans: IntArray) -> None:
    """The jobs of `one_of`, in the order of their numbers."""
    for i in range(len(order)):
        start = now(clock)
        use(order[i], arguments)
        spans[i] = now(clock) - start


def one_of(jobs: tuple[Callable[..., Any], ...]) -> Callable[[int, Any], None]:
    """use(number, arguments) does the job of this number; arguments: (those of the first, (of the second, ...)), for
    compiled code cannot choose among types by a number."""
    rest: Callable[[int, Any], None] = _no_such_job
    for job in reversed(jobs):
        rest = _first_or(job, rest)
    return rest


def _first_or(job: Callable[..., Any], rest: Callable[[int, Any], None]) -> Callable[[int, Any], None]:
    def use(number: int, arguments: Any) -> None:
        if number == 0:
            job(*arguments[0])
        else:
            rest(number - 1, arguments[1])

    return use


def _no_such_job(_number: int, _arguments: Any) -> None:
    pass


def now(clock: Clock) -> int:
    """In ns."""
    clock.gettime(clock.number, clock.reading.ctypes)
    nanoseconds: int = clock.reading[0] * 1_000_000_000 + clock.reading[1]
    return nanoseconds
