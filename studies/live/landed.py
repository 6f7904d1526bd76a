"""Where corrections landed, and how late HR woke."""

from __future__ import annotations

from collections.abc import Iterable

from studies.live.design import Design
from studies.live.jobs import Job


def achieved(jobs: Iterable[Job], design: Design) -> list[int | None]:
    """The steps from k to l, by cycle; None for a measurement that was left out. One is on its way at a time, so that
    HR's updates are those of LR in their order."""
    kept = list(jobs)
    taken = [job.step for job in kept if job.kind == "lr_update"]
    put_in = [job.step for job in kept if job.kind == "hr_update"]
    landed = {k: j - k for k, j in zip(taken, put_in, strict=False)}  # the last may not have landed
    return [landed.get(cycle * design.N) for cycle in range(1, design.cycles + 1)]


def wake_ups(jobs: Iterable[Job], design: Design) -> list[int]:
    """Latency of HR by step, from step 1 on, ns: from the start of its period until it ran."""
    first: dict[int, int] = {}
    for job in jobs:
        if job.high:
            first.setdefault(job.step, job.start)
    return [start - step * design.period_ns for step, start in first.items()]
