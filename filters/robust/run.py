"""Many steps of the robust filter in one call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from filters.arrays import FloatArray, as_array
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.breakdown import breakdown, first_broken
from filters.choice import check_choice
from filters.measured import Measurements, measured
from filters.robust.check import check_inputs, check_start
from filters.robust.model import prepared, weights, without_measurement
from filters.robust.records import Predicted, RobustModel, Weights
from filters.robust.step import JOBS, REMEDY, WAYS, WayName, step


class RobustHistory(NamedTuple):
    """x (steps + 1, n) and P (steps + 1, n, n): row 0 is the start, row i + 1 is what step i predicts."""

    x: FloatArray
    P: FloatArray


class WeightsByStep(NamedTuple):
    """`Weights` with the step as first index."""

    Phi1: FloatArray
    Phi2: FloatArray
    inverse_lambda: FloatArray


def step_all(
    step: Callable[..., None],
    models: RobustModel,
    weights: WeightsByStep,
    measurements: FloatArray,
    added: FloatArray,
    history: RobustHistory,
    work: Any,
) -> None:
    """The whole filter as one kernel: `history` holds the start in row 0 and is filled.

    models and weights: each array with the step as first index, taken modulo its length.
    """
    for i in range(len(measurements)):
        k = i % len(models.F)
        model = RobustModel(
            models.F[k],
            models.G[k],
            models.H[k],
            models.D[k],
            models.Q[k],
            models.R[k],
            models.E_F[k],
            models.E_G[k],
            models.E_H[k],
            models.E_D[k],
            models.M1[k],
            models.M2[k],
        )
        weighing = Weights(weights.Phi1[k], weights.Phi2[k], weights.inverse_lambda[k])
        before, after = Predicted(history.x[i], history.P[i]), Predicted(history.x[i + 1], history.P[i + 1])
        step(model, weighing, before, measurements[i], added[i], after, work)


@np.errstate(all="ignore")
def run(
    models: RobustModel | Sequence[RobustModel],
    x0: ArrayLike,
    P0: ArrayLike,
    measurements: Measurements,
    c: ArrayLike | None = None,
    *,
    mu: float = np.inf,
    xi: float = 0.1,
    way: WayName = "closed",
    backend: BackendName = "reference",
) -> RobustHistory:
    """Filter a record of data; otherwise as `step`.

    models: one for all steps, or one per step. x0 (n,), P0 (n, n): the prediction for step 0.
    measurements (steps, p): row i is used in step i. None in place of a row, or of a number in it, says that it was
        lost: the step is that of the model without its rows of H, D and M2, or of the one in which nothing is measured.
    c (steps, n): row i is added in step i; zero if not given.

    Raises:
        ValueError: as `step`; models are not as many as measurements, or leave different numbers of E rows; or P ceases
            to be a covariance, and the step is named.
    """
    check_choice("way", way, WAYS)
    ready = [prepared(model, mu, xi) for model in ([models] if isinstance(models, RobustModel) else models)]
    readings = measured(len(ready[0].H), 1, measurements)
    added = np.zeros((len(readings.y), len(ready[0].F))) if c is None else as_array("c", c)
    if len(ready) not in (1, len(readings.y)) or len(added) != len(readings.y):
        raise ValueError(
            f"there are {len(readings.y)} measurements, but {len(ready)} models and {len(added)} rows of c"
        )
    if len({tuple(matrix.shape for matrix in model) for model in ready}) > 1:
        raise ValueError(
            "models differ in shape, or in which of their E rows are zero; run them one by one with `step`"
        )
    n = len(ready[0].F)
    history = RobustHistory(np.empty((len(readings.y) + 1, n)), np.empty((len(readings.y) + 1, n, n)))
    start = Predicted(as_array("x0", x0), as_array("P0", P0))
    check_start(ready[0], start.x, start.P)
    check_inputs(ready[0], readings.y, added)
    history.x[0], history.P[0] = start
    if readings.present.all():
        job = JOBS[way]
        function_for(backend, step_all)(
            arguments_for(backend, job.function),
            RobustModel(*(np.stack(matrices) for matrices in zip(*ready, strict=True))),
            WeightsByStep(
                *(np.array(values) for values in zip(*(weights(model, mu, xi) for model in ready), strict=True))
            ),
            readings.y,
            added,
            history,
            job.workspace(ready[0]),
        )
    else:
        for i, present in enumerate(readings.present):
            model = _with_rows(ready[i % len(ready)], present)
            before = Predicted(history.x[i], history.P[i])
            after = step(model, before, readings.y[i, present], added[i], mu=mu, xi=xi, way=way, backend=backend)
            history.x[i + 1], history.P[i + 1] = after
    broken = first_broken(history.x, history.P, 1, backend)
    if broken is not None:
        raise breakdown(broken - 1, REMEDY)
    return history


def _with_rows(model: RobustModel, present: NDArray[np.bool_]) -> RobustModel:
    """The model of a step from which only these numbers of the measurement (p,) came."""
    if not present.any():
        return without_measurement(model)
    return model._replace(H=model.H[present], D=model.D[present], M2=model.M2[present])
