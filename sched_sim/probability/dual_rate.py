"""The dual-rate filter's low-rate jobs, one after another, behind all that is more urgent.

An LR job finishes when the work of the HR jobs and tasks, and its own, is done: one number, whose law is followed
beside what is discrete, the `Front`. The cost of an LR job is drawn when it comes to the front of the queue. When an LR
update finishes nothing more urgent is left, so that the HR job which lands it meets no backlog but that of tasks
released since: this ties the levels of HR jobs and tasks to the LR jobs, without a law of both numbers together.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import numpy as np

from sched_sim.probability.high_rate import WithCorrections
from sched_sim.probability.law import add, later_of, sum_of
from sched_sim.probability.level import Level
from sched_sim.probability.low_rate import EARLY, FEEDBACK, GAIN, UPDATE, Design, Front
from sched_sim.probability.outcome import Floats
from sched_sim.probability.queue import LowRate
from sched_sim.probability.tally import Tally
from sched_sim.probability.timeline import Segment, Timeline


class DualRate(LowRate[Front]):
    """levels: of HR jobs, and of tasks between them and LR jobs, where they are exact."""

    def __init__(self, design: Design, timeline: Timeline, levels: Sequence[Level]) -> None:
        most = (design.debt + 1) * design.timing.N * timeline.period
        super().__init__(Front(0, EARLY, drawn=False), timeline, design.timing.taken, most)
        self.design, self.levels = design, levels
        self.high = WithCorrections(design.pieces, self.taken)
        self.high_done: Floats | None = None

    @property
    def behind(self) -> float:
        return self.gone + sum(level.gone for level in self.levels)

    def restart(self, key: Any) -> None:
        super().restart(key)
        for level in self.levels:
            level.parts, level.gone = {key.to_apply: np.ones(1)}, 0.0

    def take(self, key: Any) -> float:
        taken = super().take(key)
        self._settle(self.parts)
        return taken

    def state(self) -> Mapping[Hashable, Floats]:
        of_levels: dict[Hashable, Floats] = {
            (number, key): mass for number, level in enumerate(self.levels) for key, mass in level.parts.items()
        }
        return {**super().state(), **of_levels}

    def _one_step(self, step: int) -> dict[Front, Floats]:
        self._judge(step)
        if self.design.two_cpus:
            self._tally(step).job("hr", self.weight, 0.0)
        left: dict[Front, Floats] = {}
        for parts in self._separate():
            if self.design.two_cpus and self._overruns(step, parts):
                for front, mass in parts.items():
                    self._leave(self.taken.before(step) + front.cycle, float(mass.sum()))
            else:
                add(left, self._together(step, parts).items())
        return left

    def _tally(self, step: int) -> Tally:
        """Of the HR jobs and tasks of the cycle that this step is in."""
        return self.tallies[self.taken.before(step + 1) - 1]

    def _oldest(self, front: Front, step: int) -> int:
        return self.taken.before(step + 1) + front.cycle

    def _separate(self) -> list[dict[Front, Floats]]:
        """Those between which nothing is common in this step: on one processor all is, on two the HR job."""
        if not self.design.two_cpus:
            return [self.parts]
        groups: defaultdict[int, dict[Front, Floats]] = defaultdict(dict)
        for front, mass in self.parts.items():
            groups[front.to_apply][front] = mass
        return list(groups.values())

    def _overruns(self, step: int, parts: dict[Front, Floats]) -> bool:
        """Whether the HR job may not be done when the next one comes: no backlog of HR jobs is followed here."""
        (applied,) = {front.to_apply for front in parts}
        return self.high.cost(step, applied).worst > self.timeline.period

    def _together(self, step: int, parts: dict[Front, Floats]) -> dict[Front, Floats]:
        tally = self._tally(step)
        self.high_done = self._high_done(step, parts, tally) if self.design.two_cpus else None
        parts = self._begin(step, parts)
        for index, segment in enumerate(self.timeline.segments(step)):
            for level in self.levels:
                level.run(step, index, tally, self.weight)
            for task in segment.released:
                parts = {front: task.cost.added_to(mass) for front, mass in parts.items()}
            parts = self._run(step, segment, parts)
            for level in self.levels:
                for front, mass in parts.items():
                    if front.stage == FEEDBACK:
                        level.parts[0] = sum_of(level.parts[0], mass)
            self._settle(parts)
        return parts

    def _settle(self, parts: Mapping[Front, Floats]) -> None:
        if not self.levels:
            return
        totals: defaultdict[Hashable, float] = defaultdict(float)
        for front, mass in parts.items():
            totals[front.to_apply] += float(mass.sum())
        for level in self.levels:
            level.settle(totals)

    def _judge(self, step: int) -> None:
        """What is due at the start of this step and not done."""
        design, before = self.design, self.taken.before(step)
        for due, kind in ((design.early_due, "lr_propagate"), (design.update_due, "lr_update")):
            k = step - due
            if k < 0 or self.taken.since(k):
                continue
            cycle, is_update = self.taken.before(k) - before, kind == "lr_update"
            lost = 0.0 if design.delay is None else design.delay.lost
            late = 0.0
            for front, mass in self.parts.items():
                if front.cycle < cycle or (front.cycle == cycle and (is_update or front.stage < UPDATE)):
                    known = front.cycle == cycle and front.stage >= UPDATE
                    late += float(mass.sum()) * (1 - lost if is_update and not known else 1)
            tally, weight = self.tallies[self.taken.before(k)], self.weight
            if is_update:
                tally.due += weight * (1 - lost)
                tally.late += late
            else:
                tally.job(kind, weight, late)

    def _begin(self, step: int, parts: dict[Front, Floats]) -> dict[Front, Floats]:
        """The HR job of this step is released, at k a measurement is taken, at m the LR update is released."""
        at_k = not self.taken.since(step)
        begun: dict[Front, Floats] = {}
        for front, mass in parts.items():
            now = front._replace(to_apply=0)
            if front.stage == FEEDBACK:
                now, mass = self._fed_back(step, now, mass)
            if not self.design.two_cpus:
                applied = 0 if self.design.charge == "least" else front.to_apply
                mass = self.high.cost(step, applied).added_to(mass)
            if at_k:
                now = now._replace(cycle=now.cycle - 1, missing=(*now.missing, -front.cycle))
            if -now.cycle > self.design.debt:
                self._leave(self._oldest(now, step), float(mass.sum()))
                continue
            add(begun, self._looked_up(step, now, mass, first=False))
        return begun

    def _fed_back(self, step: int, front: Front, mass: Floats) -> tuple[Front, Floats]:
        """The HR update that was under way goes on first, and lands in this step; one that does not is not followed."""
        period = self.timeline.period
        cycle = self.taken.before(step) + front.cycle
        self._leave(cycle, float(mass[period + 1 :].sum()))
        mass = mass[: period + 1]
        self.tallies[cycle].landing[step - self.taken.step(cycle)] += float(mass.sum())
        return self._next(front, 0), mass

    def _high_done(self, step: int, parts: dict[Front, Floats], tally: Tally) -> Floats:
        """When the HR job of this step has finished, on a processor of its own, in all these parts."""
        (applied,) = {front.to_apply for front in parts}
        law = self.high.cost(step, applied).mass
        share = sum(float(mass.sum()) for mass in parts.values())
        tally.responded("hr", share * law)
        tally.job("hr", 0.0, share * float(law[self.timeline.period + 1 :].sum()))
        return law

    def _looked_up(self, step: int, front: Front, mass: Floats, *, first: bool) -> list[tuple[Front, Floats]]:
        """With the work of the job at the front, if it is there. first: it has just come to the front."""
        if front.drawn or front.cycle == 0:
            return [(front, mass)]
        if front.stage != UPDATE:
            at_k = front.cycle == -1 and front.stage == EARLY and not self.taken.since(step)
            begins = later_of(mass, self.high_done) if self.high_done is not None and at_k else mass
            law = self.design.pieces.laws["lr_gain" if front.stage == GAIN else "lr_propagate"]
            return [(front._replace(drawn=True), law.added_to(begins))]
        delay, age = self.design.delay, step - self._k(step, front)
        if delay is None:
            there, later, lost = float(age >= self.design.timing.M), float(age < self.design.timing.M), 0.0
        elif first:
            lost = delay.lost
            there, later = (1 - lost) * delay.by(age), (1 - lost) * delay.after(age)
        else:
            (there, later), lost = delay.next(age), 0.0
        found = []
        if there:
            law = self.design.pieces.together({"lr_update": 1, "hr_update": front.missing[0]})
            drawn = front._replace(drawn=True, missing=(0, *front.missing[1:]))
            found.append((drawn, there * law.added_to(mass)))
        if later:
            found.append((front, later * mass))
        if lost:
            found += self._looked_up(step, self._next(front, 0), lost * mass, first=True)
        return found

    def _k(self, step: int, front: Front) -> int:
        """Of its cycle, in this step."""
        return self.taken.step(self.taken.before(step + 1) + front.cycle)

    def _next(self, front: Front, updates: int) -> Front:
        """That of the next cycle, with so many HR updates to do for this one."""
        return Front(front.cycle + 1, EARLY, False, front.to_apply + updates, front.missing[1:])

    def _finished(self, step: int, segment: Segment, front: Front, done: Floats) -> list[tuple[Front, Floats]]:
        """The job at the front has finished at these instants of the segment."""
        if front.stage == EARLY and self.design.precomputed:
            return self._looked_up(step, front._replace(stage=GAIN, drawn=False), done, first=True)
        if front.stage < UPDATE:
            return self._looked_up(step, front._replace(stage=UPDATE, drawn=False), done, first=True)
        k = self._k(step, front)
        cycle = self.taken.before(k)
        tally = self.tallies[cycle]
        if front.stage == FEEDBACK:
            tally.landing[max(step - k, 0)] += float(done.sum())
            return self._looked_up(step, self._next(front, 0), done, first=True)
        if self.design.delay is None:
            waited = (step - k - self.design.timing.M) * self.timeline.period + segment.start
            tally.responded("lr_update", np.concatenate([np.zeros(waited), done]))
        in_state = step if self.design.same_step else step + 1
        updates = max(self.taken.before(in_state) - cycle, 1)
        for charged in self.design.charged:
            if self._with_those_behind(step, cycle, updates) > charged:
                tally.crowded[charged] += float(done.sum())
        correction = self.design.pieces.together({"hr_update": updates})
        if self.design.same_step:
            return [(front._replace(stage=FEEDBACK), correction.added_to(done))]
        tally.landing[in_state - k] += float(done.sum())
        if self.design.charge == "most":
            done = correction.added_to(done)
        return self._looked_up(step, self._next(front, updates), done, first=True)

    def _with_those_behind(self, step: int, cycle: int, updates: int) -> int:
        """HR updates of a correction that finishes in this step, and of all that may finish in the same one behind it,
        at the most: no fewer where it finishes later."""
        M = self.design.timing.M if self.design.delay is None else 0
        arrived = self.taken.before(step - M + 1) - cycle
        return sum(range(updates, updates - min(max(arrived, 1), updates), -1))
