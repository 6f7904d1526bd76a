"""The share of their time that the processors work: exact, from the work of one measurement cycle."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task, check_cpus


def utilization(costs: Costs, timing: Timing, speed: Fraction) -> Fraction:
    """Work of one filter per time: 1 is all of a processor; without context switches. speed: cost units per HR period.

    That it is below 1 is needed, and does not suffice: a deadline may need more for a while (`least_speed`).
    """
    return Fraction(sum(method_of(costs).work(costs, timing))) / (timing.interval * speed)


def loads(
    costs: Costs, timing: Timing, speed: Fraction, options: Options = Options(), tasks: Sequence[Task] = ()
) -> tuple[Fraction, ...]:
    """Each processor's `utilization`, the user's tasks included. At a share above 1 work piles up without end.

    Raises InputError for a task on a processor that is not there.
    """
    check_cpus(tasks, options.cpus)
    high, low = method_of(costs).work(costs, timing)
    work = [Fraction(high) / timing.interval, *[Fraction(0)] * (options.cpus - 1)]
    work[-1] += Fraction(low) / timing.interval
    for task in tasks:
        work[task.cpu - 1] += task.cost / task.period
    return tuple(share / speed for share in work)
