"""Larsen's method where others are measured before one arrives, M > N: one product for each that is on its way.

At k the HR job also computes gain and covariance, which need no measurement; at m it corrects the state, and what was
known at each k since, whose measurements are on their way.
"""

from __future__ import annotations

from collections.abc import Hashable
from fractions import Fraction

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CycleWork, lacks_for_several
from sched_sim.design.pieces import LarsenCosts, LarsenInFlightCosts, product
from sched_sim.design.timing import Timing
from sched_sim.design.uneven import others_since
from sched_sim.schedule.jobs import HR, Job, Parts, step_at

KINDS = ("gain", "correct", "compensate")
"""Of costs that it takes."""


class LarsenInFlight(HrSource):
    """An HR job each step: propagation and products; at m the corrections; at k gain and covariance."""

    def __init__(self, costs: LarsenInFlightCosts[int], timing: Timing, period: int, on_landing: OnLanding) -> None:
        super().__init__(timing, period, on_landing)
        self.costs = costs

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        parts: Parts = (("P", self.costs.propagate + self._products(step) * product(self.costs)),)
        k = step - self.M
        lands = k >= 0 and not self.taken.since(k)
        if lands:
            others = self.taken.before(step) - self.taken.before(k + 1)
            parts = (*parts, ("U", self.costs.correct + others * self.costs.compensate))
        if not self.taken.since(step):
            parts = (*parts, ("G", self.costs.gain))
        work = sum(work for _, work in parts)
        return (Job("hr", step, HR, start, self.next_release, work, parts, self._landed if lands else None),)

    def state(self, now: int) -> Hashable:
        return super().state(now), min(self.step, self.M)

    def _products(self, step: int) -> int:
        """Of the k in step - M .. step - 2: at k + 1 the product is Phi itself."""
        first = max(step - self.M, 0)
        return max(self.taken.before(step - 1) - self.taken.before(first), 0)

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        k = job.step - self.M
        self.on_landing(self.taken.before(k), max(step_at(now, self.period), job.step) - k)
        return ()


def work(costs: LarsenInFlightCosts[Fraction], timing: Timing) -> CycleWork:
    products = (timing.M - 1) * product(costs)
    at_k_and_m = costs.gain + costs.correct + others_since(timing, timing.M) * costs.compensate
    return CycleWork(timing.interval * costs.propagate + products + at_k_and_m)


def lacking(costs: LarsenCosts[Fraction], timing: Timing) -> str | None:
    if timing.M <= timing.N or isinstance(costs, LarsenInFlightCosts):
        return None
    return costs.lacks or lacks_for_several(f"[costs.larsen] {', '.join(KINDS)}")
