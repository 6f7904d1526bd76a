"""The dual-rate filter: an HR job each step, and per cycle a chain of LR jobs (Steffes 2014, Figs. 2 and 3)."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable
from fractions import Fraction
from functools import cache

from sched_sim.design.hr_loop import HrSource, OnLanding
from sched_sim.design.method import CostOf, CycleWork, Law, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Feedback, Timing
from sched_sim.design.uneven import others_since
from sched_sim.errors import InputError
from sched_sim.schedule.jobs import HR, LR, Job, Parts, Then, step_at


class DualRate(HrSource):
    """The dual-rate filter: an HR job each step, and per cycle a chain of LR jobs, first in first out:

    LR propagate (when the HR job of step k finishes), the gain if it is precomputed, the LR update (at m). With M >= N,
    LR propagate of the next cycle waits for the LR update of the last, unless the gain is precomputed.

    A correction that lands after the next measurement was taken goes through each cycle since, an HR update for each;
    and those which are not in the state at k, for they land later, are carried there by the LR update of k, with the
    work of an HR update for each (`filters.delayed.low_rate_task`).
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
        self.ordinary: tuple[Parts, int] = (("HRP", costs.hr),), costs.hr
        self.restart: tuple[Parts, int] = (("HRP", costs.hr_restart),), costs.hr_restart
        self.to_apply: deque[int] = deque()  # cycles whose LR update has finished, not yet in the state
        self.in_state = 0  # cycles whose corrections are
        self.next_k, self.cycle = 0, 0  # of the next measurement to be taken
        self.sent = not self.taken.since(-1)  # Phi and Q, in the last step
        self.on_the_way: deque[tuple[int, int]] = deque()  # step m, and how many corrections were not in the state at k
        self.lr_queue: deque[Job] = deque()
        self.lr_busy = False
        self.propagates: deque[Job] = deque()  # released, and not in the queue yet
        self.updates: deque[Job] = deque()
        self.propagates_queued = self.updates_queued = 0

    def release(self) -> tuple[Job, ...]:
        step, start = self.step, self.next_release
        self.step, self.next_release = step + 1, start + self.period
        taken = step == self.next_k
        parts, work = self.restart if self.sent else self.ordinary
        self.sent = taken
        if self.to_apply:
            correction = self._apply(step) * self.costs.hr_update
            work += correction
            parts = (*parts, ("HRU", correction))
        job = Job("hr", step, HR, start, self.next_release, work, parts, self._propagate if taken else None)
        if taken:
            self.on_the_way.append((step + self.M, self.cycle - self.in_state))
            self.cycle += 1
            self.next_k = self.taken.step(self.cycle)
        if self.on_the_way and self.on_the_way[0][0] == step:
            return (job, *self._measurement(step - self.M, start))
        return (job,)

    def at_horizon(self) -> tuple[Job, ...]:
        """The horizon is the start of a step: what has finished by then lands in it."""
        self._apply(self.step)
        return (*self.lr_queue, *self.propagates, *self.updates)

    def state(self, now: int) -> Hashable:
        this = self.cycle
        waiting = (self.lr_queue, self.propagates, self.updates)
        return (
            super().state(now),
            tuple(cycle - this for cycle in self.to_apply),
            self.in_state - this,
            tuple((m - self.step, missing) for m, missing in self.on_the_way),
            tuple(tuple(job.state(now, job.remaining, 0) for job in jobs) for jobs in waiting),
            self.propagates_queued - this,
            self.updates_queued - this,
            self.lr_busy,
        )

    def _apply(self, step: int) -> int:
        """Land the corrections that reach the state in the HR job of `step`; returns how many HR updates they take."""
        cycles = 0
        for cycle in self.to_apply:
            k = self.taken.step(cycle)
            cycles += self._cycles_between(k, step)
            self.on_landing(cycle, step - k)
        self.in_state += len(self.to_apply)
        self.to_apply.clear()
        return cycles

    def _cycles_between(self, k: int, step: int) -> int:
        """Through how many cycles a correction of k goes: one, if the next k is not passed."""
        return max(self.taken.before(step) - self.taken.before(k), 1)

    def _lr_job(self, kind: str, label: str, k: int, release: int, due: int, cost: int, then: Then) -> Job:
        return Job(kind, k, LR, release, k * self.period + due, cost, ((label, cost),), then, self.lr_cpu)

    def _propagate(self, job: Job, now: int) -> tuple[Job, ...]:
        """Phi and Q of the last cycle are sent at k: LR propagate is released."""
        then = self._gain if self.costs.lr_gain else self._early_work_done
        self.propagates.append(
            self._lr_job("lr_propagate", "LRP", job.step, now, self.propagate_due, self.costs.lr_propagate, then)
        )
        return self._enqueue()

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
        _m, missing = self.on_the_way.popleft()
        cost = self.costs.lr_update + missing * self.costs.hr_update
        self.updates.append(self._lr_job("lr_update", "LRU", k, now, self.update_due, cost, self._update_done))
        return self._enqueue()

    def _update_done(self, job: Job, now: int) -> tuple[Job, ...]:
        if not self.same_step:
            self.to_apply.append(self.taken.before(job.step))
            return self._next_in_chain()
        cost = self._cycles_between(job.step, step_at(now, self.period)) * self.costs.hr_update
        due = job.step * self.period + self.update_due
        feedback = Job("hr_update", job.step, HR, now, due, cost, (("HRU", cost),), self._landed)
        return (feedback, *self._next_in_chain())

    def _landed(self, job: Job, now: int) -> tuple[Job, ...]:
        self.in_state += 1
        self.on_landing(self.taken.before(job.step), max(step_at(now, self.period) - job.step, self.M))
        return ()

    def _enqueue(self) -> tuple[Job, ...]:
        """What is released goes into the queue as soon as what it needs is there: an LR update its LR propagate, and LR
        propagate the LR update before it, if that computes the gain."""
        while True:
            needed = 0 if self.costs.lr_gain else self.propagates_queued
            if self.propagates and self.updates_queued >= needed:
                self.propagates_queued += 1
                self.lr_queue.append(self.propagates.popleft())
            elif self.updates and self.updates_queued < self.propagates_queued:
                self.updates_queued += 1
                self.lr_queue.append(self.updates.popleft())
            else:
                return () if self.lr_busy else self._next_lr()

    def _next_in_chain(self) -> tuple[Job, ...]:
        self.lr_busy = False
        for waiting in (*self.lr_queue, *self.propagates, *self.updates):
            waiting.held = True
        return self._next_lr()

    def _next_lr(self) -> tuple[Job, ...]:
        if not self.lr_queue:
            return ()
        self.lr_busy = True
        return (self.lr_queue.popleft(),)


@cache
def law(feedback: Feedback) -> Law:
    after, before = (1, 0) if feedback == "next-step" else (0, 1)
    return Law(after, before, only_first=False, several=True)


def check(timing: Timing, feedback: Feedback) -> None:
    """Raises InputError unless M < L (next-step)."""
    M, L = timing.M, timing.L
    if feedback == "next-step" and L <= M:
        raise InputError(
            f"L={L} must be > M={M}: the dual-rate correction cannot land in the step in which the measurement "
            f"arrives; give L from {M + 1} on (same-step feedback allows L = M)"
        )


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
    """Where corrections land as soon as measurements arrive; later ones go through more cycles."""
    cycles = 1 + others_since(timing, timing.M)
    high = (timing.interval - 1) * costs.hr + costs.hr_restart + cycles * costs.hr_update
    compensation = (cycles - 1) * costs.hr_update
    return CycleWork(high, costs.lr_propagate + costs.lr_gain + costs.lr_update + compensation)


def longest(costs: DualRateCosts[Fraction], timing: Timing) -> Fraction:
    """Of the HR jobs, without HR updates: no less will do, wherever corrections land."""
    return costs.hr_restart if timing.interval == 1 else max(costs.hr, costs.hr_restart)


def binding(kind: str, held: bool, timing: Timing, options: Options) -> str:
    if kind == "hr":
        return kind
    if kind in ("lr_propagate", "lr_gain") and timing.M and options.lr_propagate_by == "m":
        return "lr_propagate"
    return "lr_update" if timing.M and not held and kind in ("lr_update", "hr_update") else "lr_total"


DUAL_RATE = Method(pieces, DualRate, work, law, check, binding=binding, longest=longest)
