"""The dual-rate filter: an HR job each step, and per cycle a chain of LR jobs (Steffes 2014, Figs. 2 and 3)."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable
from fractions import Fraction

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Law, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Feedback, Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.jobs import HR, LR, Job, Parts, Then, step_at


class DualRate(HrSource):
    """The dual-rate filter: an HR job each step, and per cycle a chain of LR jobs in order:

    LR propagate (when the HR job of step k finishes), the gain if it is precomputed, the LR update (at m).
    """

    def __init__(
        self, costs: DualRateCosts[int], timing: Timing, options: Options, period: int, on_landing: OnLanding
    ) -> None:
        check(timing, options.feedback)
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


def law(feedback: Feedback) -> Law:
    return Law(1, 0, only_first=False) if feedback == "next-step" else Law(0, 1, only_first=False)


def _another_method() -> str:
    """Where M = N leaves no step."""
    return f"choose {option('method')} recalculate or larsen, which correct the state in that very step"


def check(timing: Timing, feedback: Feedback) -> None:
    """Raises InputError unless M < L <= N (next-step) or M <= L < N (same-step)."""
    N, M, L = timing.N, timing.M, timing.L
    if feedback == "next-step" and L <= M:
        advice = f"give L from {M + 1} to N={N} (same-step feedback allows L = M)" if M < N else _another_method()
        raise InputError(
            f"L={L} must be > M={M}: the dual-rate correction cannot land in the step in which the measurement "
            f"arrives; {advice}"
        )
    if feedback == "same-step" and L >= N:
        advice = f"give L from {M} to {N - 1}" if M < N else _another_method()
        raise InputError(f"L={L} must be < N={N} with same-step feedback: the correction lands during step l; {advice}")


def pieces(cost: CostOf, options: Options) -> DualRateCosts[Fraction]:
    noise = "" if options.low_rate_noise == "exact" else f"_{options.low_rate_noise}"
    early = options.gain == "precomputed"
    return DualRateCosts(
        hr=cost(f"hr_propagate{noise}"),
        hr_restart=cost("hr_restart"),
        hr_update=cost("hr_update"),
        lr_propagate=cost("lr_propagate_euler" if noise == "_euler" else "lr_propagate"),
        lr_gain=cost("lr_gain") if early else Fraction(0),
        lr_update=cost("lr_correct" if early else "lr_update"),
    )


def work(costs: DualRateCosts[Fraction], timing: Timing) -> CycleWork:
    high = (timing.N - 1) * costs.hr + costs.hr_restart + costs.hr_update
    return CycleWork(high, costs.lr_propagate + costs.lr_gain + costs.lr_update)


def binding(kind: str, held: bool, timing: Timing, options: Options) -> str:
    if kind == "hr":
        return kind
    if kind in ("lr_propagate", "lr_gain") and timing.M and options.lr_propagate_by == "m":
        return "lr_propagate"
    return "lr_update" if timing.M and not held and kind in ("lr_update", "hr_update") else "lr_total"


DUAL_RATE = Method(pieces, DualRate, work, law, check, binding=binding)
