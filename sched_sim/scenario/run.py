"""Runs a scenario on the simulated processor, by SimPy or by compiled code: the outcome is the same."""

from __future__ import annotations

from dataclasses import replace

from sched_sim.errors import InputError
from sched_sim.scenario.engine.limits import holds
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.simulated import simulated
from sched_sim.scenario.workload import workload
from sched_sim.schedule.clock import OnProgress
from sched_sim.schedule.engine import Engine, check_engine, is_compiled
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Slice
from sched_sim.schedule.processor import OnSlice

MANY_JOBS = 200_000
"""From so many on, compiled code is taken unasked: SimPy takes two seconds, and to load what has been compiled before,
and run it, half a second."""


def run_scenario(
    scenario: Scenario,
    *,
    engine: Engine = "auto",
    keep_slices: bool = False,
    on_slice: OnSlice | None = None,
    on_progress: OnProgress | None = None,
) -> Outcome:
    """Simulate it: the same outcome every time, from its seed, and from each engine.

    engine: "simpy", "compiled", or "auto", which takes compiled code for what is long.
    keep_slices: the outcome's schedule has every `Slice`, of which a notebook makes a Gantt chart.
    on_slice: called by SimPy as slices end; of corrections that go together the first has the work.
    on_progress: called about a hundred times.
    Raises InputError for a scenario that is too long, and for one that the engine asked for cannot run.
    """
    if not isinstance(scenario, Scenario):
        raise InputError(f"scenario is a {type(scenario).__name__}: give read_scenario(...), or a Scenario")
    check_engine(engine)
    jobs = check_simulation(scenario.steps, scenario.tasks, f"scenario {scenario.name!r}: steps")
    work = workload(scenario)
    only_simpy = "slices" if keep_slices or on_slice is not None else ""
    if not is_compiled(engine, jobs, holds=holds(work), only_simpy=only_simpy, many=MANY_JOBS):
        slices: list[Slice] = []

        def keep(piece: Slice) -> None:
            slices.append(piece)
            if on_slice is not None:
                on_slice(piece)

        outcome = simulated(work, keep if keep_slices else on_slice, on_progress)
        return replace(outcome, schedule=replace(outcome.schedule, slices=tuple(slices)))
    from sched_sim.scenario.engine.outcome import run_compiled

    return run_compiled(work, on_progress)
