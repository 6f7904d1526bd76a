"""One step of the robust filter, in four ways that give the same."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from filters.kernels.backends import BackendName, function_for
from filters.problem import check_choice
from filters.robust.check import check_inputs, check_start
from filters.robust.closed import new_closed_workspace, step_closed
from filters.robust.model import RobustModel, prepared, weights
from filters.robust.records import Predicted

__all__ = ["JOBS", "WAYS", "Predicted", "StepJob", "WayName", "step"]

WayName: TypeAlias = Literal["inverse", "givens", "lu", "closed"]


class StepJob(NamedTuple):
    """function(model, weights, before, y, c, after, work) is the step; workspace(model) makes its work."""

    function: Callable[..., None]
    workspace: Callable[[RobustModel], Any]


JOBS: dict[str, StepJob] = {
    "closed": StepJob(step_closed, new_closed_workspace),
}
WAYS: tuple[WayName, ...] = ("inverse", "givens", "lu", "closed")


def step(
    model: RobustModel,
    before: Predicted,
    y: ArrayLike,
    c: ArrayLike,
    *,
    mu: float = np.inf,
    xi: float = 0.1,
    way: WayName = "closed",
    backend: BackendName = "reference",
) -> Predicted:
    """x_{i+1|i} and P_{i+1|i} from x_{i|i-1} and P_{i|i-1}.

    y (p,): the measurement. c (n,): what is added to F x: zero for a linear model. One that is linearised at the
    estimate x has c = f(x) - F x and the measurement y - h(x) + H x.
    mu: the penalty on the model's equations; infinite: they hold exactly, and M1, M2 and xi play no part.
    xi: how far lambda lies above its lower bound, relatively.

    Raises:
        ValueError: a shape does not fit, P, Q or R is not positive definite, mu or xi is not positive, mu is infinite
            and the step has no solution, or a name is unknown.
    """
    check_choice("way", way, WAYS)
    ready = prepared(model, mu, xi)
    start = Predicted(*(np.array(value, dtype=np.float64, order="C") for value in before))
    measured, added = (np.array(value, dtype=np.float64) for value in (y, c))
    check_start(ready, start.x, start.P)
    check_inputs(ready, measured, added)
    after = Predicted(np.empty_like(start.x), np.empty_like(start.P))
    job = JOBS.get(way, JOBS["closed"])
    function_for(backend, job.function)(
        ready, weights(ready, mu, xi), start, measured, added, after, job.workspace(ready)
    )
    return after
