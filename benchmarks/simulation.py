"""The simulation against the same schedule on `simpy.PreemptiveResource`, and against a bare SimPy loop; machine code
against SimPy, one run and the points of a sweep; and how long it takes to compile."""

from __future__ import annotations

import os
import subprocess
import sys
import tracemalloc
from collections.abc import Generator, Iterator
from fractions import Fraction
from math import inf
from tempfile import TemporaryDirectory

import simpy

from benchmarks import preemptive_resource
from benchmarks.timing import Result, core_seconds, seconds
from sched_sim.costs.table import PAPERS
from sched_sim.costs.table_file import load_costs
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.schedule.engine import Engine
from sched_sim.schedule.outcome import Schedule
from studies.sweep.grid import Chunk, Grid
from studies.sweep.rows import rows_of
from studies.sweep.run import LARGEST_TASK

COSTS = DualRateCosts(hr=63, hr_restart=4, hr_update=3, lr_propagate=41, lr_gain=0, lr_update=56)
FIGURE_3 = Timing(10, 4, 8)
PERIOD = 78  # at 77 the rival's LR update, preempted at the very end of its last step, lands a step late
CYCLES = 5000


def ours(cycles: int = CYCLES, engine: Engine = "simpy") -> Schedule:
    return simulate(COSTS, FIGURE_3, Fraction(PERIOD), cycles, engine=engine)


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


def short_designs() -> Iterator[Chunk]:
    """N of 10 to 40, all legal M and L, at eleven speeds."""
    speeds = tuple(Fraction(tenths, 10) for tenths in range(6, 17))
    grid = Grid((10, 20, 30, 40), None, None, speeds, ("dual-rate",), (load_costs(PAPERS),), (Options(),))
    for span in grid.spans(range(grid.size), lambda _: LARGEST_TASK):
        yield grid.chunk(span.start, span.stop)


def seconds_to_compile() -> float:
    """The first run of a process with an empty cache, but for what a second one takes."""
    command = "from benchmarks.simulation import ours; ours(10, 'compiled')"
    with TemporaryDirectory() as cache:
        environment = {**os.environ, "XDG_CACHE_HOME": cache}
        first, again = (
            seconds(lambda: subprocess.run([sys.executable, "-c", command], env=environment, check=True), 1)
            for _ in range(2)
        )
    return first - again


def results() -> Iterator[Result]:
    schedule = ours()
    hr, lr, achieved = preemptive_resource.run(COSTS, FIGURE_3, PERIOD, CYCLES)
    assert (hr, achieved) == (schedule.responses["hr"].worst, 8)
    assert lr == schedule.responses["lr_update"].worst
    rival = min(core_seconds(lambda: preemptive_resource.run(COSTS, FIGURE_3, PERIOD, CYCLES)) for _ in range(3))
    assert ours(engine="compiled") == schedule
    mine = bare = compiled = inf
    for _ in range(15):  # in turns
        mine = min(mine, core_seconds(ours))
        bare = min(bare, core_seconds(lambda: bare_loop(schedule.instants)))
        compiled = min(compiled, core_seconds(lambda: ours(engine="compiled")))
    yield Result("simulation: faster than simpy.PreemptiveResource", rival / mine, 4)
    yield Result("simulation: time of a bare SimPy loop with as many events", mine / bare, 2.0, higher=False)
    yield Result("simulation: compiled faster than SimPy", mine / compiled, 15)
    growth = peak_bytes(100_000) / peak_bytes(1_000)
    yield Result("simulation: memory of 1e6 HR periods over that of 1e4", growth, 1.1, higher=False)
    yield Result("simulation: to compile it once", seconds_to_compile(), 30, higher=False, unit="s")
    chunks = list(short_designs())
    assert repr(rows_of(chunks[0], 3, "compiled")) == repr(rows_of(chunks[0], 3, "simpy"))
    designs = sum(chunk.size for chunk in chunks)
    took = min(core_seconds(lambda: [rows_of(chunk, 3, "compiled") for chunk in chunks]) for _ in range(3))
    yield Result("sweep --simulate, three cycles of each", designs / took / 1e3, 10, unit="thousand designs / s")
