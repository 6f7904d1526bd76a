"""The jobs of a composed filter of linear and extended parts while a late measurement is waited for, and when it comes.

Each starts from the same M, which they copy first: done again and again on its own result it would vanish or overflow.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from filters.arrays import FloatArray
from filters.kernels.dense import copy
from filters.modular.arrivals import whole
from filters.modular.composition import ModularFilter
from filters.modular.estimate import empty
from filters.modular.larsen import Flight, Given, accumulate
from filters.modular.space import NOTHING, Space
from filters.modular.typical import Moment
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Estimate


@cache
def accumulating(predict: Callable[..., None]) -> Callable[..., None]:
    """The prediction of these predictors that also takes M (n, n) to M_next. Same function in, same function out."""

    def predict_accumulate(
        motion: Any,
        space: Space,
        before: Estimate,
        u: FloatArray,
        dt: float,
        after: Estimate,
        M: FloatArray,
        M_next: FloatArray,
        work: Workspace,
    ) -> None:
        predict(motion, space, before, u, dt, after, work)
        copy(M, M_next)
        accumulate(M_next, work)

    return predict_accumulate


@cache
def larsen_correction_from(correct: Callable[..., None]) -> Callable[..., None]:
    """The correction by Larsen's way, from M (n, n). Same function in, same function out."""

    def correct_from(view: Any, observed: Space, work: Workspace, case: Given, M: FloatArray) -> None:
        copy(M, case.flight.M)
        correct(view, observed, work, case)

    return correct_from


def arguments_of_prediction(composed: ModularFilter, at: Moment) -> tuple[Any, ...]:
    """Those of `predict_accumulate`."""
    space, predictor = composed.of, composed.predictor
    flight = _flight(composed, at)
    work, after = new_workspace(space, NOTHING), empty(space)
    M_next = flight.M.copy()
    return predictor.motion, space, at.estimate, at.u, composed.dt, after, flight.M, M_next, work


def arguments_of_correction(composed: ModularFilter, number: int, late: bool, at: Moment) -> tuple[Any, ...]:
    """Those of `correct_from`, by the sensor of this number: late, or while another is waited for."""
    space, corrector = composed.of, composed.sensors[number].corrector
    view, observed = corrector.view(space.errors), corrector.observed
    flight = _flight(composed, at)
    case = Given(space, flight, late, True, at.estimate, at.y[number], whole(observed), empty(space))
    return view, observed, new_workspace(space, observed), case, flight.M.copy()


def _flight(composed: ModularFilter, at: Moment) -> Flight:
    """A measurement taken in the step before, as far as the covariance goes: M = F."""
    space, work = composed.of, new_workspace(composed.of, NOTHING)
    composed.predictor.predict(composed.predictor.motion, space, at.estimate, at.u, composed.dt, empty(space), work)
    return Flight(Estimate(at.estimate.x.copy(), at.estimate.P.copy()), work.F)
