"""How far a simulation has come."""

from __future__ import annotations

from collections.abc import Callable

from sched_sim.schedule.jobs import Job

OnProgress = Callable[[int, int, str], None]
"""Called with (steps done, steps in all, what they are)."""

REPORTS = 100
"""How often progress is told."""


class Clock:
    """A source of no jobs, that tells how far the simulated time is. period: in ticks."""

    def __init__(self, period: int, steps: int, on_progress: OnProgress) -> None:
        self.stride = max(steps // REPORTS, 1)
        self.period = period
        self.steps = steps
        self.on_progress = on_progress
        self.step = 0
        self.next_release = 0

    def release(self) -> tuple[Job, ...]:
        self.on_progress(self.step, self.steps, "HR steps")
        self.step += self.stride
        self.next_release = self.step * self.period
        return ()

    def at_horizon(self) -> tuple[Job, ...]:
        return ()
