"""Exact probability of misses and late landings of one filter, and the user's tasks beside it.

The law of what is left to do is followed from step to step (J. L. Diaz et al., Stochastic Analysis of Periodic
Real-Time Systems, RTSS 2002; K. Kim et al., An Exact Stochastic Analysis of Priority-Driven Periodic Real-Time Systems
and Its Approximations, IEEE Transactions on Computers 54 (2005), p. 1460; costs of several values: D. Maxim and
L. Cucu-Grosjean, Response Time Analysis for Fixed-Priority Tasks with Multiple Probabilistic Parameters, RTSS 2013,
p. 224). Nothing is simulated here: `sched_sim.design.simulate` is the oracle of this package, and this package of that.

Where an HR period has too many ticks, costs are rounded to bins, down and up. Of serial methods and tasks every
response time is a maximum of sums of costs, and so does not fall when a cost rises: what comes of costs rounded down is
a lower bound, of those rounded up an upper one. Of dual-rate that is so with same-step feedback for the landings; with
next-step feedback an HR update is charged where it bounds them (`low_rate.Design`). HR jobs of dual-rate may miss
because an LR job took less, for then its correction lands in another step: there the bounds are those of an HR update
in no step and in each. With exact ticks none of this matters.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from sched_sim.bounds import at_least_one
from sched_sim.design.arguments import checked
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, JobCosts
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.probability.bounded import bounded
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.delay import Delay
from sched_sim.probability.followed import follow
from sched_sim.probability.had import check_had
from sched_sim.probability.in_ticks import MOST_TICKS, Given, Rounded, grid_of, pieces_of
from sched_sim.probability.model import Model
from sched_sim.probability.outcome import CycleProbabilities, Probabilities
from sched_sim.probability.tally import Tally
from sched_sim.schedule.clock import OnProgress
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import Number, positive

RandomCosts: TypeAlias = JobCosts[Any]
"""The pieces of one method, each a CostDistribution: `DualRateCosts(hr=CostDistribution.certain(63), ...)`."""

MOST_CYCLES = 100_000


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
    debt: int = 4,
    on_progress: OnProgress | None = None,
) -> Probabilities:
    """Of the first `cycles` measurement cycles, and in the long run.

    costs: of the method, each piece a `CostDistribution`; speed: cost units the processor does per HR period.
    tasks: those less urgent than LR jobs delay nothing and are left out; task_costs: by the name of the task, where its
    cost is not certain.
    delays: of a measurement, whole HR steps, in place of M; dropout: the probability that it never arrives. A lost one
    is awaited by serial methods as long as the longest delay; the dual-rate filter's LR jobs go on without it.
    preempted: recalculate corrects in a job of its own, with the priority of LR jobs, which catches up with the steps
    that pass meanwhile; else the HR job of m does it.
    bins: of an HR period, to which costs are rounded, up and down; None: none where costs are whole ticks of which a
    period has few. debt: so many cycles behind is followed, more if the design has more on their way.
    on_progress: called with the cycles followed, those in all, and what they are; anew for each level of priority, and
    for costs rounded down and up.
    Raises InputError for what is not had: its message names it.
    """
    tasks = checked(timing, options, tasks)
    speed, cycles = positive(speed, "speed"), at_least_one(cycles, "cycles")
    if cycles > MOST_CYCLES:
        raise InputError(f"{option('cycles')} {cycles} is more than {MOST_CYCLES:,}: the long run is computed too")
    if bins is not None:
        bins = at_least_one(bins, "bins")
    debt = at_least_one(debt, "debt")
    pieces = pieces_of(costs)
    delay = _delay(delays, dropout, timing)
    of_tasks = _of_tasks(task_costs or {}, tasks)
    tasks = check_had(costs, timing, options, tasks, delay, preempted=preempted)
    given = Given(pieces, tasks, {task.name: of_tasks[task.name] for task in tasks}, speed)
    grid = grid_of(given, timing.N, bins)
    if (preempted or (options.cpus == 2 and isinstance(costs, DualRateCosts))) and not grid.exact:
        what = option("preempted") if preempted else f"{option('cpus')} 2"
        raise InputError(
            f"{what}: had where all costs are whole ticks of which an HR period has at most {MOST_TICKS}, "
            f"or whole {option('bins')}; round them yourself, up for a cautious estimate"
        )
    rounded: tuple[Rounded, ...] = ("down",) if grid.exact else ("down", "up")
    models = [Model(costs, timing, options, given, grid, each, delay, debt, preempted=preempted) for each in rounded]
    followed = [follow(model, cycles, on_progress) for model in models]
    (lower,), uppers = followed[0].values(), followed[-1]
    arrive = 1.0 if delay is None else 1 - delay.lost

    def between(low: Tally, up: Mapping[int, Tally]) -> CycleProbabilities:
        return bounded(low, up, arrive, exact=grid.exact)

    found = [
        between(low, {charged: each.cycles[number] for charged, each in uppers.items()})
        for number, low in enumerate(lower.cycles)
    ]
    last = {charged: each.long_run for charged, each in uppers.items() if each.long_run is not None}
    in_long_run, why = None, next(filter(None, (model.no_long_run() for model in models)), NOT_SETTLED)
    if lower.long_run is not None and len(last) == len(uppers):
        in_long_run = between(lower.long_run, last)
        why = _not_followed(in_long_run, models[0].debt)
    return Probabilities(found, None if why else in_long_run, why, grid.ticks, grid.exact, 1 - arrive)


RARE, NEVER = 1e-3, 1e-20
"""What is not followed must be so rare among what is late, or so rare anyway: then it does not matter how long it takes
until it is as before."""

NOT_SETTLED = "the distribution of what is left to do does not settle"


def _not_followed(long_run: CycleProbabilities, debt: int) -> str:
    """Why it does not say what happens in the long run; empty if it does."""
    if long_run.behind <= max(RARE * long_run.late.upper, NEVER):
        return ""
    share = min(long_run.behind, 1.0)
    return (
        f"in up to {share:.2g} of the cycles it is more than {debt} cycles behind or has not caught up since, and that "
        f"is not followed: give a faster processor, more {option('bins')} where costs are rounded, or from Python a "
        f"larger debt"
    )


def _delay(delays: CostDistribution | None, dropout: float, timing: Timing) -> Delay | None:
    """None where every measurement is M steps late."""
    if not 0 <= dropout < 1:
        raise InputError(f"{option('dropout')} is {dropout}: it must be a probability from 0 to less than 1")
    if delays is None and not dropout:
        return None
    return Delay.of(CostDistribution.certain(timing.M) if delays is None else delays, dropout)


def _of_tasks(given: Mapping[str, CostDistribution], tasks: Sequence[Task]) -> dict[str, CostDistribution]:
    """By name. Raises InputError for a name that no task has."""
    known = {task.name: CostDistribution.certain(task.cost) for task in tasks}
    for name in given:
        if name not in known:
            raise InputError(f"{option('task_costs')}: there is no task {name!r}, but {', '.join(known) or 'none'}")
    return {**known, **given}
