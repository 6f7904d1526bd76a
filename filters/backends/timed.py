"""Run a job many times within one compiled call, and time each execution by itself.

The clock is an argument, a function of C that numba calls through ctypes: so the machine code can be kept on disk.

Before each execution its inputs get other values, and a pause of another length passes. With the same inputs for a
thousand executions one would tell of the next; and without pauses so would the steps in which the clock goes, for they
and the loop would keep time together.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from filters.arrays import FloatArray
from filters.kernels.place import IntArray

ALLOCATION_FREE = True


class Clock(NamedTuple):
    """clock_gettime of POSIX: gettime(number, address) writes seconds and nanoseconds of a clock to the address, which
    is that of `reading` (2,)."""

    gettime: Callable[..., Any]
    number: int
    reading: IntArray


class Varied(NamedTuple):
    """Inputs that differ from execution to execution.

    memory (size,): those of all jobs, in which their arguments have them, the numbers of job i from bounds[i] on, up to
    bounds[i + 1]; values (sets, size); which (executions,): the set of each; pauses (executions,): how long, in turns
    of a loop, before each; scratch (1,).
    """

    memory: FloatArray
    bounds: IntArray
    values: FloatArray
    which: IntArray
    pauses: IntArray
    scratch: FloatArray


def timed(job: Callable[..., Any], arguments: tuple[Any, ...], varied: Varied, clock: Clock, spans: IntArray) -> None:
    """job(*arguments), as often as `spans` has places: what each execution took, in ns, with one reading of the
    clock."""
    for i in range(len(spans)):
        vary(varied, i, 0)
        start = now(clock)
        job(*arguments)
        spans[i] = now(clock) - start


def timed_cold(
    job: Callable[..., Any],
    arguments: tuple[Any, ...],
    varied: Varied,
    clock: Clock,
    spans: IntArray,
    others: IntArray,
) -> None:
    """As `timed`, with work on a line of the cache in each row of `others` (lines, 8) before each execution."""
    for i in range(len(spans)):
        vary(varied, i, 0)
        for line in range(len(others)):
            others[line, 0] += 1
        now(clock)  # its own code and data are warm
        start = now(clock)
        job(*arguments)
        spans[i] = now(clock) - start


def timed_in_order(
    use: Callable[..., Any], arguments: Any, varied: Varied, clock: Clock, spans: IntArray, order: IntArray
) -> None:
    """The jobs of `one_of`, in the order of their numbers."""
    for i in range(len(spans)):
        vary(varied, i, order[i])
        start = now(clock)
        use(order[i], arguments)
        spans[i] = now(clock) - start


def vary(varied: Varied, execution: int, job: int) -> None:
    """The inputs of this execution, of this job, and its pause."""
    for place in range(varied.bounds[job], varied.bounds[job + 1]):
        varied.memory[place] = varied.values[varied.which[execution], place]
    for _ in range(varied.pauses[execution]):
        varied.scratch[0] = 0.5 * varied.scratch[0] + 1.0


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
