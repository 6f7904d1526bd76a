"""When tasks are released beside the HR loop: each step is cut where one is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from sched_sim.probability.law import Law


class TaskInTicks(NamedTuple):
    """A periodic task; deadline: from its release."""

    kind: str
    priority: int
    first: int
    period: int
    deadline: int
    cost: Law


class Segment(NamedTuple):
    """A stretch of a step in which nothing is released but at its start. start: in the step; released: tasks."""

    start: int
    length: int
    released: tuple[TaskInTicks, ...]


class Timeline:
    """period: of the HR loop, in ticks."""

    def __init__(self, period: int, tasks: Sequence[TaskInTicks]) -> None:
        self.period = period
        self.tasks = tasks
        self._known: dict[int, list[Segment]] = {}

    def segments(self, step: int) -> list[Segment]:
        """The first begins with the step."""
        if step not in self._known:
            if len(self._known) > 100_000:
                self._known.clear()
            self._known[step] = list(self._cut(step * self.period))
        return self._known[step]

    def _cut(self, begin: int) -> Iterator[Segment]:
        instants: dict[int, list[TaskInTicks]] = {0: []}
        for task in self.tasks:
            number = max(-((task.first - begin) // task.period), 0)
            for at in range(task.first + number * task.period - begin, self.period, task.period):
                instants.setdefault(at, []).append(task)
        ends = [*sorted(instants)[1:], self.period]
        for start, end in zip(sorted(instants), ends, strict=True):
            yield Segment(start, end - start, tuple(instants[start]))
