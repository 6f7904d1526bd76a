"""Cost tables of the robust filter: shipped as counted, scheduled at the paper's rates, and on parallel devices."""

from __future__ import annotations

import json
from fractions import Fraction

import numpy as np
import pytest

from filters.backends.choose import arguments_for, function_for
from filters.robust.jobs import robust_jobs
from sched_sim.costs.methods import ROBUST_METHODS
from sched_sim.costs.table_file import TABLES, costs_text
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import RobustCosts, StandardCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from studies.robust.costs import SYSTEMS, N, SystemName, parallel_costs, robust_case, robust_costs
from tests.command_line import Run, is_refused


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_shipped_tables_are_fresh_counts(system: SystemName) -> None:
    assert (TABLES / f"erkf-{system}.toml").read_text() == costs_text(robust_costs(system))


@pytest.mark.parametrize("system", SYSTEMS)
def test_all_ways_take_the_same_step(system: SystemName) -> None:
    results = []
    for (_, kind), job in robust_jobs(robust_case(system)).items():
        if kind == "robust_step":
            arguments = arguments_for("reference", job.arguments(3))
            function_for("reference", job.function)(*arguments)
            results.append(arguments[8])
    for other in results[1:]:
        np.testing.assert_allclose(other.x, results[0].x, rtol=1e-9)
        np.testing.assert_allclose(other.P, results[0].P, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("method", ROBUST_METHODS)
@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.exhaust
def test_spread_over_a_cycle_the_step_needs_a_fraction_of_what_it_needs_in_one_period(
    system: SystemName, method: str
) -> None:
    """In one HR period: inertial + step; over L = N of them: inertial + step / N, and the simulation agrees."""
    costs = select(robust_costs(system), method, Options())
    assert isinstance(costs, RobustCosts)
    serial = least_speed(StandardCosts(costs.inertial, costs.robust_step), Timing(N, 0, N)).speed
    spread = least_speed(costs, Timing(N, 0, N)).speed
    assert serial == costs.inertial + costs.robust_step
    assert spread == costs.inertial + Fraction(costs.robust_step, N)
    assert simulate(costs, Timing(N, 0, N), spread, cycles=3).misses == 0
    assert simulate(costs, Timing(N, 0, N), spread * Fraction(9999, 10000), cycles=3).misses > 0


@pytest.mark.exhaust
def test_a_parallel_device_buys_less_and_less() -> None:
    work = [parallel_costs("position", units).costs["robust-givens"]["robust_step"].minimum for units in (1, 4, 16, 64)]
    ratios = [float(work[0] / each) for each in work[1:]]
    assert ratios == sorted(ratios)
    assert 3 < ratios[0] < 4
    assert ratios[-1] < 20


def test_measured_counted_and_scheduled_from_the_command_line(sched_sim: Run) -> None:
    line = "measure --robust attitude --parallel 16 --backend counted -o erkf.toml"
    assert sched_sim(line).code == 0
    (row,) = json.loads(sched_sim("minimum -N 40 --costs erkf.toml --processor leon3 --hr-hz 400 --format json").out)
    assert (row["method"], row["fits"]) == ("robust-givens", True)
    slower, faster = (
        json.loads(sched_sim(f"minimum -N 40 -L {L} --costs erkf-attitude --method robust-lu --format json").out)[0]
        for L in (40, 1)
    )
    assert (slower["binding"], faster["binding"]) == ("lr_step", "lr_step")
    assert slower["min_speed"] < faster["min_speed"]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("measure --parallel 4", ["--parallel 4", "--robust"]),
        ("measure --robust attitude --parallel 4", ["--parallel 4", "--backend counted"]),
        ("measure --robust attitude --method larsen", ["--robust attitude", "--method"]),
        ("measure --robust airship", ["--robust", "airship"]),
        ("measure --method robust-lu", ["robust-lu", "larsen"]),
        ("minimum -N 40 -M 4 --method robust-lu --costs erkf-attitude", ["-M 4", "no delay"]),
    ],
)
def test_wrong_input(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(line), said)
