"""Windows of a scenario's run that has been looked at, against a simulation of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from benchmarks.scenario import scenario
from benchmarks.timing import Result, seconds
from sched_sim.scenario.run import run_scenario
from studies.explorer.scenario_trace import Trace
from studies.explorer.scenario_window import window

STEPS, SHOWN = 100_000, 40


def results() -> Iterator[Result]:
    of = replace(scenario("recalculate"), steps=STEPS)
    trace = Trace(of)
    trace.learn(STEPS, STEPS)
    simulated = seconds(lambda: run_scenario(of, engine="simpy"), 1)
    for where, first in (("first", 0), ("middle", STEPS // 2), ("last", STEPS - SHOWN)):
        shown = min(seconds(lambda first=first: window(trace, first, first + SHOWN), 1) for _ in range(5))
        yield Result(f"scenario, its {where} {SHOWN} steps: faster than to simulate it", simulated / shown, 1_000)
