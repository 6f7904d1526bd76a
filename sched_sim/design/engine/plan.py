"""A filter and its processor in numbers: what `rules` and `event_loop` run on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from sched_sim.design.engine.codes import LANDS, LR_GAIN, LR_STEP, MEASURED, NOTHING, RELEASES_LOW, SENDS
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CarriedGainCosts,
    CloneCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
    at_m,
    beside_others,
    each_step,
    product,
    works,
)
from sched_sim.design.timing import Timing
from sched_sim.schedule.engine import MOST_TICKS
from sched_sim.schedule.processor import Platform
from sched_sim.schedule.tasks import TaskSource


class Plan(NamedTuple):
    """Times and work in ticks.

    period: of the HR loop; cycles: whose landing is kept; cpus, low_cpu: how many processors, and which runs LR jobs;
    switch: work of a context switch; edf: whether the earliest deadline comes first; taken_steps, taken_count: as of
    `Taken`; M: in steps.

    An HR job takes `each`; and `carry` for each measurement that was taken carried_from .. carried_until - 1 steps ago,
    from step `earliest` on; `at_k`, and `couple` for each of those, where a measurement is taken; `at_m`, and
    `compensate` for each that was taken since, where one arrives. after_k, after_m: what it means that it has finished
    there, as in `codes`.

    propagate, gain, update, replay: work of LR jobs, and of one replayed step; propagate_due, update_due: after the
    start of step k; hr_update: work of one. low_kind: of the LR job, where it
    is alone; arrives: whether an LR update is released at m; dual_rate, same_step: whether it is that filter, and so
    fed back.
    """

    period: int
    horizon: int
    cycles: int
    cpus: int
    switch: int
    edf: int
    low_cpu: int
    taken_steps: int
    taken_count: int
    M: int
    each: int
    carry: int = 0
    carried_from: int = 1
    carried_until: int = 1
    earliest: int = 0
    at_k: int = 0
    couple: int = 0
    at_m: int = 0
    compensate: int = 0
    after_k: int = NOTHING
    after_m: int = NOTHING
    propagate: int = 0
    propagate_due: int = 0
    gain: int = 0
    update: int = 0
    update_due: int = 0
    hr_update: int = 0
    replay: int = 0
    low_kind: int = 0
    arrives: int = 0
    dual_rate: int = 0
    same_step: int = 0


def plan_of(
    costs: JobCosts[int], timing: Timing, options: Options, period: int, platform: Platform, steps: int, cycles: int
) -> Plan:
    """period, and costs: in ticks; steps: to simulate."""
    if isinstance(costs, StandardCosts | MultirateCosts | RobustCosts):
        timing = replace(timing, M=0, instants=None)
    taken, M, L = timing.taken, timing.M, timing.L
    filter_in_numbers = Plan(
        period=period,
        horizon=steps * period,
        cycles=cycles,
        cpus=platform.cpus,
        switch=platform.context_switch,
        edf=int(platform.policy == "edf"),
        low_cpu=platform.cpus - 1,
        taken_steps=taken.steps,
        taken_count=taken.count,
        M=M,
        each=works(costs)[0],
    )
    with_ = filter_in_numbers._replace
    match costs:
        case StandardCosts(_, update):
            return with_(at_m=update, after_m=LANDS)
        case RecalculateCosts(_, update, replay):
            return with_(at_m=update + M * replay, after_m=LANDS)
        case LarsenInFlightCosts() if timing.N < M:
            return with_(
                carry=product(costs),
                carried_from=2,
                carried_until=max(M + 1, 2),
                at_k=costs.gain,
                at_m=costs.correct,
                compensate=costs.compensate,
                after_m=LANDS,
            )
        case LarsenCosts(propagate, accumulate, update):
            each = accumulate - propagate
            return with_(carry=each, carried_from=2, carried_until=max(M + 1, 2), at_m=update, after_m=LANDS)
        case CloneCosts(_, at_k, carry, landing) | CarriedGainCosts(_, at_k, carry, landing):
            couple, compensate = beside_others(costs)
            return with_(
                carry=carry,
                carried_until=max(M, 1),
                at_k=at_k,
                couple=couple,
                at_m=landing,
                compensate=compensate,
                after_m=LANDS,
            )
        case MultirateCosts(_, low) | RobustCosts(_, low):
            kind = LR_GAIN if isinstance(costs, MultirateCosts) else LR_STEP
            return with_(after_k=RELEASES_LOW, update=low, update_due=L * period, low_kind=kind)
        case DelayedHorizonCosts(_, update, replay, propagate):
            early = int(M == 0)
            return with_(
                after_k=MEASURED if early else NOTHING,
                arrives=int(not early),
                update=early * propagate + update + (M + 1) * replay,
                update_due=L * period,
                replay=replay,
                propagate=(timing.N - early) * propagate,
                propagate_due=(M + timing.N) * period,
            )
        case DualRateCosts():
            same_step = options.feedback == "same-step"
            due = (L + same_step) * period
            return with_(
                carry=costs.hr_restart - costs.hr,
                carried_until=2,
                earliest=-1,
                after_k=SENDS,
                propagate=costs.lr_propagate,
                propagate_due=due if options.lr_propagate_by == "l" or M == 0 else M * period,
                gain=costs.lr_gain,
                update=costs.lr_update,
                update_due=due,
                hr_update=costs.hr_update,
                arrives=1,
                dual_rate=1,
                same_step=int(same_step),
            )
        case _:
            return with_(each=each_step(costs, M), at_m=at_m(costs, M), after_m=LANDS)


def holds(plan: Plan, tasks: Sequence[TaskSource]) -> bool:
    """Whether 64 bits hold all times and all work.

    Corrections that come into the state in one step took at least an HR update each, one after another, so that what
    they take together is less than the horizon and that of the last.
    """
    steps = plan.horizon // plan.period
    longest = steps + plan.M + plan.taken_steps
    jobs = 4 * steps + sum(plan.horizon // task.period + 1 for task in tasks)
    times = (
        longest * max(plan.taken_steps, plan.taken_count),
        plan.horizon + max(plan.propagate_due, plan.update_due),
        *(task.next_release + task.period + task.deadline for task in tasks),
    )
    work = (
        plan.each + plan.at_k + plan.at_m + (abs(plan.carry) + plan.couple + plan.compensate) * longest,
        plan.propagate + plan.gain + plan.update + (plan.hr_update + plan.replay) * longest,
        plan.switch * jobs,
        *(task.cost for task in tasks),
    )
    return max(*times, 4 * max(work)) < MOST_TICKS
