"""Whether a period is one that the clocks and the kernel of this machine resolve."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Mapping
from math import ceil
from typing import NamedTuple

from sched_sim.errors import InputError, option
from studies.live.design import Design, rounded_up
from studies.live.jobs import Ran
from studies.live.landed import wake_ups
from studies.live.program import Program
from studies.live.taken import may_be_taken

PERIOD_NS, STEPS = 1_000_000, 100
"""Of the probe."""
SHORTEST_NS = 1_000
"""No clock is asked about less."""
WAKE_UPS, TIMES = 10, 10
"""So many wake-ups disturb no cycle; so often, at the least, each job is done in its CPU time."""


class Resolution(NamedTuple):
    """What is possible here, however busy it is. wake: the least latency of a wake-up, ns; once: what each job takes at
    the least, done once, with a look at the clock, ns of CPU time."""

    wake: float
    once: Mapping[str, float]

    def by_wake(self, design: Design, predicted: int) -> float:
        """The least period in ns by wake-ups, at the design's speed."""
        return float(WAKE_UPS * self.wake * design.period_ns / may_be_taken(design, predicted))

    def by_job(self, design: Design) -> dict[str, float]:
        """The least period in ns by each job, at the design's speed."""
        return {kind: TIMES * ns * design.period_ns / max(design.job_ns[kind], 1) for kind, ns in self.once.items()}


def resolution(program: Program, design: Design, cpu: int) -> Resolution:
    """Takes a tenth of a second and more."""
    short = design._replace(period_ns=PERIOD_NS, cycles=ceil(STEPS / design.N))
    return resolved(program.run(short, cpu, once=True), short)


def resolved(ran: Ran, short: Design) -> Resolution:
    """Of a run in which each job was done once."""
    once: defaultdict[str, list[int]] = defaultdict(list)
    for job in ran.jobs:
        once[job.kind].append(job.cpu)
    return Resolution(min(wake_ups(ran.jobs, short)), {kind: min(times) for kind, times in once.items()})


def check_shortest(design: Design) -> None:
    """Raises InputError for a period of less than a microsecond, before anything is compiled."""
    if design.period_ns < SHORTEST_NS:
        raise InputError(f"{_said(design)}: give at least {SHORTEST_NS / 1e6:g}")


def check_resolved(found: Resolution, design: Design, predicted: int) -> None:
    """Raises InputError that says what was measured here if the period is too short for it."""
    by_job = found.by_job(design)
    longest = max(by_job, key=by_job.__getitem__)
    least = max(found.by_wake(design, predicted), by_job[longest])
    if design.period_ns < least:
        raise InputError(
            f"{_said(design)}, a wake-up here takes {_us(found.wake)} us at the least, and {longest}, done once, "
            f"{_us(found.once[longest])} us of its {_us(design.job_ns[longest])} us: give at least "
            f"{rounded_up(least / 1e6, 2)}"
        )


def _us(ns: float) -> str:
    return f"{float(f'{ns / 1e3:.3g}'):,g}"


def _said(design: Design) -> str:
    clock_ns = 1e9 * time.clock_getres(time.CLOCK_MONOTONIC)
    period = f"{option('period_ms')} {design.period_ns / 1e6:g}"
    return f"{period} is too short to be resolved: the clock ticks every {clock_ns:g} ns"
