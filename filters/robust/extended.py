"""The extended robust Kalman filter along a record of data: predictions at a high rate, measurements every N-th step.

With `no_uncertainty` and an infinite mu it is the extended Kalman filter, in its one-step-predictor form.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import breakdown, first_broken
from filters.choice import check_choice
from filters.kernels.dense import store_vector
from filters.kind import check_kind
from filters.robust.check import check_start
from filters.robust.model import prepared, weights, without_measurement
from filters.robust.records import Predicted, RobustModel, Weights
from filters.robust.step import JOBS, REMEDY, STUDIED, StepJob
from filters.robust.uncertain import Scaling, UncertainSystem, Uncertainty, linearised
from filters.running import running

ALLOCATION_FREE = False


class ExtendedHistory(NamedTuple):
    """What step i predicts is row i + 1; row 0 is the start.

    x (steps + 1, n): in the units of the system. P (steps + 1, n, n): scaled. scaled_x (steps + 1, n).
    """

    x: FloatArray
    P: FloatArray
    scaled_x: FloatArray


class Setting(NamedTuple):
    """A step with a measurement, or one without: the model, whose F and G are overwritten, weights and scratch."""

    model: RobustModel
    weights: Weights
    work: Any


class ExtendedWorkspace(NamedTuple):
    """Scratch arrays: f(x) (n,), the residual (p,) and what the step takes for a measurement (p,), none, and c (n,)."""

    next_x: FloatArray
    residual: FloatArray
    y: FloatArray
    no_y: FloatArray
    c: FloatArray


def linearise(
    system: UncertainSystem,
    scaling: Scaling,
    x: FloatArray,
    u: FloatArray,
    scaled_x: FloatArray,
    model: RobustModel,
    work: ExtendedWorkspace,
) -> None:
    """Job: F and G of the scaled model at x (n,), and c = f(x) - F x; `scaled_x` is the same state, scaled."""
    unit = scaling.unit
    n, m = model.G.shape
    system.f(x, u, system.parameters, work.next_x)
    system.F(x, u, system.parameters, model.F)
    system.G(x, u, system.parameters, model.G)
    for i in range(n):
        scale = 1.0 / unit[i]
        for j in range(m):
            model.G[i, j] *= scale
        total = (work.next_x[i] - scaling.origin[i]) * scale
        for j in range(n):
            model.F[i, j] *= scale * unit[j]
            total -= model.F[i, j] * scaled_x[j]
        work.c[i] = total


def robust_step(
    system: UncertainSystem,
    scaling: Scaling,
    step: Callable[..., None],
    y: FloatArray,
    x: FloatArray,
    u: FloatArray,
    before: Predicted,
    seen: Setting,
    after: Predicted,
    work: ExtendedWorkspace,
) -> None:
    """Job: linearised at x (n,), which is before.x in the units of the system, a prediction becomes that of the next
    step, with the measurement y (p,).

    step: the function of a way in `filters.robust.step.JOBS`.
    """
    linearise(system, scaling, x, u, before.x, seen.model, work)
    system.residual(y, x, work.residual)
    for k in range(len(work.y)):
        total = work.residual[k] / scaling.measurement_unit[k]
        for j in range(len(x)):
            total += seen.model.H[k, j] * before.x[j]
        work.y[k] = total
    step(seen.model, seen.weights, before, work.y, work.c, after, seen.work)


def filter_all(
    system: UncertainSystem,
    scaling: Scaling,
    step: Callable[..., None],
    N: int,
    seen: Setting,
    unseen: Setting,
    inputs: FloatArray,
    measurements: FloatArray,
    available: NDArray[np.bool_],
    history: ExtendedHistory,
    work: ExtendedWorkspace,
) -> None:
    """The whole filter as one kernel: `history` holds the start in row 0 and is filled. Shapes as in `run`."""
    for i in range(len(inputs)):
        x, u, cycle = history.x[i], inputs[i], i // N
        before = Predicted(history.scaled_x[i], history.P[i])
        after = Predicted(history.scaled_x[i + 1], history.P[i + 1])
        if i % N == 0 and available[cycle]:
            robust_step(system, scaling, step, measurements[cycle], x, u, before, seen, after, work)
        else:
            linearise(system, scaling, x, u, before.x, unseen.model, work)
            step(unseen.model, unseen.weights, before, work.no_y, work.c, after, unseen.work)
        for k in range(len(x)):
            work.next_x[k] = scaling.origin[k] + scaling.unit[k] * after.x[k]
        store_vector(work.next_x, history.x, i + 1)


@running("system")
def run(
    system: UncertainSystem,
    scaling: Scaling,
    uncertainty: Uncertainty,
    N: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: FloatArray,
    available: NDArray[np.bool_] | None = None,
    *,
    mu: float = np.inf,
    xi: float = 0.1,
    way: str = "closed",
    backend: BackendName = "compiled",
) -> ExtendedHistory:
    """Filter a record of data.

    x0 (n,), in the units of the system, P0 (n, n), scaled: the prediction for step 0.
    inputs (steps, any): row i takes the state from i to i + 1.
    measurements (cycles, p): row c is taken in step cN and used in it. available (cycles,): false where it is missing.
    mu, xi: as in `filters.robust.step.step`. way: of `filters.robust.step`, one of JOBS or STUDIED.
        Where one of STUDIED breaks down, as LU without pivoting may, the rest of the history is nan.

    Raises:
        ValueError: N or the number of measurements is wrong, the model fails the checks of `prepared`, x0 and P0 those
            of `step`, an input or a measurement that is not missing is not finite, the system cannot be at a state
            (such as a pitch of 90 degrees), a name is unknown, or P ceases to be a covariance: the step is named.
    """
    jobs: dict[str, StepJob] = dict([*JOBS.items(), *STUDIED.items()])
    check_kind("system", system, UncertainSystem, "an UncertainSystem")
    check_choice("way", way, tuple(jobs))
    cycles = -(-len(inputs) // N) if N >= 1 else 0
    availability = np.ones(cycles, dtype=np.bool_) if available is None else available
    if N < 1 or len(measurements) < cycles or len(availability) < cycles:
        raise ValueError(
            f"N={N} must be at least 1, and {len(inputs)} steps need {cycles} rows of measurements and availability; "
            f"there are {len(measurements)} and {len(availability)}"
        )
    for name, values in (("inputs", inputs), ("measurements", measurements[:cycles][availability[:cycles]])):
        if not np.isfinite(values).all():
            raise ValueError(f"{name} holds a value that is not finite; say with `available` which measurements came")
    n, steps = len(x0), len(inputs)
    model = linearised(system, scaling, uncertainty, x0, inputs[0])
    job = jobs[way]
    seen, unseen = (_setting(kind, mu, xi, job.workspace) for kind in (model, without_measurement(model)))
    history = ExtendedHistory(np.empty((steps + 1, n)), np.empty((steps + 1, n, n)), np.empty((steps + 1, n)))
    history.x[0], history.P[0], history.scaled_x[0] = x0, P0, (x0 - scaling.origin) / scaling.unit
    check_start(seen.model, history.scaled_x[0], history.P[0])
    p = len(system.R)
    work = ExtendedWorkspace(np.empty(n), np.empty(p), np.empty(p), np.empty(0), np.empty(n))
    function_for(backend, filter_all)(
        arguments_for(backend, system),
        scaling,
        arguments_for(backend, job.function),
        N,
        seen,
        unseen,
        inputs,
        measurements,
        availability,
        history,
        work,
    )
    broken = None if way in STUDIED else first_broken(history.x, history.P, 1, backend)
    if broken is not None:
        raise breakdown(broken - 1, REMEDY)
    return history


def _setting(model: RobustModel, mu: float, xi: float, workspace: Callable[[RobustModel], Any]) -> Setting:
    ready = prepared(model, mu, xi)
    return Setting(ready, weights(ready, mu, xi), workspace(ready))
