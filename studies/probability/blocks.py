"""The same design simulated with costs in the order in which they were measured, a block of executions at a time.

What is computed exactly has each execution independent of all others. Where one slow execution is followed by another,
that is too good: here a piece's executions come in rows as they were measured, each row begun at random (a circular
block bootstrap: Politis and Romano 1992).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isqrt
from random import Random

from sched_sim.costs.autocorrelation import rank_autocorrelation
from sched_sim.design.drawn import Draw, run_drawn
from sched_sim.probability.stated import StatedCost
from sched_sim.scenario.distribution import wilson
from sched_sim.schedule.tasks import work_and_times
from sched_sim.ticks import ticks_per_unit, to_ticks
from studies.probability.question import Question

MOST_STEPS, MOST_CYCLES = 200_000, 10_000
"""Simulated: a second or three."""
SEED = 1


@dataclass(frozen=True)
class Share:
    """Of `n`, which are not independent of one another, `events`. interval: noise of the simulation, if they were."""

    events: int
    n: int

    @property
    def interval(self) -> tuple[float, float]:
        return wilson(self.events, self.n)

    @property
    def document(self) -> dict[str, object]:
        """For scripts: never a bare 0."""
        least, most = self.interval
        share = {"probability": self.events / self.n if self.events else None}
        return {"events": self.events, "n": self.n, **share, "least": least or None, "most": most}


@dataclass(frozen=True)
class InBlocks:
    """lengths: executions in a block, by kind of job, of those that have samples; missed: HR jobs; late: corrections
    that did not land by L."""

    lengths: dict[str, int]
    cycles: int
    missed: Share
    late: Share


def autocorrelations(question: Question) -> dict[str, float]:
    """Of ranks, by kind of job, of those that have samples: as their file says, else of their order in it."""
    return {
        kind: rank_autocorrelation([float(value) for value in cost.values])
        if cost.autocorrelation is None
        else cost.autocorrelation
        for kind, cost in question.samples.items()
    }


def in_blocks(question: Question) -> InBlocks | None:
    """None where the delay is random or a correction a job of its own: that is not simulated in this way."""
    if question.delays is not None or question.dropout or question.preempted:
        return None
    numbers = [value for cost in question.costs.values() for value in cost.values]
    numbers += [value for task in question.tasks for value in work_and_times(task, question.speed)]
    resolution = ticks_per_unit([question.speed, question.options.context_switch, *numbers])
    cycles = max(min(MOST_CYCLES, MOST_STEPS // question.timing.N), 1)
    lengths = {kind: max(isqrt(len(cost.values)), 1) for kind, cost in question.samples.items()}
    draws = {
        kind: _draws(cost, resolution, Random(f"{SEED} {kind}"), lengths.get(kind))
        for kind, cost in question.costs.items()
    }
    run = run_drawn(
        question.method, draws, question.timing, question.speed, resolution, cycles, question.options, question.tasks
    )
    high = run.schedule.responses["hr"]
    by_L = sum(count for landed, count in run.achieved.items() if landed <= question.due)
    return InBlocks(lengths, cycles, Share(high.misses, high.releases), Share(cycles - by_L, cycles))


def _draws(cost: StatedCost, resolution: int, chance: Random, length: int | None) -> Draw:
    ticks = [to_ticks(value, resolution) for value in cost.values]
    if cost.probabilities is None:
        assert length is not None
        return _row(ticks, length, chance).__next__
    weights = [float(share) for share in cost.probabilities]
    return _independent(ticks, weights, chance).__next__


def _row(ticks: Sequence[int], length: int, chance: Random) -> Iterator[int]:
    while True:
        begin = chance.randrange(len(ticks))
        for number in range(begin, begin + length):
            yield ticks[number % len(ticks)]


def _independent(ticks: Sequence[int], weights: Sequence[float], chance: Random) -> Iterator[int]:
    while True:
        yield from chance.choices(ticks, weights, k=4096)
