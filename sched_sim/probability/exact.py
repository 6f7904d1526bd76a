"""Exact probability of misses and late landings of one filter, and the user's tasks beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from sched_sim.design.options import Options
from sched_sim.design.pieces import JobCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.outcome import Probabilities
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import Number

RandomCosts: TypeAlias = JobCosts[Any]
"""The pieces of one method, each a CostDistribution: `DualRateCosts(hr=CostDistribution.certain(63), ...)`."""


def probabilities(
    costs: RandomCosts,
    timing: Timing,
    speed: Number,
    cycles: int = 1000,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    *,
    task_costs: Mapping[str, CostDistribution] | None = None,
    delays: CostDistribution | None = None,
    dropout: float = 0.0,
    preempted: bool = False,
    bins: int | None = None,
    debt: int = 8,
) -> Probabilities:
    """Of the first `cycles` measurement cycles, and in the long run.

    costs: of the method, each piece a `CostDistribution`; speed: cost units the processor does per HR period.
    task_costs: by the name of the task, where its cost is not certain.
    delays: of a measurement, whole HR steps, in place of M; dropout: the probability that it never arrives.
    preempted: recalculate corrects in a job of its own, of LR priority, that catches up with the steps that pass
    meanwhile; else the HR job of m does it.
    bins: of an HR period, to which costs are rounded, up and down; None: none where costs are whole ticks of which a
    period has few. debt: so many cycles behind is followed.
    Raises InputError for what is not had: its message names it.
    """
    raise NotImplementedError
