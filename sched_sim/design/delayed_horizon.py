"""The delayed horizon: an HR job each step that predicts, and per cycle, from m on, a chain of two LR jobs.

The first updates at the horizon k and replays until it has caught up with the present: due at l. The second takes the
covariance over N steps to the next k, where the next measurement finds it: due at m + N. The replay is counted over all
steps from k to the one in which it lands, as if it repeated the HR job of that one too.

What the covariance needs of step j is known in step j + 1. The job that waits for it never waits longer than it would
for the processor, but where M = 0: there the last of the N propagations is known only as the measurement arrives, and
is done before the update.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable
from fractions import Fraction
from functools import cache

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Law, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import DelayedHorizonCosts
from sched_sim.design.timing import Feedback, Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.jobs import HR, LR, Job, Parts, step_at


class DelayedHorizon(HrSource):
    """The jobs, one LR job at a time, first in first out."""

    def __init__(
        self, costs: DelayedHorizonCosts[int], timing: Timing, options: Options, period: int, on_landing: OnLanding
    ) -> None:
        check(timing)
        super().__init__(timing, period, on_landing)
        self.costs = costs
        self.L = timing.L
        self.lr_cpu = options.cpus - 1
        self.predict: Parts = (("PR", costs.predict),)
        early = (("LRP", costs.propagate),) if timing.M == 0 else ()
        self.update: Parts = (*early, ("LRU", costs.update), ("R", (timing.M + 1) * costs.replay))
        self.propagations = timing.N - len(early)
        self.replayed = 0  # steps, by the LR update that runs
        self.waiting: deque[Job] = deque()  # LR updates
        self.lr_busy = False
        self.landed: list[int] = []  # steps k whose replay has caught up, not yet in the state

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        self._land(step)
        arrives = step >= self.M and step % self.N == self.M
        after_high = self._measurement if arrives and self.M == 0 else None
        high = Job("hr", step, HR, start, self.next_release, self.costs.predict, self.predict, after_high)
        return (high, *self._measurement(high, start)) if arrives and self.M else (high,)

    def at_horizon(self) -> tuple[Job, ...]:
        self._land(self.step)
        return tuple(self.waiting)

    def state(self, now: int) -> Hashable:
        return (
            super().state(now),
            self.step >= self.M,
            self.replayed,
            tuple(job.state(now, job.remaining, 0) for job in self.waiting),
            self.lr_busy,
            tuple(k - self.step for k in self.landed),
        )

    def _land(self, step: int) -> None:
        for k in self.landed:
            self.on_landing(k // self.N, step - k)
        self.landed.clear()

    def _measurement(self, high: Job, now: int) -> tuple[Job, ...]:
        """That of step k arrives at m: the LR update is released."""
        k = high.step - self.M
        work, due = sum(work for _, work in self.update), (k + self.L) * self.period
        self.waiting.append(Job("lr_update", k, LR, now, due, work, self.update, self._replayed, self.lr_cpu))
        return () if self.lr_busy else self._next_update()

    def _next_update(self) -> tuple[Job, ...]:
        self.lr_busy = bool(self.waiting)
        self.replayed = self.M + 1
        return (self.waiting.popleft(),) if self.waiting else ()

    def _replayed(self, job: Job, now: int) -> tuple[Job, ...]:
        """Whether the present is reached; while it was replayed, steps may have come."""
        lands = step_at(now, self.period) + 1 - job.step
        if lands > self.replayed:
            more, self.replayed = lands - self.replayed, lands
            return (job.go_on((("R", more * self.costs.replay),), self._replayed),)
        self.landed.append(job.step)
        work = self.propagations * self.costs.propagate
        if not work:
            return self._propagated(job, now)
        due = (job.step + self.M + self.N) * self.period
        return (Job("lr_propagate", job.step, LR, now, due, work, (("LRP", work),), self._propagated, self.lr_cpu),)

    def _propagated(self, _job: Job, _now: int) -> tuple[Job, ...]:
        for update in self.waiting:
            update.held = True
        return self._next_update()


@cache
def law(_feedback: Feedback) -> Law:
    return Law(1, 0, only_first=False)


def check(timing: Timing, _feedback: Feedback = "next-step") -> None:
    """Raises InputError unless M < L <= N."""
    N, M, L = timing.N, timing.M, timing.L
    if L <= M:
        advice = (
            f"give L from {M + 1} to N={N}"
            if M < N
            else f"choose {option('method')} recalculate or larsen, which correct the state in that very step"
        )
        raise InputError(
            f"L={L} must be > M={M}: what is replayed cannot be in the state of the step in which the measurement "
            f"arrives; {advice}"
        )


def pieces(cost: CostOf, _options: Options) -> DelayedHorizonCosts[Fraction]:
    return DelayedHorizonCosts(*map(cost, ("predict", "update", "replay", "propagate_covariance")))


def work(costs: DelayedHorizonCosts[Fraction], timing: Timing) -> CycleWork:
    """Where it lands at once; later, there is more to replay."""
    low = costs.update + (timing.M + 1) * costs.replay + timing.interval * costs.propagate
    return CycleWork(timing.interval * costs.predict, low)


def binding(kind: str, held: bool, _timing: Timing, _options: Options) -> str:
    return "lr_propagate" if kind == "lr_update" and held else kind


DELAYED_HORIZON = Method(pieces, DelayedHorizon, work, law, check, binding=binding, work_varies=True)
