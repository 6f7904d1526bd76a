"""What is at the front of a queue of LR jobs, beside the law of when it is done."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable, Iterable, Mapping
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from sched_sim.design.taken import Taken
from sched_sim.probability.law import add, cut, served
from sched_sim.probability.outcome import Floats
from sched_sim.probability.tally import Tallies
from sched_sim.probability.timeline import Segment, Timeline


class AtFront(Hashable, Protocol):
    """drawn: a job is there, and its work in the law; they are in the order in which a step comes to them."""

    @property
    def drawn(self) -> bool: ...

    def __lt__(self, other: Any, /) -> bool: ...


Front = TypeVar("Front", bound=AtFront)


class LowRate(ABC, Generic[Front]):
    """From step 0 on; as `Serial`. parts: laws of the work up to and with the job at the front, which exclude one
    another; gone: mass that is followed no more."""

    def __init__(self, start: Front, timeline: Timeline, taken: Taken, most: int) -> None:
        self.parts: dict[Front, Floats] = {start: np.ones(1)}
        self.timeline, self.taken, self.most = timeline, taken, most
        self.step, self.weight, self.gone = 0, 1.0, 0.0
        self.tallies = Tallies()

    @property
    def total(self) -> float:
        return sum(float(mass.sum()) for mass in self.parts.values())

    @property
    def behind(self) -> float:
        return self.gone

    def advance(self, end: int, tallies: Tallies) -> None:
        """Up to the start of this step."""
        self.tallies = tallies
        while self.step < end:
            left = self._one_step(self.step)
            self.parts = {}
            for front, mass in left.items():
                self.parts[front], gone = cut(mass, self.most)
                self._leave(self._oldest(front, self.step), gone)
            self.step += 1

    def clear(self) -> dict[Hashable, float]:
        return {front: float(mass[0]) for front, mass in self.parts.items() if not front.drawn}

    def restart(self, key: Any) -> None:
        self.parts, self.gone = {key: np.ones(1)}, 0.0

    def take(self, key: Any) -> float:
        mass = self.parts.get(key)
        if mass is None:
            return 0.0
        taken, mass[0] = float(mass[0]), 0.0
        return taken

    def state(self) -> Mapping[Hashable, Floats]:
        return dict(self.parts.items())

    def _leave(self, cycle: int, gone: float) -> None:
        """This mass is followed no more; of the corrections those before this cycle's have landed."""
        self.gone += gone
        self.tallies[cycle].behind += gone
        self.tallies[cycle].unknown += gone * max(self.taken.before(self.step + 1) - cycle, 1)

    def _run(self, step: int, segment: Segment, begun: dict[Front, Floats]) -> dict[Front, Floats]:
        """What is left at the end of the segment."""
        left: dict[Front, Floats] = {}
        while begun:
            front = min(begun)
            mass = begun.pop(front)
            if not front.drawn:
                add(left, [(front, served(mass, segment.length))])
                continue
            done, rest = mass[: segment.length + 1].copy(), mass[segment.length :]
            if len(rest) > 1:
                rest[0] = 0.0
                add(left, [(front, rest)])
            if done.any():
                add(begun, self._finished(step, segment, front, done))
        return left

    @abstractmethod
    def _one_step(self, step: int) -> dict[Front, Floats]:
        """What is left at the end of a step."""

    @abstractmethod
    def _oldest(self, front: Front, step: int) -> int:
        """The first cycle whose correction has not landed, at the end of this step."""

    @abstractmethod
    def _finished(self, step: int, segment: Segment, front: Front, done: Floats) -> Iterable[tuple[Front, Floats]]:
        """What follows where the job at the front has finished at these instants of the segment."""
