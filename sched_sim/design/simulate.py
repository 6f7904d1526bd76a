"""Runs one filter, and the user's tasks beside it, on the simulated processor."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import chain
from math import ceil
from typing import NamedTuple

from sched_sim.bounds import at_least_one, short
from sched_sim.design.arguments import checked
from sched_sim.design.engine.plan import Plan, holds, plan_of
from sched_sim.design.hr_loop import OnLanding
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, JobCosts, converted, works
from sched_sim.design.timing import Timing
from sched_sim.schedule.clock import Clock, OnProgress
from sched_sim.schedule.engine import Engine, check_engine, is_compiled
from sched_sim.schedule.jobs import RecurringSource
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Schedule, Slice
from sched_sim.schedule.processor import OnSlice, Platform, Processor
from sched_sim.schedule.tasks import Task, TaskSource, check_cpus, work_and_times
from sched_sim.ticks import Number, positive, ticks_per_unit, to_ticks


def simulate(
    costs: Costs,
    timing: Timing,
    speed: Number,
    cycles: int = 3,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    *,
    keep_slices: bool = False,
    on_slice: OnSlice | None = None,
    on_landing: OnLanding | None = None,
    on_progress: OnProgress | None = None,
    engine: Engine = "auto",
) -> Schedule:
    """Run one filter, and the user's tasks beside it, for `cycles` measurement cycles, and for as many steps more as it
    takes until the correction of the last must be in the state (with M = N that is one step for recalculate).

    costs: from `select`; speed: cost units the processor does per HR period.
    keep_slices: return every `Slice`; without it memory does not grow with `cycles`, but for some 20 bytes each if
    compiled.
    Tasks whose offset may be any are released together, the first time as late as their jitter allows, where that
    delays the job with the least slack most (`worst_phase.critical_start`); those without jitter before too, from the
    start on.
    on_slice, on_landing: called as slices end and as corrections land, with a `Slice` and with
    (cycle, achieved L). on_progress: called about a hundred times.
    engine: SimPy, or compiled, which gives the same schedule, but no slices, and calls on_landing once it is done; by
    default ("auto") compiled from `MANY_JOBS` on, where it can.
    Raises InputError for a speed that is not positive, an L the method cannot have, a task on a missing CPU, more than
    can be simulated (`sched_sim.bounds`), and what the engine asked for cannot.
    """
    tasks = checked(timing, options, tasks)
    check_engine(engine)
    speed, cycles = positive(speed, "speed"), at_least_one(cycles, "cycles")
    check_simulation(timing.taken.step(cycles), tasks, f"{short(cycles)} cycles of N={timing.N}")
    tasks = at_worst_phase(costs, timing, speed, options, tasks)
    run = in_ticks(costs, timing, speed, options, tasks)
    steps = simulated_steps(costs, timing, cycles, options)
    jobs = check_simulation(steps, tasks, f"{short(cycles)} cycles of N={timing.N} with L={timing.L}")
    plan = run.plan(steps, cycles)
    only_simpy = "slices, of which traces are made" if keep_slices or on_slice is not None else ""
    if is_compiled(engine, jobs, holds=holds(plan, run.tasks), only_simpy=only_simpy):
        if on_progress is not None:
            on_progress(0, steps, "HR steps")
        return _in_machine_code(plan, run.tasks, on_landing)
    achieved: Counter[int] = Counter()

    def landed(cycle: int, L: int) -> None:
        if cycle < cycles:
            achieved[L] += 1
            if on_landing is not None:
                on_landing(cycle, L)

    clock = [] if on_progress is None else [Clock(run.period, steps, on_progress)]
    slices: list[Slice] = []

    def keep(piece: Slice) -> None:
        slices.append(piece)
        if on_slice is not None:
            on_slice(piece)

    processor = Processor(
        [run.source(landed), *run.tasks, *clock],
        run.period,
        plan.horizon,
        run.platform,
        keep if keep_slices else on_slice,
    )
    processor.run()
    return replace(processor.schedule(), achieved=achieved, slices=tuple(slices))


def _in_machine_code(plan: Plan, tasks: Sequence[TaskSource], on_landing: OnLanding | None) -> Schedule:
    from sched_sim.design.engine.run import kinds_of, run_plans, schedule_of

    outcome = run_plans([plan], [tasks])
    if on_landing is not None:
        for cycle, L in enumerate(outcome.landed[0].tolist()):
            if L >= 0:
                on_landing(cycle, L)
    return schedule_of(plan, kinds_of(tasks), outcome)


def simulated_steps(costs: Costs, timing: Timing, cycles: int, options: Options) -> int:
    """Until the correction of the last cycle must be in the state; at least to the end of it."""
    method = method_of(costs)
    law = method.law(options.feedback)
    lands = timing.L + law.before
    if law.only_first:
        lands = timing.M + 1 if method.lands_in_step_m else 0
    return max(timing.taken.step(cycles), timing.taken.step(cycles - 1) + lands)


def at_worst_phase(
    costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]
) -> tuple[Task, ...]:
    """The tasks, each with an offset: those that may have any are released together, without jitter before too."""
    start = worst_start(costs, timing, speed, options, tasks)

    def placed(task: Task) -> Task:
        if start is None or task.offset != "any":
            return task
        before = 0 if task.jitter else start // task.period * task.period
        return replace(task, offset=start - task.jitter - before)

    return tuple(map(placed, tasks))


def worst_start(
    costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]
) -> Fraction | None:
    """When those of any phase are released together, in HR periods; None if there are none."""
    if all(task.offset != "any" for task in tasks):
        return None
    from sched_sim.design.phased import phased
    from sched_sim.design.worst_phase import critical_start

    design = phased(costs, timing, speed, options, tasks)
    start = Fraction(0) if options.policy == "edf" else Fraction(critical_start(design), design.period)
    longest = max(task.jitter for task in tasks if task.offset == "any")
    return start + ceil(max(longest - start, Fraction(0)) / design.steps) * design.steps  # of all by the same


class InTicks(NamedTuple):
    """What a processor has to do, in ticks. period: of the HR loop.

    Of jobs of one priority, released at one instant, the filter's goes before the tasks'.
    """

    costs: JobCosts[int]
    timing: Timing
    options: Options
    tasks: tuple[TaskSource, ...]
    period: int
    platform: Platform

    def source(self, on_landing: OnLanding) -> RecurringSource:
        """Of the filter's jobs."""
        return method_of(self.costs).source(self.costs, self.timing, self.options, self.period, on_landing)

    def plan(self, steps: int, cycles: int) -> Plan:
        """To run it in machine code."""
        return plan_of(self.costs, self.timing, self.options, self.period, self.platform, steps, cycles)


def in_ticks(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> InTicks:
    """The fewest ticks per cost unit in which all is whole. Raises InputError as `simulate` does."""
    check_cpus(tasks, options.cpus)
    method_of(costs).check_design(costs, timing, options.feedback)
    costs = converted(costs, lambda work: work if type(work) is Fraction else Fraction(work))
    of_tasks = chain.from_iterable(work_and_times(task, speed) for task in tasks)
    resolution = ticks_per_unit([speed, options.context_switch, *works(costs), *of_tasks])
    return InTicks(
        converted(costs, lambda work: to_ticks(work, resolution)),
        timing,
        options,
        tuple(TaskSource(task, speed, resolution) for task in tasks),
        to_ticks(speed, resolution),
        Platform(options.cpus, to_ticks(options.context_switch, resolution), options.policy),
    )
