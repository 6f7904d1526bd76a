"""What the exact probability cannot have is refused by name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CarriedGainCosts,
    CloneCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
)
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.probability.delay import Delay
from sched_sim.schedule.jobs import LR
from sched_sim.schedule.tasks import Task

SAMPLED = "or sample it with `sched-sim simulate --scenario FILE.toml`"


def check_had(
    costs: JobCosts[Any],
    timing: Timing,
    options: Options,
    tasks: Sequence[Task],
    delay: Delay | None,
    *,
    preempted: bool,
) -> tuple[Task, ...]:
    """The tasks that may delay a job of the filter, or one another. Raises InputError for what is not had."""
    method_of(costs).check_design(costs, timing, options.feedback)
    _check_method(costs, timing)
    if options.policy != "fixed":
        raise InputError(
            f"{option('policy')} {options.policy}: the exact probability is had for fixed priorities only; leave it out"
        )
    if options.context_switch:
        raise InputError(
            f"{option('context_switch')} {float(options.context_switch):g}: the exact probability is had without "
            f"context switches; add two of them to the cost of each job"
        )
    low_rate = preempted or isinstance(costs, DualRateCosts)
    tasks = tuple(task for task in tasks if not low_rate or task.priority <= LR)
    for task in tasks:
        _check_task(task, low_rate=low_rate)
    if preempted:
        return _check_preempted(costs, options, tasks, delay)
    if isinstance(costs, DualRateCosts):
        return _check_dual_rate(costs, timing, options, tasks)
    if delay is not None:
        _check_random(costs, timing, delay)
    return tasks


def _check_method(costs: JobCosts[Any], timing: Timing) -> None:
    if isinstance(costs, MultirateCosts | RobustCosts | DelayedHorizonCosts):
        raise InputError(
            f"{type(costs).__name__}: the exact probability is had for recalculate, larsen, carried-gain, clone and "
            f"dual-rate; choose one of them as {option('method')}"
        )
    if isinstance(costs, LarsenCosts) and timing.M > timing.N:
        raise InputError(
            f"M={timing.M} and N={timing.N}: the exact probability of larsen is had for M <= N, for the work of a "
            f"further product was not measured alone; choose {option('method')} clone or carried-gain"
        )


def _check_task(task: Task, *, low_rate: bool) -> None:
    name = f"task {task.name!r}"
    if task.offset == "any":
        raise InputError(f"{name}: its offset may be any, and then it has no probability: give it an offset")
    if task.jitter:
        raise InputError(f"{name}: jitter {float(task.jitter):g} has no probability: give it none")
    if not task.preemptive:
        raise InputError(f"{name}: the exact probability is had for preemptive tasks only; leave out `preemptive`")
    if task.cpu == 2:
        raise InputError(f"{name}: the exact probability is had for tasks on CPU 1; leave it out, {SAMPLED}")
    if low_rate and task.priority == LR:
        raise InputError(
            f"{name}: priority {LR} is that of LR jobs, and then it matters which of them came first: give "
            f"{LR - 1} for more urgent ones or {LR + 1} for less urgent ones"
        )


def _check_dual_rate(
    costs: DualRateCosts[Any], timing: Timing, options: Options, tasks: tuple[Task, ...]
) -> tuple[Task, ...]:
    if costs.lr_gain.worst and timing.M > timing.N:
        raise InputError(
            f"{option('gain')} precomputed with M={timing.M} and N={timing.N}: had for M <= N, "
            f"else which LR job comes first hangs on the HR jobs; choose {option('gain')} at-update"
        )
    same_step = options.feedback == "same-step"
    if tasks and (same_step or options.cpus == 2):
        what = f"{option('feedback')} same-step" if same_step else f"{option('cpus')} 2"
        raise InputError(
            f"task {tasks[0].name!r} with {what}: the exact probability is not had for both; leave one out"
        )
    if options.cpus == 2:
        if same_step:
            raise InputError(f"{option('feedback')} same-step with {option('cpus')} 2: not had; choose next-step")
        return ()
    return tasks


def _check_preempted(
    costs: JobCosts[Any], options: Options, tasks: tuple[Task, ...], delay: Delay | None
) -> tuple[Task, ...]:
    if not isinstance(costs, RecalculateCosts):
        raise InputError(f"{option('preempted')}: only recalculate has a correction that HR jobs may preempt")
    if delay is not None or options.cpus == 2:
        what = f"{option('cpus')} 2" if delay is None else f"{option('delays')}, {option('dropout')}"
        raise InputError(f"{option('preempted')} with {what}: both at once are not had, {SAMPLED}")
    return tasks


def _check_random(costs: JobCosts[Any], timing: Timing, delay: Delay) -> None:
    if not isinstance(costs, RecalculateCosts | LarsenCosts | CloneCosts | CarriedGainCosts):
        raise InputError(
            f"{option('delays')}, {option('dropout')}: had for recalculate, larsen, carried-gain, clone and dual-rate"
        )
    if timing.instants is not None or delay.longest > timing.N:
        raise InputError(
            f"{option('delays')} up to {delay.longest} steps: the exact probability of this method is had for one "
            f"measurement on its way at a time, delays up to N={timing.N}, {SAMPLED}"
        )
