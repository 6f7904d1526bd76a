"""Recalculate in a job of its own, that HR jobs preempt: it has to catch up with the steps that pass meanwhile.

As `sched_sim.scenario.source` has it, of one sensor whose corrections have the priority of LR jobs. A measurement that
arrives at m starts a correction: the update, and a replay of M steps, to the state of step m. If it finishes in a later
step it goes on with a replay of each step that has passed, until it finishes in the step whose state it computes: there
it lands. Those that arrive meanwhile wait, and then go together: an update of each, and a replay from the earliest.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from sched_sim.design.timing import Timing
from sched_sim.probability.high_rate import Pieces
from sched_sim.probability.law import Law, add
from sched_sim.probability.outcome import Floats
from sched_sim.probability.queue import LowRate
from sched_sim.probability.timeline import Segment, Timeline


class Underway(NamedTuple):
    """waiting: corrections behind the one that is under way; together: that this one is; passed: steps since that whose
    state it computes; drawn: whether there is one."""

    waiting: int = 0
    together: int = 0
    passed: int = 0

    @property
    def drawn(self) -> bool:
        return self.together > 0

    @property
    def not_landed(self) -> int:
        return self.waiting + self.together


class Preempted(LowRate[Underway]):
    """debt: cycles that a correction may be behind."""

    def __init__(self, pieces: Pieces, timing: Timing, timeline: Timeline, debt: int) -> None:
        super().__init__(Underway(), timeline, timing.taken, (debt + 1) * timing.N * timeline.period)
        self.pieces, self.timing, self.debt = pieces, timing, debt

    def _one_step(self, step: int) -> dict[Underway, Floats]:
        self._judge(step)
        begun: dict[Underway, Floats] = {}
        arrives = step >= self.timing.M and not self.taken.since(step - self.timing.M)
        high = self.pieces.laws["propagate"]
        for front, mass in self.parts.items():
            now = front._replace(passed=front.passed + 1 if front.together else 0)
            mass = high.added_to(mass)
            if arrives:
                now = now._replace(waiting=now.waiting + 1)
            if now.not_landed > self.debt:
                self._leave(self._oldest(now, step), float(mass.sum()))
            elif arrives and not now.together:
                add(begun, [self._started(step, now, mass, aim=step)])
            else:
                add(begun, [(now, mass)])
        for segment in self.timeline.segments(step):
            for task in segment.released:
                begun = {front: task.cost.added_to(mass) for front, mass in begun.items()}
            begun = self._run(step, segment, begun)
        return begun

    def _oldest(self, front: Underway, step: int) -> int:
        return self._arrived(step) - front.not_landed

    def _arrived(self, step: int) -> int:
        """Measurements, up to this step."""
        return self.taken.before(step - self.timing.M + 1) if step >= self.timing.M else 0

    def _judge(self, step: int) -> None:
        """The corrections that are due at the start of this step: at the end of the one before."""
        k = step - self.timing.L - 1
        if k < 0 or self.taken.since(k):
            return
        cycle = self.taken.before(k)
        tally = self.tallies[cycle]
        tally.due += self.weight
        tally.late += sum(
            float(mass.sum()) for front, mass in self.parts.items() if self._oldest(front, step - 1) <= cycle
        )

    def _started(self, step: int, front: Underway, mass: Floats, aim: int) -> tuple[Underway, Floats]:
        """All that wait, to the state of step `aim`."""
        earliest = self.taken.step(self._arrived(step) - front.waiting)
        work = self._work(updates=front.waiting, replays=aim - earliest)
        return Underway(0, front.waiting, step - aim), work.added_to(mass)

    def _work(self, updates: int, replays: int) -> Law:
        return self.pieces.together({"update": updates, "replay": replays})

    def _finished(
        self, step: int, segment: Segment, front: Underway, done: Floats
    ) -> Iterator[tuple[Underway, Floats]]:
        """What finishes at the end of the step finishes in it, and what follows begins in the next one."""
        last = self.timeline.period - segment.start
        within, at_end = done[:last], np.concatenate([np.zeros(last), done[last:]])
        for mass, now in ((within, step), (at_end, step + 1)):
            if not mass.any():
                continue
            if front.passed > 0:
                work = self._work(updates=0, replays=now - step + front.passed)
                yield front._replace(passed=step - now), work.added_to(mass)
                continue
            self._land(step, segment, front, mass)
            waiting = Underway(front.waiting)
            yield self._started(step, waiting, mass, aim=now) if front.waiting else (waiting, mass)

    def _land(self, step: int, segment: Segment, front: Underway, done: Floats) -> None:
        oldest = self._oldest(front, step)
        for cycle in range(oldest, oldest + front.together):
            k = self.taken.step(cycle)
            tally = self.tallies[cycle]
            tally.landing[step - k] += float(done.sum())
            waited = (step - k - self.timing.M) * self.timeline.period + segment.start
            tally.responded("lr_update", np.concatenate([np.zeros(waited), done]))
