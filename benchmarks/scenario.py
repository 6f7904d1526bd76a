"""A scenario of two sensors and a task in compiled code against SimPy, in turns: the same end of every job."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import inf
from typing import get_args

from benchmarks.timing import Result, seconds
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Late, Scenario, Sensor, carried, needed_parts
from sched_sim.schedule.engine import Engine
from sched_sim.schedule.tasks import Task

STEPS = 20_000
SENSORS = [Sensor("gps", 40, range(15, 31), land_by=60, dropout=0.1), Sensor("barometer", 8, [2, 3], land_by=9)]
CONTROL = Task("control", Fraction(2), Fraction(1, 2), priority=5)


def scenario(late: Late) -> Scenario:
    """All that runs draws one of three times; a period is 2.5."""
    times = [Fraction(1, 10), Fraction(3, 25), Fraction(9, 50)]
    parts = needed_parts(SENSORS, late, carried(SENSORS, late, STEPS, seed=0))
    costs = dict.fromkeys(parts, times)
    return Scenario("rocket", STEPS, Fraction(5, 2), SENSORS, costs, late=late, tasks=[CONTROL])


def results() -> Iterator[Result]:
    for late in get_args(Late):
        of = scenario(late)
        assert run_scenario(of, engine="compiled") == run_scenario(of, engine="simpy")
        least: dict[Engine, float] = {"simpy": inf, "compiled": inf}
        for _ in range(5):
            for engine in least:
                least[engine] = min(
                    least[engine], seconds(lambda of=of, engine=engine: run_scenario(of, engine=engine), 1)
                )
        yield Result(f"scenario, {late}: compiled faster than SimPy", least["simpy"] / least["compiled"], 20)
