"""Whether something else had the machine while jobs were timed on it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from math import exp
from statistics import median, quantiles
from time import perf_counter_ns, thread_time_ns
from typing import NamedTuple

LEAST_SHARE = 0.9
"""Of its processor, that the timing has on an idle machine, and more."""
WIDEST = 2.0
"""The 95th percentile of a job over its median, that few jobs reach on an idle machine."""
MINUTE_S = 60.0
"""After which a load average has forgotten all but 1/e of what was."""


class Clocks(NamedTuple):
    """At one moment: of the wall and of what the processor has spent on this thread, in ns."""

    wall_ns: int
    thread_ns: int


class Load(NamedTuple):
    """average: of programs that ran or wanted to over the last minute, if the system tells it; own: what of it this
    process and its children, which have ended, have added."""

    average: float | None
    processors: int
    own: float = 0.0


def clocks() -> Clocks:
    """Now."""
    return Clocks(perf_counter_ns(), thread_time_ns())


def load() -> Load:
    """Now; to be asked before anything is compiled, which is a load too."""
    try:
        average = os.getloadavg()[0]
    except (AttributeError, OSError):
        average = None
    return Load(average, os.cpu_count() or 1, own_load(_spent_s() - SPENT_S, perf_counter_ns() - BEGAN_NS))


def own_load(spent_s: float, elapsed_ns: int) -> float:
    """What a process that spent so much of the processor has added to the load average, if it did so evenly."""
    elapsed_s = max(1e-9 * elapsed_ns, 1e-9)
    return spent_s / elapsed_s * (1 - exp(-elapsed_s / MINUTE_S))


def _spent_s() -> float:
    return sum(os.times()[:4])


BEGAN_NS, SPENT_S = perf_counter_ns(), _spent_s()
"""When this was imported, and what had been spent by then."""


def signs_of_others(before: Load, start: Clocks, end: Clocks, rounds: Iterable[Sequence[int]]) -> str:
    """What says that the machine was busy, in words; empty if nothing does. rounds: the times of each job, in
    ns, where they would be alike on an idle one."""
    signs = []
    share = (end.thread_ns - start.thread_ns) / max(end.wall_ns - start.wall_ns, 1)
    if share < LEAST_SHARE:
        signs.append(f"the timing had {100 * share:.0f} % of its processor")
    if before.average is not None and before.average - before.own >= max(1.0, before.processors / 2):
        own = f", {before.own:.1f} of it its own" if before.own >= 0.05 else ""
        signs.append(f"load average {before.average:.1f} on {before.processors} processors before it{own}")
    spreads = [quantiles(each, n=20)[-1] / max(median(each), 1) for each in rounds]
    if spreads and median(spreads) > WIDEST:
        signs.append(f"p95 is {median(spreads):.1f} times the median, in half of the jobs or more")
    return ", ".join(signs)
