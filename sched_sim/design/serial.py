"""Standard, recalculate and Larsen: the HR job of step m does all of the update (Steffes 2014, Fig. 1)."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import replace
from fractions import Fraction
from functools import cache

from sched_sim.design import larsen_in_flight
from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Law, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import LarsenCosts, LarsenInFlightCosts, RecalculateCosts, StandardCosts
from sched_sim.design.timing import Feedback, Timing
from sched_sim.schedule.jobs import HR, Job, Parts, step_at


class Serial(HrSource):
    """An HR job each step.

    plain: an ordinary one; accumulate: those of steps k+2 .. m; update: what that of step m does besides.
    """

    def __init__(
        self, plain: Parts, accumulate: Parts, update: Parts, timing: Timing, period: int, on_landing: OnLanding
    ) -> None:
        super().__init__(timing, period, on_landing)
        self.plain, self.accumulate = plain, accumulate
        self.update: Parts = (*(accumulate if self.M >= 2 else plain), *update)
        self.plain_work, self.accumulate_work, self.update_work = map(_work, (plain, accumulate, self.update))

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        since_k = self.taken.since(step)
        if step >= self.M and not self.taken.since(step - self.M):
            work, parts, then = self.update_work, self.update, self._landed
        elif 2 <= since_k < self.M:
            work, parts, then = self.accumulate_work, self.accumulate, None
        else:
            work, parts, then = self.plain_work, self.plain, None
        return (Job("hr", step, HR, start, self.next_release, work, parts, then),)

    def state(self, now: int) -> Hashable:
        return super().state(now), 0 if self.M < self.N else min(self.step, self.M)

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        k = job.step - self.M
        self.on_landing(self.taken.before(k), max(step_at(now, self.period), job.step) - k)
        return ()


def _work(parts: Parts) -> int:
    return sum(work for _, work in parts)


@cache
def law(_feedback: Feedback) -> Law:
    return Law(0, 0, only_first=True)


@cache
def law_with_several(_feedback: Feedback) -> Law:
    return Law(0, 0, only_first=True, several=True)


def _standard_pieces(cost: CostOf, _options: Options) -> StandardCosts[Fraction]:
    return StandardCosts(cost("propagate"), cost("update"))


def _standard_source(
    costs: StandardCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding
) -> Serial:
    plain, update = (("P", costs.propagate),), (("U", costs.update),)
    return Serial(plain, plain, update, replace(timing, M=0, instants=None), period, on_landing)


def _standard_work(costs: StandardCosts[Fraction], timing: Timing) -> CycleWork:
    return CycleWork(timing.interval * costs.propagate + costs.update)


def _recalculate_pieces(cost: CostOf, _options: Options) -> RecalculateCosts[Fraction]:
    return RecalculateCosts(cost("propagate"), cost("update"), cost("replay"))


def _recalculate_source(
    costs: RecalculateCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding
) -> Serial:
    replay = (("R", timing.M * costs.replay),) if timing.M else ()
    plain, update = (("P", costs.propagate),), (("U", costs.update), *replay)
    return Serial(plain, plain, update, timing, period, on_landing)


def _recalculate_work(costs: RecalculateCosts[Fraction], timing: Timing) -> CycleWork:
    return CycleWork(timing.interval * costs.propagate + costs.update + timing.M * costs.replay)


def _larsen_pieces(cost: CostOf, _options: Options) -> LarsenCosts[Fraction]:
    alone = cost("propagate"), cost("propagate_accumulate"), cost("update")
    if lacks := cost.lacks(*larsen_in_flight.KINDS):
        return LarsenCosts(*alone, lacks=lacks)
    return LarsenInFlightCosts(*alone, *map(cost, larsen_in_flight.KINDS))


def _larsen_source(
    costs: LarsenCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding
) -> HrSource:
    if timing.M > timing.N and isinstance(costs, LarsenInFlightCosts):
        return larsen_in_flight.LarsenInFlight(costs, timing, period, on_landing)
    plain, accumulate = (("P", costs.propagate),), (("P", costs.accumulate),)
    return Serial(plain, accumulate, (("U", costs.update),), timing, period, on_landing)


def _larsen_work(costs: LarsenCosts[Fraction], timing: Timing) -> CycleWork:
    if timing.M > timing.N and isinstance(costs, LarsenInFlightCosts):
        return larsen_in_flight.work(costs, timing)
    products = max(timing.M - 1, 0)
    return CycleWork((timing.interval - products) * costs.propagate + products * costs.accumulate + costs.update)


STANDARD = Method(_standard_pieces, _standard_source, _standard_work, law_with_several)
RECALCULATE = Method(
    _recalculate_pieces, _recalculate_source, _recalculate_work, law_with_several, lands_in_step_m=True
)
LARSEN = Method(
    _larsen_pieces,
    _larsen_source,
    _larsen_work,
    law_with_several,
    lands_in_step_m=True,
    lacking=larsen_in_flight.lacking,
)
