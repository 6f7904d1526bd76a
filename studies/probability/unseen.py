"""What finite samples leave open: below which probability nothing is known, and an upper bound with a worst case."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from sched_sim.design.cycle import cycle_of
from sched_sim.design.drawn import executions, marks
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.stated import StatedCost
from studies.probability.question import Question


@dataclass(frozen=True)
class Resolution:
    """The probability, at 95 % for all samples together, that some execution is slower than all of its sample: in what
    an HR job depends on, and from a measurement to the next. Below it samples say nothing."""

    job: float
    cycle: float

    def of(self, kind: str) -> float:
        """Of a job of this kind: of those that are no HR jobs once in a cycle, that of the cycle."""
        return self.job if kind == "hr" else self.cycle


def resolution(question: Question) -> Resolution:
    """The union over all executions of one HR job, of that which has the most, and of all jobs of a cycle. An HR job of
    the dual-rate filter depends on the whole cycle: where a correction lands is extra work."""
    kinds = tuple(question.costs)
    pieces = marks(question.method, kinds, question.options)
    cycle = cycle_of(pieces, question.latest, question.options)

    def union(*works: int) -> float:
        shares = (count * question.unseen(kind) for work in works for kind, count in executions(work, kinds))
        return min(1.0, sum(shares))

    high = [union(work, 0 if cycle.apart else cycle.correction) for work in cycle.high]
    whole = union(*cycle.high, cycle.correction, *(job.work for job in cycle.low))
    return Resolution(whole if cycle.low else max(high), whole)


def distribution(cost: StatedCost, unseen: float = 0.0) -> CostDistribution:
    """unseen: the probability of the worst case beside what was seen."""
    if cost.probabilities is not None:
        return CostDistribution.of_weights(
            (value, float(share)) for value, share in zip(cost.values, cost.probabilities, strict=True) if share
        )
    each = (1 - unseen) / len(cost.values)
    seen = [(value, each) for value in cost.values]
    if unseen:
        assert cost.worst is not None
        seen.append((cost.worst, unseen))
    return CostDistribution.of_weights(seen)


def with_unseen(question: Question, more: Fraction = Fraction(0)) -> dict[str, CostDistribution]:
    """The costs, with what a sample has not seen at its worst case, or so much more, where it has one."""
    found = {}
    for kind, cost in question.costs.items():
        if cost.is_sample and cost.worst is not None:
            found[kind] = distribution(replace(cost, worst=cost.worst + more), question.unseen(kind))
        else:
            found[kind] = distribution(cost)
    return found
