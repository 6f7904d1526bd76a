"""Each method as a source of jobs (Steffes 2014, Figs 1-3): what is released when, never how it is scheduled."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Hashable
from dataclasses import replace

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
)
from sched_sim.design.timing import Timing, check_dual_rate, check_two_rate
from sched_sim.schedule.jobs import HR, LR, Job, Parts, RecurringSource, Then, step_at

OnLanding = Callable[[int, int], None]
"""Called with (cycle, achieved L) when a correction has reached the state, or a gain is in use."""


def method_source(costs: JobCosts, timing: Timing, options: Options, period: int, on_landing: OnLanding) -> HrSource:
    """The jobs of one filter; `costs` and `period` (the HR period) in ticks.

    Raises InputError for an L that the method cannot have.
    """
    M = timing.M
    match costs:
        case StandardCosts(propagate, update):
            return Serial(propagate, propagate, (("U", update),), replace(timing, M=0), period, on_landing)
        case RecalculateCosts(propagate, update, replay):
            again = (("U", update), ("R", M * replay)) if M else (("U", update),)
            return Serial(propagate, propagate, again, timing, period, on_landing)
        case LarsenCosts(propagate, accumulate, update):
            return Serial(propagate, accumulate, (("U", update),), timing, period, on_landing)
        case DualRateCosts():
            check_dual_rate(timing, options.feedback)
            return DualRate(costs, timing, options, period, on_landing)
        case MultirateCosts(state_update, covariance_gain):
            parts = ("SU", state_update), ("CG", covariance_gain)
            return TwoRate(*parts, "lr_gain", timing, options, period, on_landing)
        case RobustCosts(inertial, robust_step):
            parts = ("IP", inertial), ("RS", robust_step)
            return TwoRate(*parts, "lr_step", timing, options, period, on_landing)


class HrSource(RecurringSource):
    """The clock of the HR loop: step j starts at j periods."""

    def __init__(self, timing: Timing, period: int, on_landing: OnLanding) -> None:
        self.N = timing.N
        self.M = timing.M
        self.period = period
        self.step = 0
        self.next_release = 0
        self.on_landing = on_landing

    def at_horizon(self) -> tuple[Job, ...]:
        return ()

    def state(self, now: int) -> Hashable:
        return self.next_release - now, self.step % self.N


class Serial(HrSource):
    """Standard, recalculate and Larsen: the HR job of step m does all of the update.

    plain: work of an ordinary step, and of steps k+2 .. m, which may accumulate; update: what step m does besides.
    """

    def __init__(
        self, plain: int, accumulate: int, update: Parts, timing: Timing, period: int, on_landing: OnLanding
    ) -> None:
        super().__init__(timing, period, on_landing)
        self.plain: Parts = (("P", plain),)
        self.accumulate: Parts = (("P", accumulate),)
        self.update: Parts = (*(self.accumulate if self.M >= 2 else self.plain), *update)
        self.update_work = sum(work for _, work in self.update)

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        since_k = step % self.N
        if since_k == self.M % self.N and step >= self.M:
            work, parts, then = self.update_work, self.update, self._landed
        else:
            parts, then = self.accumulate if 2 <= since_k < self.M else self.plain, None
            work = parts[0][1]
        return (Job("hr", step, HR, start, self.next_release, work, parts, then),)

    def state(self, now: int) -> Hashable:
        return super().state(now), self.M < self.N or self.step >= self.N

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        k = job.step - self.M
        self.on_landing(k // self.N, step_at(now, self.period) - k)
        return ()


class DualRate(HrSource):
    """The dual-rate filter: an HR job each step, and per cycle a chain of LR jobs in order:

    LR propagate (when the HR job of step k finishes), the gain if it is precomputed, the LR update (at m).
    """

    def __init__(
        self, costs: DualRateCosts, timing: Timing, options: Options, period: int, on_landing: OnLanding
    ) -> None:
        super().__init__(timing, period, on_landing)
        self.costs = costs
        self.same_step = options.feedback == "same-step"
        self.lr_cpu = options.cpus - 1
        by_l = options.lr_propagate_by == "l" or timing.M == 0
        correction_due = timing.L + 1 if self.same_step else timing.L
        self.update_due = correction_due * period
        self.propagate_due = self.update_due if by_l else timing.M * period
        self.restart_offset = 1 % timing.N
        self.ordinary: Parts = (("HRP", costs.hr),)
        self.restart: Parts = (("HRP", costs.hr_restart),)
        self.to_apply: deque[int] = deque()  # cycles whose LR update has finished, not yet in the state
        self.lr_queue: deque[Job] = deque()
        self.lr_busy = False
        self.propagates_released = 0
        self.arrived: deque[Job] = deque()  # LR updates at m whose LR propagate is not released yet

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        offset = step % self.N
        parts = self.restart if offset == self.restart_offset else self.ordinary
        work = parts[0][1]
        if self.to_apply:
            corrections = self._apply(step)
            work += corrections * self.costs.hr_update
            parts = (*parts, ("HRU", corrections * self.costs.hr_update))
        job = Job("hr", step, HR, start, self.next_release, work, parts, None if offset else self._propagate)
        if offset == self.M:
            return (job, *self._measurement(step - offset, start))
        return (job,)

    def at_horizon(self) -> tuple[Job, ...]:
        """The horizon is the start of a step: what has finished by then lands in it."""
        self._apply(self.step)
        return (*self.lr_queue, *self.arrived)

    def state(self, now: int) -> Hashable:
        this = self.step // self.N
        return (
            super().state(now),
            tuple(cycle - this for cycle in self.to_apply),
            tuple(job.state(now, job.remaining, 0) for job in (*self.lr_queue, *self.arrived)),
            self.propagates_released - this,
            self.lr_busy,
        )

    def _apply(self, step: int) -> int:
        """The corrections that reach the state in the HR job of `step`; how many they are."""
        corrections = len(self.to_apply)
        for cycle in self.to_apply:
            self.on_landing(cycle, step - cycle * self.N)
        self.to_apply.clear()
        return corrections

    def _lr_job(self, kind: str, label: str, k: int, release: int, due: int, cost: int, then: Then) -> Job:
        return Job(kind, k, LR, release, k * self.period + due, cost, ((label, cost),), then, self.lr_cpu)

    def _propagate(self, job: Job, now: int) -> tuple[Job, ...]:
        """Phi and Q of the last cycle are sent at k: LR propagate is released."""
        self.propagates_released += 1
        k, cost = job.step, self.costs.lr_propagate
        then = self._gain if self.costs.lr_gain else self._early_work_done
        propagate = self._lr_job("lr_propagate", "LRP", k, now, self.propagate_due, cost, then)
        updates = [self.arrived.popleft()] if self.arrived else []
        return self._enqueue(propagate, *updates)

    def _gain(self, job: Job, now: int) -> tuple[Job, ...]:
        return (
            self._lr_job(
                "lr_gain", "LRG", job.step, now, self.propagate_due, self.costs.lr_gain, self._early_work_done
            ),
        )

    def _early_work_done(self, _job: Job, _now: int) -> tuple[Job, ...]:
        return self._next_in_chain()

    def _measurement(self, k: int, now: int) -> tuple[Job, ...]:
        """The measurement of step k arrives at m: the LR update is released."""
        update = self._lr_job("lr_update", "LRU", k, now, self.update_due, self.costs.lr_update, self._update_done)
        if self.propagates_released * self.N <= k:
            self.arrived.append(update)
            return ()
        return self._enqueue(update)

    def _update_done(self, job: Job, now: int) -> tuple[Job, ...]:
        if not self.same_step:
            self.to_apply.append(job.step // self.N)
            return self._next_in_chain()
        cost = self.costs.hr_update
        due = job.step * self.period + self.update_due
        feedback = Job("hr_update", job.step, HR, now, due, cost, (("HRU", cost),), self._landed)
        return (feedback, *self._next_in_chain())

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        self.on_landing(job.step // self.N, step_at(now, self.period) - job.step)
        return ()

    def _enqueue(self, *jobs: Job) -> tuple[Job, ...]:
        self.lr_queue.extend(jobs)
        return () if self.lr_busy else self._next_lr()

    def _next_in_chain(self) -> tuple[Job, ...]:
        self.lr_busy = False
        for waiting in self.lr_queue:
            waiting.held = True
        return self._next_lr()

    def _next_lr(self) -> tuple[Job, ...]:
        if not self.lr_queue:
            return ()
        self.lr_busy = True
        return (self.lr_queue.popleft(),)


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
        undelayed = replace(timing, M=0)
        check_two_rate(undelayed)
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
