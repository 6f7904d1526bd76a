"""Stochastic cloning and the carried gain: work at k and at m, and between them little, in an HR job each step.

A measurement of step k is carried in steps k + 1 .. m - 1; the HR job of m corrects before it propagates, so it has
nothing of it to carry. With M > N several are carried at once: at k they are coupled with the one that is taken, and
what is expected of those that were taken since is compensated at m.
"""

from __future__ import annotations

from collections.abc import Hashable
from fractions import Fraction

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Method, lacks_for_several
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CarriedCosts,
    CarriedGainCosts,
    CarriedGainInFlightCosts,
    CloneCosts,
    CloneInFlightCosts,
    CloneSplitCosts,
    beside_others,
    works,
)
from sched_sim.design.serial import law, law_with_several
from sched_sim.design.timing import Timing
from sched_sim.design.uneven import others_since
from sched_sim.schedule.jobs import HR, Job, step_at

CLONE_LABELS, CARRIED_GAIN_LABELS = ("ST", "U"), ("U", "LA")
"""Of the work at k and of that at m."""

BESIDE_OTHERS = ("couple", "compensate")
"""Kinds of costs that only several in flight take."""


class Carried(HrSource):
    """An HR job each step."""

    def __init__(self, costs: CarriedCosts[int], timing: Timing, period: int, on_landing: OnLanding) -> None:
        super().__init__(timing, period, on_landing)
        self.propagate, self.at_k, self.carry, self.at_m = works(costs)[:4]
        self.couple, self.compensate = beside_others(costs)
        self.labels = CLONE_LABELS if isinstance(costs, CloneCosts) else CARRIED_GAIN_LABELS

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        k = step - self.M
        lands = k >= 0 and not self.taken.since(k)
        at_k, at_m = self.labels
        others = max(0, self.taken.before(step) - self.taken.before(k + 1)) if lands else 0
        work = [
            (at_m, self.at_m + others * self.compensate if lands else 0),
            ("P", self.propagate),
            ("CA", self.carried(step) * self.carry),
        ]
        if not self.taken.since(step):
            work.append((at_k, self.at_k + self.carried(step) * self.couple))
        parts = tuple((label, part) for label, part in work if part)
        total = sum(part for _, part in parts)
        return (Job("hr", step, HR, start, self.next_release, total, parts, self._landed if lands else None),)

    def carried(self, step: int) -> int:
        """How many were taken before this step and arrive after it."""
        return max(0, self.taken.before(step) - self.taken.before(max(step - self.M + 1, 0)))

    def state(self, now: int) -> Hashable:
        return super().state(now), min(self.step, self.M) if self.M >= self.N else self.M

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        k = job.step - self.M
        self.on_landing(self.taken.before(k), max(step_at(now, self.period), job.step) - k)
        return ()


def _source(costs: CarriedCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding) -> Carried:
    return Carried(costs, timing, period, on_landing)


def _work(costs: CarriedCosts[Fraction], timing: Timing) -> CycleWork:
    propagate, at_k, carry, at_m = works(costs)[:4]
    couple, compensate = beside_others(costs)
    carried = max(timing.M - 1, 0)
    once = at_k + at_m + others_since(timing, timing.M) * (couple + compensate)
    return CycleWork(timing.interval * propagate + carried * carry + once)


def _clone_pieces(cost: CostOf, _options: Options) -> CloneCosts[Fraction]:
    alone = map(cost, ("propagate", "start", "carry", "update"))
    if lacks := cost.lacks(*BESIDE_OTHERS):
        return CloneCosts(*alone, lacks=lacks)
    return CloneInFlightCosts(*alone, *map(cost, BESIDE_OTHERS))


def _clone_split_pieces(cost: CostOf, _options: Options) -> CloneSplitCosts[Fraction]:
    return CloneSplitCosts(cost("propagate"), cost("start"), cost("carry"), cost("update"))


def _carried_gain_pieces(cost: CostOf, _options: Options) -> CarriedGainCosts[Fraction]:
    alone = map(cost, ("propagate", "update", "carry", "land"))
    if lacks := cost.lacks(*BESIDE_OTHERS):
        return CarriedGainCosts(*alone, lacks=lacks)
    return CarriedGainInFlightCosts(*alone, *map(cost, BESIDE_OTHERS))


def _lacking(costs: CarriedCosts[Fraction], timing: Timing) -> str | None:
    if timing.M <= timing.N or isinstance(costs, CloneInFlightCosts | CarriedGainInFlightCosts):
        return None
    method = "clone" if isinstance(costs, CloneCosts) else "carried-gain"
    return costs.lacks or lacks_for_several(f"[costs.{method}] {', '.join(BESIDE_OTHERS)}")


CLONE = Method(_clone_pieces, _source, _work, law_with_several, lands_in_step_m=True, lacking=_lacking)
CLONE_SPLIT = Method(_clone_split_pieces, _source, _work, law, lands_in_step_m=True)
CARRIED_GAIN = Method(_carried_gain_pieces, _source, _work, law_with_several, lands_in_step_m=True, lacking=_lacking)
