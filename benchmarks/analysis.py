"""Design points per second of the analysis of whole arrays, compiled, on one core; and how long a staircase takes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from benchmarks.simulation import COSTS
from benchmarks.timing import Result, seconds
from sched_sim.costs.table_file import load_costs
from sched_sim.design.analysis import achieved_l, least_period
from sched_sim.design.least_speed import staircase
from sched_sim.design.methods import select
from sched_sim.design.options import Options

POINTS = 1_000_000


def results() -> Iterator[Result]:
    random = np.random.default_rng(0)
    N = random.integers(2, 200, POINTS)
    M = random.integers(0, N)
    L = random.integers(M, N) + 1
    period = random.integers(50, 200, POINTS)
    options = Options()
    least = seconds(lambda: least_period(COSTS, N, M, L, options), repeats=3)
    landed = seconds(lambda: achieved_l(COSTS, N, M, period, options), repeats=3)
    yield Result("analysis: least speed, dual-rate", POINTS / least / 1e6, 10, unit="million points / s")
    yield Result("analysis: achieved l, dual-rate", POINTS / landed / 1e6, 10, unit="million points / s")
    costs = select(load_costs("steffes2014"), "dual-rate", options)
    stairs = seconds(lambda: staircase(costs, 100, 10, options), repeats=20)
    yield Result("analysis: staircase of 91 steps", stairs * 1e3, 1, higher=False, unit="ms")
