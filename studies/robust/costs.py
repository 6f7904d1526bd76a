"""What the robust filter costs at two rates, in each way of computing its step, on the paper's two systems."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Literal, TypeAlias, get_args

import numpy as np

from filters.backends.counted import Operations, count
from filters.robust.jobs import RobustCase, Start, robust_jobs
from filters.robust.model import prepared, weights, without_measurement
from filters.robust.parallel_step import parallel_step_flops
from filters.robust.records import Predicted, RobustModel, Weights
from filters.robust.step import JOBS, WAYS, WayName
from filters.robust.uncertain import linearised
from filters.systems.attitude import attitude, attitude_scaling, attitude_uncertainty
from filters.systems.position import position, position_scaling, position_uncertainty
from sched_sim.costs.table import Cost, CostTable
from studies.measurement.job_times import Progress, silent
from studies.measurement.methods import BackendName, cost_table

SystemName: TypeAlias = Literal["attitude", "position"]
SYSTEMS: tuple[SystemName, ...] = get_args(SystemName)

HR_HZ, N = 400, 40
"""The paper's rates: an IMU at 400 Hz, GPS at 10 Hz."""


def robust_case(name: SystemName) -> RobustCase:
    """The system with its uncertain scale factors and a finite mu, at a turn of a road vehicle."""
    if name == "attitude":
        system, scaling = attitude(), attitude_scaling()
        x = np.array([0.1, -0.05, 1.2, 0.01, -0.02, 0.03])
        start = Start(x, np.array([0.2, -0.1, 0.3]), x[:3] + 0.01, np.diag([1.0] * 3 + [0.25] * 3))
        return RobustCase(system, scaling, attitude_uncertainty("gyro"), 1e5, start)
    latitude, longitude, height_m = np.radians(-22.0075), np.radians(-47.8909), 850.0
    system, scaling = position(latitude, height_m), position_scaling(latitude, longitude, height_m)
    x = np.array([latitude, longitude, height_m, 8.0, -5.0, 0.3, 0.04, -0.03, 0.05])
    u = np.array([0.5, -0.2, -9.7, 0.02, -0.03, 0.6])
    y = x[:6] + 0.3 * scaling.measurement_unit
    start = Start(x, u, y, np.diag([0.1] * 6 + [0.25] * 3))
    return RobustCase(system, scaling, position_uncertainty("accelerometer"), 1e8, start)


def robust_costs(
    name: SystemName,
    backend: BackendName = "counted",
    *,
    thorough: bool = False,
    seed: int = 0,
    progress: Progress = silent,
    target: str | None = None,
    precision: str | None = None,
) -> CostTable:
    """The cost table erkf-NAME: the methods robust-inverse, robust-givens, robust-lu and robust-closed."""
    case = robust_case(name)
    about: Mapping[str, object] = {
        "states": len(case.start.x),
        "measurements": len(case.start.y),
        "noises": len(case.system.Q),
        "mu": f"{case.mu:g}",
        "ways": ", ".join(WAYS),
    }
    jobs = robust_jobs(case, seed)
    return cost_table(
        jobs,
        backend,
        about,
        name=f"erkf-{name}",
        thorough=thorough,
        seed=seed,
        progress=progress,
        target=target,
        precision=precision,
    )


def parallel_costs(name: SystemName, units: int) -> CostTable:
    """The cost table of robust-givens alone, counted, on a device that does so many column pairs at a time.

    Rotations follow the greedy schedule; what is done before and after them, linearisation and all, is not parallel. A
    rotation's sine and cosine are charged as 48 operations, where a count in sequence has 7: compare these tables with
    one another, from units = 1 on.
    Raises ValueError unless units is at least 1.
    """
    case = robust_case(name)
    table = robust_costs(name)
    model = prepared(linearised(case.system, case.scaling, case.uncertainty, case.start.x, case.start.u), case.mu)
    weight = weights(model, case.mu)
    alone = _counted_solution(model, weight, "givens")
    whole = Operations(**table.operations[METHOD]["robust_step"])
    rotations = parallel_step_flops(model, weight, [units])[units]
    share = Operations(multiply=rotations * 2 // 3, add=rotations - rotations * 2 // 3)  # 4 and 2 in a column pair
    rest = Operations(*(all_ - part for all_, part in zip(whole, alone, strict=True)))
    counts = {
        "inertial": table.operations[METHOD]["inertial"],
        "robust_step": {kind: number for kind, number in (rest + share)._asdict().items() if number},
    }
    costs = {kind: Cost.of(Fraction(sum(numbers.values()))) for kind, numbers in counts.items()}
    about = {**table.provenance, "units": units}
    return CostTable(f"erkf-{name}-{units}", "operation", {METHOD: costs}, about, operations={METHOD: counts})


METHOD = "robust-givens"


def between_fixes(name: SystemName) -> dict[WayName, Fraction]:
    """Operations of a robust step without a measurement over those of one with it, by way; both without the
    linearisation."""
    case = robust_case(name)
    model = linearised(case.system, case.scaling, case.uncertainty, case.start.x, case.start.u)
    seen, unseen = (prepared(each, case.mu) for each in (model, without_measurement(model)))

    def total(model: RobustModel, way: WayName) -> int:
        return _counted_solution(model, weights(model, case.mu), way).total

    return {way: Fraction(total(unseen, way), total(seen, way)) for way in WAYS}


def _counted_solution(model: RobustModel, weight: Weights, way: WayName) -> Operations:
    """What the block system takes in sequence, without what forms it."""
    n, p = len(model.F), len(model.H)
    job = JOBS[way]
    before, after = Predicted(np.ones(n), np.eye(n) + 0.1), Predicted(np.empty(n), np.empty((n, n)))
    y, c = np.full(p, 0.5), np.full(n, 0.5)
    return count(job.function, model, weight, before, y, c, after, job.workspace(model))
