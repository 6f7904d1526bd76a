"""Core time that something else had while a job was ready: a hypervisor, interrupts, switches between the threads.

A busy period begins when a job is ready and ends when none is. Both threads are on one core, so it is as long as their
jobs had CPU time, and what is more was taken from them. A job that waits because the other thread runs has lost
nothing: priorities in the wrong order disturb no cycle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from studies.live.design import Design
from studies.live.jobs import Job

NEAR = Fraction(2, 100)
"""Relative to its speed, how near a step of the staircase may be for little that is taken to change where corrections
land."""
TICKS_NS = 20_000_000
"""By which the kernel's figure of idle time may be wrong."""


class Busy(NamedTuple):
    """A busy period, in ns. cpu: what jobs had of it."""

    start: int
    end: int
    cpu: int

    @property
    def taken(self) -> int:
        return self.end - self.start - self.cpu


def busy_periods(jobs: Iterable[Job], design: Design, idle: int = 0) -> list[Busy]:
    """In their order. What the thread of a job had beyond its CPU time was taken from it too: a hypervisor may not say
    what it takes, so that the clock of CPU time runs on.

    idle: ns in which the core had nothing to do.
    """
    kept = list(jobs)
    wanted = design.job_ns
    found: list[Busy] = []
    for ready, job in sorted(_ready([*kept, *_never_begun(kept, design, idle)], design)):
        cpu = min(job.cpu, wanted[job.kind])
        if found and ready <= found[-1].end:
            last = found.pop()
            found.append(Busy(last.start, max(last.end, job.end), last.cpu + cpu))
        else:
            found.append(Busy(ready, job.end, cpu))
    return found


def taken_by_cycle(busy: Iterable[Busy], design: Design) -> list[int]:
    """The most that was taken in a busy period of each cycle, ns."""
    most = [0] * (design.cycles + 1)
    for period in busy:
        for cycle in range(period.start // design.cycle_ns, (period.end - 1) // design.cycle_ns + 1):
            if cycle <= design.cycles:
                most[cycle] = max(most[cycle], period.taken)
    return most[1:]


def may_be_taken(design: Design, predicted: int) -> Fraction:
    """What 2 % of the speed make up from m to l, ns: so much may be taken at a speed 2 % above a step, and corrections
    still land as predicted."""
    return (predicted - design.M) * design.period_ns * NEAR / (1 + NEAR)


def disturbed(taken: Sequence[int], design: Design, predicted: int) -> list[bool]:
    """By cycle, of `taken_by_cycle`: whether more than that was taken in a busy period that it has part in. Nothing
    else carries over from cycle to cycle, for what is late there goes on in one busy period."""
    most = may_be_taken(design, predicted)
    return [each > most for each in taken]


def _never_begun(jobs: Sequence[Job], design: Design, idle: int) -> list[Job]:
    """Updates of measurements that HR has sent to LR, and for which LR got no core to the end of the run: as jobs of no
    length there. None if the core stood idle for one of them, for then nothing was taken from LR."""
    end, sent, updated = design.steps * design.period_ns, {0}, set()
    for job in jobs:
        end = max(end, job.end)
        if job.kind == "hr_restart":
            sent.add(job.step - 1)
        elif job.kind == "lr_update":
            updated.add(job.step)
    waiting = sorted(sent - updated)
    if waiting and _stood_idle(jobs, design, idle, (waiting[0] + design.M) * design.period_ns):
        return []
    return [Job("lr_update", k, end, end, 0) for k in waiting]


def _stood_idle(jobs: Iterable[Job], design: Design, idle: int, ready: int) -> bool:
    """Whether the core had nothing to do for as long as an update takes after it was ready: more than it can have had
    before."""
    before = ready - sum(job.cpu for job in jobs if job.end <= ready)
    return idle - before >= design.job_ns["lr_update"] + TICKS_NS


def _ready(jobs: Iterable[Job], design: Design) -> Iterator[tuple[int, Job]]:
    """Each job with the instant from which it could have run."""
    high_done: dict[int, int] = {}
    propagated: dict[int, int] = {}
    for job in jobs:  # those of HR come first
        ready = job.start
        if job.high:
            ready = high_done.get(job.step, job.step * design.period_ns)
            high_done[job.step] = job.end
        elif job.kind == "lr_propagate":
            ready = high_done.get(job.step, ready)
            propagated[job.step] = job.end
        elif job.kind == "lr_update":
            ready = max((job.step + design.M) * design.period_ns, propagated.get(job.step, 0))
        yield min(ready, job.start), job
