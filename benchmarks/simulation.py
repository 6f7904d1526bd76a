"""The simulation against the same schedule on `simpy.PreemptiveResource`, and against a bare SimPy loop."""

from __future__ import annotations

import tracemalloc
from collections.abc import Generator, Iterator
from fractions import Fraction

import simpy

from benchmarks import preemptive_resource
from benchmarks.timing import Result, seconds
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.outcome import Schedule

COSTS = DualRateCosts(hr=63, hr_restart=4, hr_update=3, lr_propagate=41, lr_gain=0, lr_update=56)
FIGURE_3 = Timing(10, 4, 8)
PERIOD = 78  # at 77 the rival's LR update, preempted at the very end of its last step, lands a step late
CYCLES = 5000


def ours(cycles: int = CYCLES) -> Schedule:
    return simulate(COSTS, FIGURE_3, Fraction(PERIOD), cycles)


def bare_loop(events: int) -> None:
    env = simpy.Environment()

    def loop() -> Generator[simpy.Event, None, None]:
        for _ in range(events):
            yield env.timeout(1)

    env.process(loop())
    env.run()


def peak_bytes(cycles: int) -> int:
    tracemalloc.start()
    ours(cycles)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def results() -> Iterator[Result]:
    schedule = ours()
    hr, lr, achieved = preemptive_resource.run(COSTS, FIGURE_3, PERIOD, CYCLES)
    assert (hr, achieved) == (schedule.responses["hr"].worst, 8)
    assert lr == schedule.responses["lr_update"].worst
    mine = seconds(ours)
    rival = seconds(lambda: preemptive_resource.run(COSTS, FIGURE_3, PERIOD, CYCLES), repeats=3)
    bare = seconds(lambda: bare_loop(schedule.instants))
    yield Result("simulation: faster than simpy.PreemptiveResource", rival / mine, 4)
    yield Result("simulation: time of a bare SimPy loop with as many events", mine / bare, 2.5, higher=False)
    growth = peak_bytes(100_000) / peak_bytes(1_000)
    yield Result("simulation: memory of 1e6 HR periods over that of 1e4", growth, 1.1, higher=False)
