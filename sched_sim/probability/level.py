"""The backlog of all work that is as urgent as some job or more: J. L. Diaz et al., Stochastic Analysis of Periodic
Real-Time Systems, 2002, for fixed priorities.

Between two releases it falls to 0 tick by tick, at a release it grows by one execution (D. V. Lindley, The theory of
queues with a single server, 1952). The response time of a job is the backlog that it meets, its own work, and what more
urgent is released until both are done. Each is a sum of independent executions.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping

import numpy as np

from sched_sim.probability.high_rate import Branch, HighRate
from sched_sim.probability.law import NOTHING, add, cut, served, sum_of
from sched_sim.probability.outcome import Floats
from sched_sim.probability.tally import Tally
from sched_sim.probability.timeline import TaskInTicks, Timeline
from sched_sim.schedule.jobs import HR

LONGEST_RESPONSE = 16
"""Times the backlog that is followed, a response."""

Parts = dict[Hashable, Floats]
"""Laws that exclude one another, by what the next HR job must know."""

Landed = Callable[[int, Branch, Floats], None]
"""Called with the step, how its HR job was, and the mass of its response times."""


class Level:
    """Of one priority, and all that is more urgent. most: ticks of backlog that are followed; gone: mass of more."""

    def __init__(
        self, priority: int, high: HighRate | None, timeline: Timeline, most: int, landed: Landed | None = None
    ) -> None:
        self.priority, self.timeline, self.most, self.landed = priority, timeline, most, landed
        self.high = high if priority >= HR else None
        self.preempted = priority > HR or any(task.priority < priority for task in timeline.tasks)
        self.parts: Parts = {0: np.ones(1)}
        self.gone = 0.0

    @property
    def total(self) -> float:
        return sum(float(mass.sum()) for mass in self.parts.values())

    def settle(self, totals: Mapping[Hashable, float]) -> None:
        """What these parts sum to, as is known from elsewhere: what is not backlog is none."""
        for key in self.parts.keys() | totals.keys():
            mass = self.parts.setdefault(key, np.zeros(1))
            mass[0] = max(totals.get(key, 0.0) - float(mass[1:].sum()), 0.0)

    def run(self, step: int, index: int, tally: Tally, weight: float) -> None:
        """One segment of a step. weight: of each job in the tally."""
        segment = self.timeline.segments(step)[index]
        urgent = [task for task in segment.released if task.priority < self.priority]
        own = [task for task in segment.released if task.priority == self.priority]
        parts = self._with_tasks(self.parts, urgent)
        if self.high is not None and not index:
            parts = self._with_high_rate(parts, step, tally, weight)
        for task in own:
            parts = self._with_tasks(parts, [task])
            response = self._response(parts, step, index, tally)
            tally.responded(task.kind, response)
            tally.job(task.kind, weight, float(response[task.deadline + 1 :].sum()))
        self.parts = {}
        for key, mass in parts.items():
            self.parts[key], gone = cut(served(mass, segment.length), self.most)
            self._leave(gone, tally)

    def _with_tasks(self, parts: Parts, tasks: list[TaskInTicks]) -> Parts:
        for task in tasks:
            parts = {key: task.cost.added_to(mass) for key, mass in parts.items()}
        return parts

    def _with_high_rate(self, parts: Parts, step: int, tally: Tally, weight: float) -> Parts:
        after: Parts = {}
        own = self.priority == HR
        for branch, work in self._branched(parts, step):
            add(after, [(branch.key, work)])
            if own:
                response = self._response({branch.key: work}, step, 0, tally)
                tally.responded("hr", response)
                tally.job("hr", 0.0, float(response[self.timeline.period + 1 :].sum()))
                if self.landed is not None and branch.arrived:
                    self.landed(step, branch, response)
        if own:
            tally.job("hr", weight, 0.0)
        return after

    def _branched(self, parts: Parts, step: int) -> Iterator[tuple[Branch, Floats]]:
        """With the work of the HR job of this step, however it may be."""
        if self.high is not None:
            for key, mass in parts.items():
                for branch in self.high.branches(step, key):
                    yield branch, branch.probability * branch.cost.added_to(mass)

    def _response(self, parts: Parts, step: int, index: int, tally: Tally) -> Floats:
        """From a release at the start of this segment, with all that is ahead of it or as urgent and there."""
        if not self.preempted:
            return sum_of(*parts.values())
        done, at = np.zeros(1), 0
        while parts:
            segment = self.timeline.segments(step)[index]
            left: Parts = {}
            for key, mass in parts.items():
                done = sum_of(done, np.concatenate([np.zeros(at), mass[: segment.length + 1]]))
                rest = mass[segment.length :].copy()
                rest[:1] = 0.0
                if at > LONGEST_RESPONSE * self.most or rest.sum() <= NOTHING:
                    self._leave(float(rest.sum()), tally)
                else:
                    left[key] = rest
            at += segment.length
            step, index = self._next(step, index)
            parts = self._interrupted(left, step, index)
        return done

    def _leave(self, gone: float, tally: Tally) -> None:
        """This mass is followed no more."""
        self.gone += gone
        tally.behind += gone
        tally.unknown += gone

    def _next(self, step: int, index: int) -> tuple[int, int]:
        last = index + 1 == len(self.timeline.segments(step))
        return (step + 1, 0) if last else (step, index + 1)

    def _interrupted(self, parts: Parts, step: int, index: int) -> Parts:
        """With what is more urgent and released at the start of this segment."""
        segment = self.timeline.segments(step)[index]
        parts = self._with_tasks(parts, [task for task in segment.released if task.priority < self.priority])
        if self.high is None or index or self.priority == HR:
            return parts
        after: Parts = {}
        add(after, ((branch.key, work) for branch, work in self._branched(parts, step)))
        return after
