"""Spans of points shared among workers that may die: none is lost, and the point that kills workers is named."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence, Sized
from typing import NamedTuple, Protocol, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")
GivenTask = TypeVar("GivenTask", contravariant=True)
FoundResult = TypeVar("FoundResult", covariant=True)

PER_WORKER = 2
"""Spans under way for each worker: one that runs, one that waits."""

CHECK_S = 0.1
"""How often to look whether to stop."""

DEATHS = 3
"""So many workers may die on one point, alone among them, before it is given up."""


class WorkerDeathError(Exception):
    """Workers die again and again on one point."""

    def __init__(self, point: int) -> None:
        super().__init__(f"worker processes die on point {point}")
        self.point = point


class Trial(NamedTuple):
    """A span to be computed, and how many workers have died on it while it was alone among them."""

    span: range
    deaths: int = 0


class Team(Protocol[GivenTask, FoundResult]):
    """Workers and what they are at."""

    @property
    def under_way(self) -> Sized:
        """The spans that were submitted and not yet collected."""

    @property
    def room(self) -> int:
        """How many spans may be under way."""

    def submit(self, trial: Trial, task: GivenTask) -> None:
        """Begin a span."""

    def collect(self) -> tuple[Sequence[FoundResult], Sequence[Trial]]:
        """What has been computed since, and what was lost with a worker; waits for something, but not long."""

    def finished(self) -> Sequence[FoundResult]:
        """What has been computed by now."""


class Compute(Protocol):
    """Who computes the spans of a sweep: `work(task_of(span))` for each, in order of completion.

    Once `stopped()`, what has been computed is handed out and the rest left. Raises WorkerDeathError with a point that
    workers die on, and whatever `work` raises.
    """

    def __call__(
        self,
        work: Callable[[Task], Result],
        spans: Iterator[range],
        task_of: Callable[[range], Task],
        stopped: Callable[[], bool],
    ) -> Iterator[Result]: ...


def dispatch(
    team: Team[Task, Result],
    spans: Iterator[range],
    task_of: Callable[[range], Task],
    stopped: Callable[[], bool],
) -> Iterator[Result]:
    """The results of `team`, as `Compute` has them.

    When a worker dies, the spans that were lost are done again, each alone in the team, and one that kills it there is
    cut down to the guilty point.
    """
    again: deque[Trial] = deque()
    while not stopped():
        if again and not team.under_way:
            trial = again.popleft()
            team.submit(trial, task_of(trial.span))
        while not again and len(team.under_way) < team.room and (span := next(spans, None)):
            team.submit(Trial(span), task_of(span))
        if not team.under_way:
            return
        alone = len(team.under_way) == 1
        results, lost = team.collect()
        yield from results
        if lost:
            again.extendleft(reversed(_blame(lost[0]) if alone else lost))
    yield from team.finished()


def _blame(trial: Trial) -> list[Trial]:
    """What to try next of a span that killed its worker while nothing else ran."""
    span, deaths = trial
    if len(span) > 1:
        middle = len(span) // 2
        return [Trial(span[:middle]), Trial(span[middle:])]
    if deaths + 1 == DEATHS:
        raise WorkerDeathError(span.start)
    return [Trial(span, deaths + 1)]
