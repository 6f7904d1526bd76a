"""Whether deadlines that hold where all executions take their costs also hold where some take less.

Not always: a correction may land in an earlier step, whose HR job has a task beside it and then the HR update too. A
schedule in which less work never makes a job later is called sustainable (S. Baruah and A. Burns, Sustainable
scheduling analysis, 2006). It is one where what is released, and when, does not hang on how long jobs take, and jobs
that can be preempted have fixed ranks (R. Ha and J. W. S. Liu, Validating timing constraints in multiprocessor and
distributed real-time systems, 1994). What is not such a schedule may be bounded by one; else it is searched.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import NamedTuple

from sched_sim.bounds import at_least_one
from sched_sim.design.arguments import checked
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    Costs,
    DelayedHorizonCosts,
    DualRateCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    RobustCosts,
    product,
    works,
)
from sched_sim.design.timing import Timing
from sched_sim.schedule.jobs import LR
from sched_sim.schedule.tasks import Task, phases_matter
from sched_sim.ticks import Number, positive

TRIES = 64
"""Of less work, in a search."""


class LessWork(NamedTuple):
    """What a design does where executions take at most their costs.

    holds: True where no deadline is missed, whatever they take; False where one is, or, at some phase of the tasks, may
    be, with these `costs` and `tasks` in every cycle; None where that is not known. tried: so many less works were.
    """

    holds: bool | None
    costs: Costs | None = None
    tasks: tuple[Task, ...] = ()
    tried: int = 0


def less_work(
    costs: Costs,
    timing: Timing,
    speed: Number,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    tries: int = TRIES,
) -> LessWork:
    """Whether every deadline holds at this speed for all work up to the costs: proven, or searched in `tries` of it.

    costs, speed: as for `simulate`. Raises InputError as `least_speed` does.
    """
    tasks, pace, tries = checked(timing, options, tasks), positive(speed, "speed"), at_least_one(tries, "tries")
    if landing(costs, timing, pace, options, tasks) is None:
        return LessWork(False, costs, tasks)
    if holds_for_less(costs, timing, pace, options, tasks):
        return LessWork(True)
    for tried, (less, beside) in enumerate(_less(costs, tasks, tries), start=1):
        if landing(less, timing, pace, options, beside) is None:
            return LessWork(False, less, beside, tried)
    return LessWork(None, tried=tries)


def holds_for_less(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> bool:
    """Whether it is known without a search that no work up to these costs misses a deadline, where they miss none."""
    if phases_matter(tasks):
        from sched_sim.design.any_phase import late_for_less

        return late_for_less(costs, timing, speed, options, tasks) is None
    if _hangs_on_finishes(costs, options, tasks):
        return False
    if not isinstance(costs, DualRateCosts) or not costs.hr_update:
        return True
    if not _one_in_flight(costs, timing, options):
        return False
    if not tasks and options.policy == "fixed" and speed >= _longest_landing(costs, timing, options):
        return True
    if options.feedback == "same-step":  # the HR update is a job of its own, that comes when the LR update finishes
        return False
    earliest = landing(costs, timing, speed, options, tasks) == timing.M + 1
    return earliest or landing(_in_every_step(costs), timing, speed, options, tasks) is not None


def enough_for_less(
    costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task], least: Fraction
) -> Fraction | None:
    """A speed at which no work up to these costs misses a deadline; None where none is known. least: the least speed,
    which it is where that is enough."""
    if holds_for_less(costs, timing, least, options, tasks):
        return least
    if phases_matter(tasks) or _hangs_on_finishes(costs, options, tasks) or not isinstance(costs, DualRateCosts):
        return None
    if not _one_in_flight(costs, timing, options):
        return None
    if not tasks and options.policy == "fixed":
        return max(least, _longest_landing(costs, timing, options))
    if options.feedback == "same-step":
        return None
    return max(least, least_speed(_in_every_step(costs), timing, options, tasks).speed)


def _hangs_on_finishes(costs: Costs, options: Options, tasks: Sequence[Task]) -> bool:
    """Whether an earlier finish may delay another job, but for the place of an HR update: it takes a switch more, or
    lets a job begin that is not preempted, or an LR job come before a task that else comes first."""
    if not tasks and options.policy == "fixed":
        return False
    if options.context_switch or not all(task.preemptive for task in tasks):
        return True
    if not isinstance(costs, DualRateCosts | DelayedHorizonCosts | MultirateCosts | RobustCosts):
        return False
    beside = [task for task in tasks if task.cpu == options.cpus]
    if options.cpus == 2:
        return bool(beside)
    return options.policy == "fixed" and any(task.priority == LR for task in beside)


def _one_in_flight(costs: Costs, timing: Timing, options: Options) -> bool:
    return method_of(costs).law(options.feedback).one_in_flight(timing.N, timing.L)


def _longest_landing(costs: DualRateCosts[Fraction], timing: Timing, options: Options) -> Fraction:
    """The most work of a step in which a correction may land, or, with same-step feedback, where it is a job of its
    own, that it may delay."""
    update = costs.hr_update + options.context_switch
    if options.feedback == "same-step":
        return update + max(costs.hr, costs.hr_restart) + options.context_switch
    return update + (costs.hr if timing.M > 0 and timing.N > 1 else max(costs.hr, costs.hr_restart))


def _in_every_step(costs: DualRateCosts[Fraction]) -> DualRateCosts[Fraction]:
    """More than is ever done: the HR update in every step, whenever corrections land."""
    update = costs.hr_update
    return replace(costs, hr=costs.hr + update, hr_restart=costs.hr_restart + update, hr_update=Fraction(0))


def _less(costs: Costs, tasks: Sequence[Task], tries: int) -> Iterator[tuple[Costs, tuple[Task, ...]]]:
    """Less work: in the first half, of the dual-rate filter, the LR update alone, from most of its cost to none, else
    all of the filter; then each piece and task another share of its cost."""
    pieces = works(costs)
    kept = len(pieces) - 1 if isinstance(costs, DualRateCosts) else 0
    random = Random(0)
    for number in range(tries):
        share = 1 - Fraction(2 * number + 2, tries)
        if share >= 0:
            yield _shared(costs, [Fraction(1)] * kept + [share] * (len(pieces) - kept)), tuple(tasks)
        else:
            yield (
                _shared(costs, [Fraction(random.randint(0, 16), 16) for _ in pieces]),
                tuple(replace(task, cost=task.cost * random.randint(1, 16) / 16) for task in tasks),
            )


def _shared(costs: Costs, shares: Sequence[Fraction]) -> Costs:
    less = [share * work for share, work in zip(shares, works(costs), strict=True)]
    if isinstance(costs, LarsenInFlightCosts):  # of accumulate, a step takes what is beyond propagate several times
        less[1] = min(less[1], less[0] + product(costs))
    made: Costs = type(costs)(*less)
    return made
