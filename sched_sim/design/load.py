"""The share of their time that the processors work: exact, from the work of one measurement cycle."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
)
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task, check_cpus


def load(costs: JobCosts, timing: Timing, speed: Fraction) -> Fraction:
    """Work of one filter per time: 1 is all of a processor; without context switches. speed: cost units per HR period.

    That it is below 1 is needed, and does not suffice: a deadline may need more for a while (`least_speed`).
    """
    return Fraction(work_of_cycle(costs, timing)) / (timing.N * speed)


def loads(
    costs: JobCosts, timing: Timing, speed: Fraction, options: Options = Options(), tasks: Sequence[Task] = ()
) -> tuple[Fraction, ...]:
    """As `load`, of each processor, the user's tasks included. At a share above 1 work piles up without end.

    Raises InputError for a task on a processor that is not there.
    """
    check_cpus(tasks, options.cpus)
    low = low_rate_work_of_cycle(costs)
    work = [(work_of_cycle(costs, timing) - low) / timing.N, *[Fraction(0)] * (options.cpus - 1)]
    work[-1] += low / timing.N
    for task in tasks:
        work[task.cpu - 1] += task.cost / task.period
    return tuple(share / speed for share in work)


def low_rate_work_of_cycle(costs: JobCosts) -> Fraction:
    """What is done in N steps below the HR jobs, on a processor of its own if there are two."""
    match costs:
        case DualRateCosts():
            return Fraction(costs.lr_propagate + costs.lr_gain + costs.lr_update)
        case MultirateCosts(_, low) | RobustCosts(_, low):
            return Fraction(low)
        case _:
            return Fraction(0)


def work_of_cycle(costs: JobCosts, timing: Timing) -> Fraction:
    """All that is done in N steps, in cost units."""
    N, M = timing.N, timing.M
    work: Fraction
    match costs:
        case StandardCosts(propagate, update):
            work = N * propagate + update
        case RecalculateCosts(propagate, update, replay):
            work = N * propagate + update + M * replay
        case LarsenCosts(propagate, accumulate, update):
            products = max(M - 1, 0)
            work = (N - products) * propagate + products * accumulate + update
        case DualRateCosts(hr, hr_restart, hr_update, lr_propagate, lr_gain, lr_update):
            work = (N - 1) * hr + hr_restart + hr_update + lr_propagate + lr_gain + lr_update
        case MultirateCosts(high, low) | RobustCosts(high, low):
            work = N * high + low
    return work
