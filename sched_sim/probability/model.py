"""A design as processes whose laws are followed, each apart from the others: levels of backlog, LR jobs."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable
from math import ceil
from typing import Any

from sched_sim.design.common_period import common_period
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, JobCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.delay import Delay
from sched_sim.probability.dual_rate import DualRate
from sched_sim.probability.high_rate import Always, CertainDelay, HighRate, Pieces, RandomDelay, WithCorrections
from sched_sim.probability.in_ticks import Given, Grid, Rounded, laws_of, tasks_in_ticks
from sched_sim.probability.level import Level
from sched_sim.probability.long_run import Process
from sched_sim.probability.low_rate import Charge, Design
from sched_sim.probability.preempted import Preempted
from sched_sim.probability.serial import Serial, WorkOf
from sched_sim.probability.timeline import Timeline
from sched_sim.schedule.jobs import HR

LONGEST_HYPERPERIOD = 5_000
"""HR steps."""
FULL = 1 - 1e-12


class Model:
    """With costs rounded one way.

    hyperperiod, begin: steps after which all repeats, and from which on it does; after: cycles until the correction of
    one has landed, or is not followed any more.
    """

    def __init__(
        self,
        costs: JobCosts[Any],
        timing: Timing,
        options: Options,
        given: Given,
        grid: Grid,
        rounded: Rounded,
        delay: Delay | None,
        debt: int,
        *,
        preempted: bool = False,
    ) -> None:
        self.costs, self.timing, self.options, self.delay, self.grid = costs, timing, options, delay, grid
        self.preempted = preempted
        self.rounded, self.taken = rounded, timing.taken
        latest = max(timing.M, timing.L, 0 if delay is None else delay.longest)
        self.debt = debt + latest // timing.N
        self.pieces = Pieces(laws_of(given, grid, rounded))
        tasks = tasks_in_ticks(given, grid, rounded)
        self.timeline = Timeline(grid.ticks, tasks)
        self.hyperperiod = common_period(self.taken.steps, [task.period for task in given.tasks])
        started = max((ceil(task.start) for task in given.tasks), default=0) + latest + 1
        self.begin = ceil(started / self.hyperperiod) * self.hyperperiod
        self.after = self.debt + latest // timing.N + 2
        self.most = (self.debt + 1) * timing.N * grid.ticks
        self.levels = sorted({HR, *(task.priority for task in tasks)})

    @property
    def cycles(self) -> int:
        """In a hyperperiod."""
        return self.hyperperiod * self.taken.count // self.taken.steps

    def processes(self) -> tuple[list[Process], dict[int, list[Process]]]:
        """At the start of step 0: those of which all is known, and the HR jobs with so many HR updates in each step."""
        if self.preempted:
            correction = Preempted(self.pieces, self.timing, self.timeline, self.debt)
            return [correction, *self._apart(self._serial())], {0: []}
        if not isinstance(self.costs, DualRateCosts):
            return self._apart(self._serial()), {0: []}
        design = self._design()
        if design.two_cpus:
            return [DualRate(design, self.timeline, ())], {0: []}
        if not self.grid.exact:
            charged = {each: WithCorrections(self.pieces, self.taken, each) for each in design.charged}
            return [DualRate(design, self.timeline, ())], {each: self._apart(charged[each]) for each in charged}
        high = WithCorrections(self.pieces, self.taken)
        levels = [Level(priority, high, self.timeline, self.most) for priority in self.levels if priority >= HR]
        urgent = [self._level(priority, None) for priority in self.levels if priority < HR]
        return [DualRate(design, self.timeline, levels), *urgent], {0: []}

    def _apart(self, high: HighRate) -> list[Process]:
        return [self._level(priority, high) for priority in self.levels]

    def _level(self, priority: int, high: HighRate | None) -> Serial:
        due = self.timing.M if self.delay is None else self.timing.L
        return Serial(priority, high, self.timeline, self.most, self.taken, due)

    def _serial(self) -> HighRate:
        if self.preempted:
            return Always(self.pieces.laws["propagate"])
        work = WorkOf(self.costs, self.timing)
        if self.delay is not None:
            return RandomDelay(self.pieces, work.at_random, self.timing.N, self.delay)
        M = 0 if method_of(self.costs).law(self.options.feedback).undelayed else self.timing.M
        return CertainDelay(self.pieces, work, self.taken, M)

    def _design(self) -> Design:
        timing, options = self.timing, self.options
        same_step = options.feedback == "same-step"
        update_due = timing.L + same_step
        by_l = options.lr_propagate_by == "l" or timing.M == 0
        charge: Charge = "where it lands" if self.grid.exact else "most" if self.rounded == "up" else "least"
        return Design(
            timing=timing,
            pieces=self.pieces,
            delay=self.delay,
            early_due=update_due if by_l else timing.M,
            update_due=update_due,
            same_step=same_step,
            two_cpus=options.cpus == 2,
            precomputed=bool(self.pieces.laws["lr_gain"].worst),
            charge=charge,
            debt=self.debt,
        )

    def load(self) -> float:
        """The share of its time that the processor with the most to do is busy, in the long run."""
        work, low = self.high_load(0), 0.0
        if isinstance(self.costs, DualRateCosts):
            mean = {name: law.mean for name, law in self.pieces.laws.items()}
            arrive = 1.0 if self.delay is None else 1 - self.delay.lost
            often = self.cycles / (self.hyperperiod * self.grid.ticks)
            work += often * arrive * mean["hr_update"]
            low = often * (mean["lr_propagate"] + mean["lr_gain"] + arrive * mean["lr_update"])
        elif self.preempted:
            low = self._mean_correction() / (self.timing.N * self.grid.ticks)
        return max(work, low) if self.options.cpus == 2 else work + low

    def _mean_correction(self) -> float:
        """At the least: without catching up, and without waiting."""
        return self.pieces.together({"update": 1, "replay": self.timing.M}).mean

    @property
    def recovery(self) -> float:
        """Cycles until what is not followed has caught up again, in the mean, if more HR updates do not keep it busy:
        in each what is left to do falls by the time that is not used (A. Wald's identity)."""
        return (self.debt + 1) / (1 - self.load())

    def high_load(self, updates: int) -> float:
        """Of HR jobs and tasks alone; of dual-rate with so many HR updates in each step."""
        high = self._serial()
        if isinstance(self.costs, DualRateCosts):
            high = WithCorrections(self.pieces, self.taken, updates)
        shares: dict[Hashable, float] = {0: 1.0}
        work = 0.0
        for step in range(self.begin, self.begin + 2 * self.hyperperiod):
            after: defaultdict[Hashable, float] = defaultdict(float)
            for key, share in shares.items():
                for branch in high.branches(step, key):
                    after[branch.key] += share * branch.probability
                    if step >= self.begin + self.hyperperiod:
                        work += share * branch.probability * branch.cost.mean
            shares = after
        tasks = sum(task.cost.mean / task.period for task in self.timeline.tasks)
        return work / (self.hyperperiod * self.grid.ticks) + tasks

    def no_long_run(self) -> str:
        """Why there is none; empty if there may be one."""
        if self.hyperperiod > LONGEST_HYPERPERIOD:
            return (
                f"the tasks repeat together with the measurements only after {self.hyperperiod} HR periods, more than "
                f"{LONGEST_HYPERPERIOD}: round their periods"
            )
        if (load := self.load()) < FULL:
            return ""
        rounding = "" if self.grid.exact else f" with costs rounded {self.rounded} to bins"
        return f"the load is {load:.4g}{rounding}: what is left to do grows without end"
