"""Whether something else had the machine while jobs were timed on it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from statistics import median, quantiles
from time import perf_counter_ns, thread_time_ns
from typing import NamedTuple

LEAST_SHARE = 0.9
"""Of its processor, that the timing has on an idle machine, and more."""
WIDEST = 2.0
"""The 95th percentile of a job over its median, that few jobs reach on an idle machine."""


class Clocks(NamedTuple):
    """At one moment: of the wall and of what the processor has spent on this thread, in ns."""

    wall_ns: int
    thread_ns: int


class Load(NamedTuple):
    """average: of programs that ran or wanted to over the last minute, if the system tells it."""

    average: float | None
    processors: int


def clocks() -> Clocks:
    """Now."""
    return Clocks(perf_counter_ns(), thread_time_ns())


def load() -> Load:
    """Now; to be asked before anything is compiled, which is a load too."""
    try:
        average = os.getloadavg()[0]
    except (AttributeError, OSError):
        average = None
    return Load(average, os.cpu_count() or 1)


def signs_of_others(before: Load, start: Clocks, end: Clocks, rounds: Iterable[Sequence[int]]) -> str:
    """What says that the machine was busy, in words; empty if nothing does. rounds: the times of each job, in
    ns, where they would be alike on an idle one."""
    signs = []
    share = (end.thread_ns - start.thread_ns) / max(end.wall_ns - start.wall_ns, 1)
    if share < LEAST_SHARE:
        signs.append(f"the timing had {100 * share:.0f} % of its processor")
    if before.average is not None and before.average >= max(1.0, before.processors / 2):
        signs.append(f"load average {before.average:.1f} on {before.processors} processors before it")
    spreads = [quantiles(each, n=20)[-1] / max(median(each), 1) for each in rounds]
    if spreads and median(spreads) > WIDEST:
        signs.append(f"p95 is {median(spreads):.1f} times the median, in half of the jobs or more")
    return ", ".join(signs)
