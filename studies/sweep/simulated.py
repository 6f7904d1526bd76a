"""The simulated figures of the points of a block: by SimPy one after another, or in machine code many at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TypeAlias

from sched_sim.bounds import short
from sched_sim.design.engine.plan import Plan, holds
from sched_sim.design.simulate import InTicks, at_worst_phase, in_ticks, simulate, simulated_steps
from sched_sim.design.timing import Timing
from sched_sim.schedule.engine import MANY_JOBS, Engine, is_compiled
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Schedule
from studies.sweep.grid import Block

Point: TypeAlias = tuple[Timing, Fraction]
"""A design, and its speed."""

Figures: TypeAlias = tuple[int | float | None, ...]
"""Those of `rows.SIMULATION_COLUMNS`."""


def simulated(block: Block, points: Sequence[Point], cycles: int, engine: Engine) -> list[Figures]:
    """Of each point. engine: "auto" is machine code, wherever that can.

    Raises InputError as `simulate` does.
    """
    if engine == "simpy":
        return [_by_simpy(block, point, cycles) for point in points]
    plans = [_plan(block, point, cycles, engine) for point in points]
    compiled = _in_machine_code([plan for plan in plans if plan is not None])
    return [
        _by_simpy(block, point, cycles) if plan is None else next(compiled)
        for point, plan in zip(points, plans, strict=True)
    ]


def _plan(block: Block, point: Point, cycles: int, engine: Engine) -> tuple[InTicks, Plan] | None:
    """None for what 64 bits do not hold."""
    (timing, speed), costs, options = point, block.costs, block.options
    run = in_ticks(costs, timing, speed, options, at_worst_phase(costs, timing, speed, options, block.tasks))
    steps = simulated_steps(costs, timing, cycles, options)
    check_simulation(steps, block.tasks, f"{short(cycles)} cycles of N={timing.N} with L={timing.L}")
    plan = run.plan(steps, cycles)
    return (run, plan) if is_compiled(engine, MANY_JOBS, holds=holds(plan, run.tasks)) else None


def _in_machine_code(plans: Sequence[tuple[InTicks, Plan]]) -> Iterator[Figures]:
    if not plans:
        return
    import numpy as np

    from sched_sim.design.engine.codes import HR_JOB, LR_UPDATE
    from sched_sim.design.engine.run import run_plans

    outcome = run_plans([plan for _, plan in plans], [run.tasks for run, _ in plans])
    landed = outcome.landed >= 0
    figures = outcome.figures
    worst = (
        np.where(figures["finished"][:, kind] > 0, figures["worst"][:, kind], -1).tolist()
        for kind in (HR_JOB, LR_UPDATE)
    )
    columns = (
        figures["misses"].sum(axis=1).tolist(),
        landed.sum(axis=1).tolist(),
        np.where(landed, outcome.landed, np.iinfo(np.int64).max).min(axis=1).tolist(),
        outcome.landed.max(axis=1).tolist(),
        outcome.states["busy_ticks"].tolist(),
        figures["preemptions"].sum(axis=1).tolist(),
        *worst,
    )
    for (_, plan), of_plan in zip(plans, zip(*columns, strict=True), strict=True):
        misses, count, first, last, busy, preemptions, hr, lr_update = of_plan
        yield (
            misses,
            count,
            first if count else None,
            last if count else None,
            busy / (plan.horizon * plan.cpus),
            preemptions,
            None if hr < 0 else hr / plan.period,
            None if lr_update < 0 else lr_update / plan.period,
        )


def _by_simpy(block: Block, point: Point, cycles: int) -> Figures:
    timing, speed = point
    schedule = simulate(block.costs, timing, speed, cycles, block.options, block.tasks, engine="simpy")
    achieved = schedule.achieved
    return (
        schedule.misses,
        achieved.total(),
        min(achieved, default=None),
        max(achieved, default=None),
        float(schedule.utilization),
        schedule.preemptions,
        _worst_response(schedule, "hr"),
        _worst_response(schedule, "lr_update"),
    )


def _worst_response(schedule: Schedule, kind: str) -> float | None:
    """In HR periods; None if no job of the kind finished."""
    response = schedule.responses.get(kind)
    return response.worst / schedule.period if response and response.finished else None
