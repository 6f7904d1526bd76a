"""What the processor runs: jobs, and the sources that release them."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Protocol, TypeAlias

Parts: TypeAlias = tuple[tuple[str, int], ...]


HR = 10
LR = 20
"""Priorities of the filter's jobs. Smaller is more urgent (as in SimPy); user tasks may take any whole number."""


Then: TypeAlias = "Callable[[Job, int], tuple[Job, ...]]"
"""Called with a job and the time when it has done its parts; may return jobs to release at that instant. If the job is
one of them, it has not finished: see `Job.go_on`."""


class Job:
    """One released piece of work. All times are in ticks.

    kind: what its response times are filed under; step: the HR step it belongs to;
    deadline: the last instant at which it may finish;
    remaining: work left to do, at first the sum of its parts;
    parts: (label, work) in the order they are done;
    then: see `Then`;
    companions: jobs that are done as this one is, with no work of their own;
    overhead: context-switch work charged and not yet done;
    held: the release came while an earlier job of the same chain was unfinished;
    preemptive: whether another job may take its processor before it has finished.
    """

    __slots__ = ("companions", "cpu", "deadline", "held", "kind", "overhead", "parts", "preemptive",
                 "priority", "release", "remaining", "step", "then")  # fmt: skip

    def __init__(
        self,
        kind: str,
        step: int,
        priority: int,
        release: int,
        deadline: int,
        remaining: int,
        parts: Parts,
        then: Then | None = None,
        cpu: int = 0,
        preemptive: bool = True,
    ) -> None:
        self.kind = kind
        self.step = step
        self.priority = priority
        self.release = release
        self.deadline = deadline
        self.remaining = remaining
        self.parts = parts
        self.then = then
        self.cpu = cpu
        self.companions: tuple[Job, ...] = ()
        self.overhead = 0
        self.held = False
        self.preemptive = preemptive

    def go_on(self, parts: Parts, then: Then | None) -> Job:
        """The same job with more to do, for its `then` to return.

        It is still the one that ran last: if nothing else runs first, no context switch is charged.
        """
        self.parts, self.then = parts, then
        self.remaining, self.overhead = sum(work for _, work in parts), 0
        return self

    def state(self, now: int, left: int, overhead: int) -> Hashable:
        """What tells it from others of its source, whenever `now` is; left, overhead: work not yet done."""
        return self.kind, self.release - now, self.deadline - now, left, overhead


def step_at(finish: int, period: int) -> int:
    """The step in which something finished; the last instant of a step belongs to it."""
    return -(-finish // period) - 1


class Source(Protocol):
    """Releases jobs by the clock: the HR loop of a filter, or a user's periodic task."""

    next_release: int  # the instant of the next release, in ticks

    def release(self) -> tuple[Job, ...]:
        """The jobs released at that instant; moves on to the next one."""

    def at_horizon(self) -> tuple[Job, ...]:
        """Called once, when the simulated time is over: the jobs whose release has come but which wait for another job
        to finish first."""


class RecurringSource(Source, Protocol):
    """A source whose releases to come depend on its state alone, and not on chance."""

    def state(self, now: int) -> Hashable:
        """The same at two instants, if what is released from there on is the same."""
