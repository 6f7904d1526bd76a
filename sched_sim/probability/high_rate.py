"""The work of each HR job, as a law: of a serial method all that it does, of dual-rate with the corrections that land.

Written from the timeline (`design.cycle`), not from the sources of the simulation. What a step does so many times is so
many independent executions: a replay of M steps is the sum of M draws.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import NamedTuple, Protocol

from sched_sim.design.taken import Taken
from sched_sim.probability.delay import Delay
from sched_sim.probability.law import Law

Counts = Mapping[str, int]
"""How often each piece runs."""


class Branch(NamedTuple):
    """One way an HR job may be. key: what the next one must know; arrived: by how many steps measurements are late that
    arrive in this step and land with it."""

    probability: float
    key: Hashable
    cost: Law
    arrived: tuple[int, ...] = ()


class HighRate(Protocol):
    def branches(self, step: int, key: Hashable) -> list[Branch]:
        """Their probabilities sum to 1; at first the key is 0."""


class Pieces:
    """The laws of the pieces, and of any number of each together."""

    def __init__(self, laws: Mapping[str, Law]) -> None:
        self.laws = laws
        self._known: dict[tuple[tuple[str, int], ...], Law] = {}

    def together(self, counts: Counts) -> Law:
        named = tuple(sorted((name, count) for name, count in counts.items() if count))
        if named not in self._known:
            law = self.laws[named[0][0]].times(0) if named else next(iter(self.laws.values())).times(0)
            for name, count in named:
                law = law.and_then(self.laws[name].times(count))
            self._known[named] = law
        return self._known[named]


class Work(Protocol):
    """How often an HR job of a serial method runs each piece."""

    def __call__(self, step: int, age: int, waiting: bool, arrived: tuple[int, ...]) -> Counts:
        """age: steps since the last k; of a measurement that arrives in the next k itself, N. waiting: for one taken in
        an earlier step, at the start of this one."""


class CertainDelay:
    """Measurements arrive M steps after k, each. work: by step."""

    def __init__(self, pieces: Pieces, work: StepWork, taken: Taken, M: int) -> None:
        self.pieces, self.work, self.taken, self.M = pieces, work, taken, M

    def branches(self, step: int, key: Hashable) -> list[Branch]:
        lands = step >= self.M and not self.taken.since(step - self.M)
        cost = self.pieces.together(self.work(step, lands))
        return [Branch(1.0, key, cost, (self.M,) if lands else ())]


class StepWork(Protocol):
    def __call__(self, step: int, lands: bool) -> Counts:
        """Of the HR job of this step. lands: whether a measurement arrives in it."""


class RandomDelay:
    """Measurements arrive up to N steps after k, or never; the key is 1 while one is awaited."""

    def __init__(self, pieces: Pieces, work: Work, N: int, delay: Delay) -> None:
        self.pieces, self.work, self.N, self.delay = pieces, work, N, delay

    def branches(self, step: int, key: Hashable) -> list[Branch]:
        waiting, at_k = bool(key), step % self.N == 0
        age = self.N if at_k and waiting else step % self.N
        outcomes: list[tuple[float, tuple[int, ...], bool]] = [(1.0, (), False)]
        if waiting:
            now, later = self.delay.hazard(age)
            outcomes = [(now, (age,), False), (later, (), age < self.delay.longest)]
        if at_k:
            at_once, later = self.delay.hazard(0)
            outcomes = [
                (share * part, (*arrived, *more), bool(self.delay.longest) and not more)
                for share, arrived, _ in outcomes
                for part, more in ((at_once, (0,)), (later, ()))
            ]
        return [
            Branch(share, int(still), self.pieces.together(self.work(step, age, waiting, arrived)), arrived)
            for share, arrived, still in outcomes
            if share
        ]


class Always:
    """The same in each step."""

    def __init__(self, cost: Law) -> None:
        self.cost = cost

    def branches(self, _step: int, key: Hashable) -> list[Branch]:
        return [Branch(1.0, key, self.cost)]


class WithCorrections:
    """The dual-rate filter's; the key is how many HR updates the job has to do."""

    def __init__(self, pieces: Pieces, taken: Taken, always: int = 0) -> None:
        """always: HR updates in each step, whatever lands."""
        self.pieces, self.taken, self.always = pieces, taken, always

    def branches(self, step: int, key: Hashable) -> list[Branch]:
        return [Branch(1.0, 0, self.cost(step, key))]

    def cost(self, step: int, key: Hashable) -> Law:
        assert isinstance(key, int)
        ordinary = "hr" if self.taken.since(step - 1) else "hr_restart"
        return self.pieces.together({ordinary: 1, "hr_update": key + self.always})
