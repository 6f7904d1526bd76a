"""Methods of two rates without delay: an HR job each step, an LR job once in N steps."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import replace
from fractions import Fraction
from functools import cache

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Law, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import MultirateCosts, RobustCosts
from sched_sim.design.timing import Feedback, Timing
from sched_sim.errors import InputError
from sched_sim.schedule.jobs import HR, LR, Job, Parts


class TwoRate(HrSource):
    """An HR job each step; once in N steps, when that of step k finishes, an LR job, whose result is in use by step l.

    high, low: (label, work) of the two; kind: what the LR job is filed under.
    """

    def __init__(
        self,
        high: tuple[str, int],
        low: tuple[str, int],
        kind: str,
        timing: Timing,
        options: Options,
        period: int,
        on_landing: OnLanding,
    ) -> None:
        undelayed = replace(timing, M=0, instants=None)
        check(undelayed)
        super().__init__(undelayed, period, on_landing)
        self.high: Parts = (high,)
        self.low: Parts = (low,)
        self.kind = kind
        self.due = timing.L * period
        self.lr_cpu = options.cpus - 1
        self.ready: list[int] = []  # steps k whose LR job has finished, its result not yet in use

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        self._use(step)
        then = None if step % self.N else self._high_done
        return (Job("hr", step, HR, start, self.next_release, self.high[0][1], self.high, then),)

    def at_horizon(self) -> tuple[Job, ...]:
        self._use(self.step)
        return ()

    def state(self, now: int) -> Hashable:
        return super().state(now), tuple(k - self.step for k in self.ready)

    def _use(self, step: int) -> None:
        for k in self.ready:
            self.on_landing(k // self.N, step - k)
        self.ready.clear()

    def _high_done(self, job: Job, now: int) -> tuple[Job, ...]:
        k = job.step
        due = k * self.period + self.due
        return (Job(self.kind, k, LR, now, due, self.low[0][1], self.low, self._low_done, self.lr_cpu),)

    def _low_done(self, job: Job, _now: int) -> tuple[Job, ...]:
        self.ready.append(job.step)
        return ()


@cache
def law(_feedback: Feedback) -> Law:
    return Law(1, 0, only_first=False, undelayed=True)


def check(timing: Timing, _feedback: Feedback = "next-step") -> None:
    """Raises InputError unless 1 <= L: what the LR job of step k computes is in use in step k + 1 at the earliest."""
    if timing.L < 1:
        raise InputError(
            f"L={timing.L} must be at least 1: what the LR job computes is in use from the next step on; "
            f"give L from 1 to N={timing.N}"
        )


def _multirate_pieces(cost: CostOf, _options: Options) -> MultirateCosts[Fraction]:
    return MultirateCosts(cost("state_update"), cost("covariance_gain"))


def _multirate_source(
    costs: MultirateCosts[int], timing: Timing, options: Options, period: int, on_landing: OnLanding
) -> TwoRate:
    parts = ("SU", costs.state_update), ("CG", costs.covariance_gain)
    return TwoRate(*parts, "lr_gain", timing, options, period, on_landing)


def _multirate_work(costs: MultirateCosts[Fraction], timing: Timing) -> CycleWork:
    return CycleWork(timing.interval * costs.state_update, costs.covariance_gain)


def _robust_pieces(cost: CostOf, _options: Options) -> RobustCosts[Fraction]:
    return RobustCosts(cost("inertial"), cost("robust_step"))


def _robust_source(
    costs: RobustCosts[int], timing: Timing, options: Options, period: int, on_landing: OnLanding
) -> TwoRate:
    parts = ("IP", costs.inertial), ("RS", costs.robust_step)
    return TwoRate(*parts, "lr_step", timing, options, period, on_landing)


def _robust_work(costs: RobustCosts[Fraction], timing: Timing) -> CycleWork:
    return CycleWork(timing.interval * costs.inertial, costs.robust_step)


MULTIRATE = Method(_multirate_pieces, _multirate_source, _multirate_work, law, check)
ROBUST = Method(_robust_pieces, _robust_source, _robust_work, law, check)
