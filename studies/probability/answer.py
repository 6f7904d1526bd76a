"""The answer: exact probabilities for the stated costs, and beside them what samples leave open."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import fsum
from typing import Any, NamedTuple, cast

from sched_sim.costs.autocorrelation import doubtful
from sched_sim.design.drawn import marks
from sched_sim.design.methods import METHODS
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import RandomCosts, probabilities
from sched_sim.probability.outcome import Bounds, CycleProbabilities, Probabilities
from sched_sim.schedule.clock import OnProgress
from studies.probability.blocks import InBlocks, autocorrelations, in_blocks
from studies.probability.question import Question
from studies.probability.unseen import Resolution, distribution, resolution, with_unseen

Of = Callable[[CycleProbabilities], Bounds | None]
"""One probability of a cycle; None where there is no such job in it."""

NONE = Bounds(0.0, 0.0)


class Figure(NamedTuple):
    """The probability of something, per job or per measurement.

    first: in the mean of the first cycles; last: in the last of them; long_run: None where there is none. floor: below
    it samples say nothing. bound: the most it is in any of the three, with what samples have not seen at its worst
    case; None where there is no such case, and for a single l, of which slower executions may make less too.
    """

    what: str
    per: str
    first: Bounds
    last: Bounds
    long_run: Bounds | None
    floor: float
    bound: float | None


@dataclass(frozen=True)
class Answer:
    """given: for the costs as they are stated; bound: with what samples have not seen at its worst case, None where no
    sample has one; resolution: what samples leave open. correlations: of ranks, by kind of job, of those that
    have samples; blocks: simulated in measured order, None where independence is not doubtful, or that cannot be."""

    question: Question
    given: Probabilities
    bound: Probabilities | None
    resolution: Resolution
    correlations: Mapping[str, float]
    blocks: InBlocks | None

    @property
    def figures(self) -> list[Figure]:
        return [*self.misses, self.late, *self.landings]

    @property
    def misses(self) -> list[Figure]:
        """By kind of job, the HR jobs first."""
        kinds = dict.fromkeys(["hr", *(kind for cycle in _all(self.given) for kind in cycle.misses)])
        return [self._missed(kind) for kind in kinds]

    @property
    def hr_miss(self) -> Figure:
        return self._missed("hr")

    @property
    def late(self) -> Figure:
        """The correction lands later than by the L of the design; of a serial method, than in m."""
        what = f"lands after L = {self.question.due}"
        return self._figure(what, "measurement", lambda cycle: cycle.late, self.resolution.cycle)

    @property
    def landings(self) -> list[Figure]:
        """Where it may land."""
        steps = sorted({L for cycle in _all(self.given) for L, bounds in cycle.landing.items() if bounds.upper})
        return [self._landing(L) for L in steps]

    @property
    def not_followed(self) -> float:
        """The most that is further behind than is followed, and may land at any L."""
        return min(1.0, max(cycle.behind for cycle in _all(self.given)))

    @property
    def any_hr_miss(self) -> Bounds:
        """In the first cycles: at least that of the worst of them, at most the sum over all jobs."""
        each = [cycle.hr_miss for cycle in self.given.cycles]
        jobs = self.question.timing.N
        return Bounds(max(one.lower for one in each), min(1.0, jobs * fsum(one.upper for one in each)))

    @property
    def any_floor(self) -> float:
        """Below it samples say nothing of `any_hr_miss`."""
        return min(1.0, self.question.cycles * self.question.timing.N * self.resolution.job)

    def _missed(self, kind: str) -> Figure:
        return self._figure(f"{kind} missed", "job", lambda cycle: cycle.misses.get(kind), self.resolution.of(kind))

    def _landing(self, L: int) -> Figure:
        what, floor = f"lands at L = {L}", self.resolution.cycle
        figure = self._figure(what, "measurement", lambda cycle: _landing(cycle, L), floor)
        return figure._replace(bound=None)

    def _figure(self, what: str, per: str, of: Of, floor: float) -> Figure:
        first = mean(of, self.given)
        last, long_run = of(self.given.cycles[-1]) or first, self.given.long_run and of(self.given.long_run)
        bound = None
        if self.bound is not None:
            each = [found.upper for cycle in _all(self.bound) if (found := of(cycle)) is not None]
            bound = max(each, default=0.0)
        return Figure(what, per, first, last, long_run or None, floor, bound)


def answer(question: Question, on_progress: OnProgress | None = None) -> Answer:
    """Raises InputError for a design of which nothing is known exactly."""
    given = exactly(question, on_progress)
    worst = any(cost.worst is not None for cost in question.samples.values())
    bound = _with_unseen(question, given, on_progress) if worst else None
    correlations = autocorrelations(question)
    blocks = in_blocks(question) if any(map(doubtful, correlations.values())) else None
    return Answer(question, given, bound, resolution(question), correlations, blocks)


def exactly(question: Question, on_progress: OnProgress | None = None) -> Probabilities:
    """For the costs as they are stated."""
    return _probabilities(question, {kind: distribution(cost) for kind, cost in question.costs.items()}, on_progress)


def _with_unseen(question: Question, given: Probabilities, on_progress: OnProgress | None) -> Probabilities:
    """Upper bounds. Where longer costs may also do good (`probability.dual_rate.Design`), exact costs do not bound
    those that are less, and rounded ones do: the worst case is half a tick more, so that it is rounded."""
    if given.exact and METHODS[question.method].law(question.options.feedback).only_first:
        return _probabilities(question, with_unseen(question), on_progress)
    half = question.speed / given.ticks / 2
    return _probabilities(replace(question, bins=given.ticks), with_unseen(question, half), on_progress)


def _probabilities(
    question: Question, costs: Mapping[str, CostDistribution], on_progress: OnProgress | None
) -> Probabilities:
    return probabilities(
        random_costs(question, costs),
        question.timing,
        question.speed,
        question.cycles,
        question.options,
        question.tasks,
        delays=question.delays,
        dropout=question.dropout,
        preempted=question.preempted,
        bins=question.bins,
        on_progress=on_progress,
    )


def random_costs(question: Question, costs: Mapping[str, CostDistribution]) -> RandomCosts:
    """The pieces of the method, each with its distribution; a piece that does not run takes no time."""
    record: Any = type(marks(question.method, tuple(costs), question.options))
    nothing = CostDistribution.certain(0)
    pieces = {piece: nothing if kind is None else costs[kind] for piece, kind in question.pieces.items()}
    return cast("RandomCosts", record(**pieces))


def _landing(cycle: CycleProbabilities, L: int) -> Bounds:
    """What is too far behind to be followed may land in any step."""
    return cycle.landing.get(L) or Bounds(0.0, min(cycle.behind, 1.0))


def _all(found: Probabilities) -> list[CycleProbabilities]:
    return [*found.cycles, *([] if found.long_run is None else [found.long_run])]


def mean(of: Of, found: Probabilities) -> Bounds:
    """Of the first cycles."""
    each = [bounds for cycle in found.cycles if (bounds := of(cycle)) is not None]
    if not each:
        return NONE
    return Bounds(*(fsum(bounds[side] for bounds in each) / len(each) for side in (0, 1)))
