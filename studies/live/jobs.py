"""What ran when, as the program says."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from studies.live.design import KINDS


class Job(NamedTuple):
    """A job that has run. kind: of KINDS; step: j of HR, k of LR; start, end: ns from step 0 on, with what preempted it
    between; cpu: ns that its thread had of the core in that time."""

    kind: str
    step: int
    start: int
    end: int
    cpu: int

    @property
    def high(self) -> bool:
        return self.kind.startswith("hr_")


class Ran(NamedTuple):
    """A whole run. jobs: each task's in order; differing: states that are not to the bit those of one thread that does
    the same steps; idle: ns in which the core had nothing to do, in ticks of the kernel, 0 where it is not known."""

    jobs: tuple[Job, ...]
    differing: int
    idle: int = 0


def parsed(lines: Iterable[str]) -> Ran:
    """Of what live.c prints."""
    jobs, differing, idle = [], 0, 0
    for line in lines:
        kind, *numbers = line.split(",")
        if kind in KINDS:
            jobs.append(Job(kind, *map(int, numbers)))
        elif kind == "differing":
            differing = int(numbers[0])
        elif kind == "idle":
            idle = int(numbers[0])
    return Ran(tuple(jobs), differing, idle)
