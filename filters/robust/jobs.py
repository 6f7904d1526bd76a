"""The robust filter at two rates: what is done in every step, and what once in N steps."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.jobs import Job
from filters.kernels.dense import add_vectors
from filters.robust.extended import ExtendedWorkspace, Setting, robust_step
from filters.robust.model import prepared, weights
from filters.robust.records import Predicted
from filters.robust.step import JOBS, WAYS, WayName
from filters.robust.uncertain import Scaling, UncertainSystem, Uncertainty, linearised

ALLOCATION_FREE = False


class Start(NamedTuple):
    """What a filter has in memory: state x (n,), input u, measurement y (p,), in the units of the system; P (n, n),
    scaled."""

    x: FloatArray
    u: FloatArray
    y: FloatArray
    P: FloatArray


class RobustCase(NamedTuple):
    """A model of the robust filter with its penalty mu, and a typical moment."""

    system: UncertainSystem
    scaling: Scaling
    uncertainty: Uncertainty
    mu: float
    start: Start


def inertial(system: UncertainSystem, x: FloatArray, u: FloatArray, correction: FloatArray, x_next: FloatArray) -> None:
    """Job of every step, at high rate: x_i becomes x_{i+1}, and the last robust step's correction (n,) is added."""
    system.f(x, u, system.parameters, x_next)
    add_vectors(x_next, correction, x_next)


def robust_jobs(case: RobustCase, seed: int = 0) -> dict[tuple[str, str], Job]:
    """The jobs of the methods robust-inverse, robust-givens, ..., by method and kind; see `filters.jobs.Job`."""
    return {
        (f"robust-{way}", kind): job
        for way in WAYS
        for kind, job in (
            ("inertial", Job("inertial", inertial, lambda index: _inertial(case, _moment(case, seed, index)))),
            ("robust_step", _step_job(case, way, seed)),
        )
    }


def _step_job(case: RobustCase, way: WayName, seed: int) -> Job:
    return Job("robust_step", robust_step, lambda index: _robust_step(case, way, _moment(case, seed, index)))


def _inertial(case: RobustCase, at: Start) -> tuple[Any, ...]:
    return case.system, at.x, at.u, np.full_like(at.x, 1e-9), np.zeros_like(at.x)


def _robust_step(case: RobustCase, way: WayName, at: Start) -> tuple[Any, ...]:
    system, scaling = case.system, case.scaling
    model = prepared(linearised(system, scaling, case.uncertainty, at.x, at.u), case.mu)
    n, p = len(at.x), len(at.y)
    before = Predicted((at.x - scaling.origin) / scaling.unit, at.P)
    after = Predicted(np.zeros(n), np.zeros((n, n)))
    work = ExtendedWorkspace(np.zeros(n), np.zeros(p), np.zeros(p), np.zeros(0), np.zeros(n))
    job = JOBS[way]
    setting = Setting(model, weights(model, case.mu), job.workspace(model))
    return system, scaling, job.function, at.y, at.x, at.u, before, setting, after, work


def _moment(case: RobustCase, seed: int, index: int) -> Start:
    """Near the case's typical moment; another index, other values."""
    random = np.random.default_rng([seed, index])
    start = case.start
    x = start.x + 0.1 * case.scaling.unit * random.normal(size=len(start.x))
    y = start.y + 0.1 * case.scaling.measurement_unit * random.normal(size=len(start.y))
    root = np.linalg.cholesky(start.P) + 0.05 * np.tril(random.normal(size=start.P.shape))
    return Start(x, start.u + 0.01 * random.normal(size=len(start.u)), y, root @ root.T)
