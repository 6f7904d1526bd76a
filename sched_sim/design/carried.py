"""Stochastic cloning and the carried gain: work at k and at m, and between them little, in an HR job each step.

A measurement of step k is carried in steps k + 1 .. m - 1; the HR job of m corrects before it propagates, so it has
nothing of it to carry. With M > N several are carried at once.
"""

from __future__ import annotations

from collections.abc import Hashable
from fractions import Fraction

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import CarriedGainCosts, CloneCosts
from sched_sim.design.serial import law, law_with_several
from sched_sim.design.timing import Timing
from sched_sim.schedule.jobs import HR, Job, step_at

CLONE_LABELS, CARRIED_GAIN_LABELS = ("ST", "U"), ("U", "LA")
"""Of the work at k and of that at m."""


class Carried(HrSource):
    """An HR job each step. labels: of the work at k and of that at m."""

    def __init__(
        self,
        costs: CarriedGainCosts[int],
        labels: tuple[str, str],
        timing: Timing,
        period: int,
        on_landing: OnLanding,
    ) -> None:
        super().__init__(timing, period, on_landing)
        self.costs = costs
        self.labels = labels

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        k = step - self.M
        lands = k >= 0 and k % self.N == 0
        costs, (at_k, at_m) = self.costs, self.labels
        others = max(0, self.taken_before(step) - self.taken_before(k + 1)) if lands else 0
        work = [
            (at_m, costs.land + others * costs.compensate if lands else 0),
            ("P", costs.propagate),
            ("CA", self.carried(step) * costs.carry),
        ]
        if step % self.N == 0:
            work.append((at_k, costs.update + self.carried(step) * costs.couple))
        parts = tuple((label, part) for label, part in work if part)
        total = sum(part for _, part in parts)
        return (Job("hr", step, HR, start, self.next_release, total, parts, self._landed if lands else None),)

    def taken_before(self, step: int) -> int:
        """How many measurements were taken before this step."""
        return -(-max(step, 0) // self.N)

    def carried(self, step: int) -> int:
        """How many were taken before this step and arrive after it."""
        return max(0, self.taken_before(step) - self.taken_before(step - self.M + 1))

    def state(self, now: int) -> Hashable:
        return super().state(now), min(self.step, self.M) if self.M >= self.N else self.M

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        k = job.step - self.M
        self.on_landing(k // self.N, max(step_at(now, self.period), job.step) - k)
        return ()


def _clone_pieces(cost: CostOf, _options: Options) -> CloneCosts[Fraction]:
    return CloneCosts(cost("propagate"), cost("start"), cost("carry"), cost("update"))


def _clone_source(
    costs: CloneCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding
) -> Carried:
    alone = CarriedGainCosts(costs.propagate, costs.start, costs.carry, costs.update, 0, 0)
    return Carried(alone, CLONE_LABELS, timing, period, on_landing)


def _clone_work(costs: CloneCosts[Fraction], timing: Timing) -> CycleWork:
    carried = max(timing.M - 1, 0)
    return CycleWork(timing.N * costs.propagate + costs.start + carried * costs.carry + costs.update)


def _carried_gain_pieces(cost: CostOf, _options: Options) -> CarriedGainCosts[Fraction]:
    kinds = ("propagate", "update", "carry", "land", "couple", "compensate")
    return CarriedGainCosts(*map(cost, kinds))


def _carried_gain_source(
    costs: CarriedGainCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding
) -> Carried:
    return Carried(costs, CARRIED_GAIN_LABELS, timing, period, on_landing)


def _carried_gain_work(costs: CarriedGainCosts[Fraction], timing: Timing) -> CycleWork:
    carried = max(timing.M - 1, 0)
    once = costs.update + costs.land + carried // timing.N * (costs.couple + costs.compensate)
    return CycleWork(timing.N * costs.propagate + carried * costs.carry + once)


CLONE = Method(_clone_pieces, _clone_source, _clone_work, law, lands_in_step_m=True)
CARRIED_GAIN = Method(
    _carried_gain_pieces, _carried_gain_source, _carried_gain_work, law_with_several, lands_in_step_m=True
)
