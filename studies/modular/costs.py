"""What one predict and one correct of a composed filter cost: linear, extended and unscented, by the number of states.

The model is the same for all sizes: a third of the states are positions, a third their velocities, a third
accelerations, with a drag that is quadratic in the velocity; a sensor measures three states, each with a scale that
changes with it. The linear parts have the same model without these. Jacobians are written out.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.arrays import FloatArray
from filters.backends.counted import count
from filters.jobs import Job
from filters.modular import (
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.jobs import modular_jobs
from studies.measurement.job_times import Progress, Protocol, silent, time_jobs
from studies.measurement.methods import QUICK, THOROUGH, where_timed

Kind: TypeAlias = Literal["linear", "extended", "unscented"]
Part: TypeAlias = Literal["predict", "correct"]
Key: TypeAlias = tuple[Kind, str, Part]
"""Kind, states, part."""

KINDS: tuple[Kind, ...] = get_args(Kind)
PARTS: tuple[Part, ...] = get_args(Part)
STATES = (3, 6, 9, 15)
MEASURED, DT, DRAG, SCALE = 3, 0.01, 1e-3, 1e-3


class Times(NamedTuple):
    """seconds: of one run of each job, one figure a round; about: the machine, the versions and the protocol."""

    seconds: Mapping[tuple[str, str, str], list[float]]
    about: Mapping[str, Any]


def move(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    """A time dt on."""
    axes = len(out) // 3
    for i in range(axes):
        slowed = x[2 * axes + i] - DRAG * x[axes + i] * x[axes + i]
        out[i] = x[i] + dt * x[axes + i]
        out[axes + i] = x[axes + i] + dt * slowed
        out[2 * axes + i] = x[2 * axes + i]


def move_jacobian(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    """The Jacobian of `move`; what is zero is left so."""
    axes = len(out) // 3
    for i in range(axes):
        out[i, i] = 1.0
        out[i, axes + i] = dt
        out[axes + i, axes + i] = 1.0 - dt * 2.0 * DRAG * x[axes + i]
        out[axes + i, 2 * axes + i] = dt
        out[2 * axes + i, 2 * axes + i] = 1.0


def see(x: FloatArray, out: FloatArray) -> None:
    """The first states, as the sensor shows them."""
    for i in range(len(out)):
        out[i] = x[i] + SCALE * x[i] * x[i]


def see_jacobian(x: FloatArray, out: FloatArray) -> None:
    """The Jacobian of `see`."""
    for i in range(len(out)):
        out[i, i] = 1.0 + 2.0 * SCALE * x[i]


def filter_of(kind: Kind, states: int) -> ModularFilter:
    """With one sensor, called "s"."""
    Q, R = 0.01 * np.eye(states), np.eye(MEASURED)
    if kind == "linear":
        F = np.kron([[1.0, DT, 0.0], [0.0, 1.0, DT], [0.0, 0.0, 1.0]], np.eye(states // 3))
        predictor, corrector = linear_predictor(F, Q), linear_corrector(np.eye(MEASURED, states), R)
    elif kind == "extended":
        predictor, corrector = extended_predictor(move, Q, move_jacobian), extended_corrector(see, R, see_jacobian)
    else:
        predictor, corrector = unscented_predictor(move, Q), unscented_corrector(see, R)
    return ModularFilter(predictor, [Sensor("s", corrector)], DT)


def jobs() -> dict[Key, Job]:
    """Those that are costed."""
    named_jobs: dict[Key, Job] = {}
    for states in STATES:
        for kind in KINDS:
            of_filter = modular_jobs(filter_of(kind, states))
            for part, name in zip(PARTS, ("predict", "correct.s"), strict=True):
                named_jobs[kind, str(states), part] = of_filter[name]
    return named_jobs


def operations() -> dict[Key, int]:
    """Counted exactly, each operation once whatever its kind."""
    return {key: count(job.function, *job.arguments(0)).total for key, job in jobs().items()}


def times(*, thorough: bool = False, seed: int = 0, progress: Progress = silent) -> Times:
    """Times of the compiled code on this machine; a minute or two if it was not compiled before."""
    protocol: Protocol = THOROUGH if thorough else QUICK
    timed = time_jobs(jobs(), "compiled", protocol, seed, progress)
    return Times(dict(timed.seconds.items()), where_timed(protocol, seed, timed.busy))
