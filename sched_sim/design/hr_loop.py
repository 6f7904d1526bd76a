"""The clock of a filter's high-rate loop."""

from __future__ import annotations

from collections.abc import Callable, Hashable

from sched_sim.design.timing import Timing
from sched_sim.schedule.jobs import Job, RecurringSource

OnLanding = Callable[[int, int], None]
"""Called with (cycle, achieved L) when a correction has reached the state, or a gain is in use."""


class HrSource(RecurringSource):
    """The clock of the HR loop: step j starts at j periods."""

    def __init__(self, timing: Timing, period: int, on_landing: OnLanding) -> None:
        self.N = timing.N
        self.M = timing.M
        self.taken = timing.taken
        self.period = period
        self.step = 0
        self.next_release = 0
        self.on_landing = on_landing

    def at_horizon(self) -> tuple[Job, ...]:
        return ()

    def state(self, now: int) -> Hashable:
        return self.next_release - now, self.step % self.taken.steps
