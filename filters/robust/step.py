"""One step of the robust filter, in four ways that give the same."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from filters.backends.choose import BackendName, function_for
from filters.choice import check_choice
from filters.kernels.definite import is_semidefinite
from filters.robust.block_step import BlockWorkspace, block_step, new_block_workspace
from filters.robust.blocks import NATURAL, RECOMMENDED
from filters.robust.check import check_inputs, check_start
from filters.robust.closed import new_closed_workspace, step_closed
from filters.robust.model import prepared, weights
from filters.robust.records import Predicted, RobustModel
from filters.robust.solvers import (
    by_dense_lu,
    by_faddeev,
    by_givens,
    by_givens_per_column,
    by_householder,
    by_inverse,
    by_lu,
    by_nonzero_inverse,
    by_repeated_elimination,
    by_unpivoted_lu,
)

__all__ = ["JOBS", "REMEDY", "STUDIED", "WAYS", "Predicted", "StepJob", "WayName", "step"]

WayName: TypeAlias = Literal["inverse", "givens", "lu", "closed"]


class StepJob(NamedTuple):
    """function(model, weights, before, y, c, after, work) is the step; workspace(model) makes its work."""

    function: Callable[..., None]
    workspace: Callable[[RobustModel], Any]


def _blocks(solve_last: Callable[[BlockWorkspace], None], order: tuple[int, ...]) -> StepJob:
    return StepJob(block_step(solve_last), partial(new_block_workspace, order=order))


JOBS: dict[WayName, StepJob] = {
    "inverse": _blocks(by_inverse, NATURAL),
    "givens": _blocks(by_givens, RECOMMENDED),
    "lu": _blocks(by_lu, RECOMMENDED),
    "closed": StepJob(step_closed, new_closed_workspace),
}
WAYS: tuple[WayName, ...] = tuple(JOBS)

STUDIED: dict[str, StepJob] = {
    "givens, natural order": _blocks(by_givens, NATURAL),
    "givens per column, natural order": _blocks(by_givens_per_column, NATURAL),
    "householder": _blocks(by_householder, RECOMMENDED),
    "householder, natural order": _blocks(by_householder, NATURAL),
    "faddeev": _blocks(by_faddeev, RECOMMENDED),
    "faddeev, natural order": _blocks(by_faddeev, NATURAL),
    "lu, natural order": _blocks(by_lu, NATURAL),
    "dense lu": _blocks(by_dense_lu, NATURAL),
    "lu without pivoting": _blocks(by_unpivoted_lu, NATURAL),
    "inverse, nonzero entries": _blocks(by_nonzero_inverse, NATURAL),
    "inverse by repeated elimination": _blocks(by_repeated_elimination, NATURAL),
}
"""Further ways, to be compared with those above; not all of them work."""

REMEDY = "give states in units in which their errors are of one size, way='closed', or mu=inf"
"""What to do about rounding."""


def is_sound(after: Predicted) -> bool:
    """Whether a step has left finite numbers and a covariance, up to rounding."""
    return bool(np.isfinite(after.x).all()) and is_semidefinite(after.P, np.empty_like(after.P))


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
            and the step has no solution, a name is unknown, or the step leaves no finite numbers or no covariance.
    """
    check_choice("way", way, WAYS)
    ready = prepared(model, mu, xi)
    start = Predicted(*(np.array(value, dtype=np.float64, order="C") for value in before))
    measured, added = (np.array(value, dtype=np.float64) for value in (y, c))
    check_start(ready, start.x, start.P)
    check_inputs(ready, measured, added)
    after = Predicted(np.empty_like(start.x), np.empty_like(start.P))
    job = JOBS[way]
    with np.errstate(all="ignore"):
        function_for(backend, job.function)(
            ready, weights(ready, mu, xi), start, measured, added, after, job.workspace(ready)
        )
    if not is_sound(after):
        raise ValueError(f"the step leaves a P that is no covariance, or a value that is not finite; {REMEDY}")
    return after
