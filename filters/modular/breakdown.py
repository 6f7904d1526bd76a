"""A part of a filter that left an estimate that is none: which, in which step, why, and what helps."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter, unscented_parts
from filters.modular.estimate import copy_estimate, empty
from filters.modular.kept import with_covariance
from filters.modular.space import NOTHING, Space, is_point
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Estimate

SOUND, PREDICTOR = -1, -2
"""In place of a sensor's number, where a kernel says which part broke down."""
GROWN = 1e100
"""Numbers beyond this have grown without bound; their squares are soon beyond all numbers."""


class Failure(NamedTuple):
    """at: the estimate from which the part started; after: what it left."""

    at: Estimate
    after: Estimate


class Cause(NamedTuple):
    """What happened, and what to give against it."""

    what: str
    remedy: str


def new_failure(space: Space) -> Failure:
    """Memory for one."""
    return Failure(empty(space), empty(space))


def failed(part: int, step: int, at: Estimate, after: Estimate, failure: Failure) -> tuple[int, int]:
    """Part and step, once the failure holds what `breakdown` looks at."""
    copy_estimate(at, failure.at)
    copy_estimate(after, failure.after)
    return part, step


def breakdown(composed: ModularFilter, part: int, step: int, failure: Failure, u: FloatArray) -> ValueError:
    """The error that says which part of a filter failed, in which step, why, and what to do.

    part: the number of a sensor, or PREDICTOR, which had the input u. failure: as the filter keeps its estimates.
    """
    with np.errstate(all="ignore"):
        failure = Failure(*(with_covariance(composed, each) for each in failure))
        if part == PREDICTOR:
            name, cause = "predictor", _of_predictor(composed, failure, u)
        else:
            name, cause = f"sensor {composed.sensors[part].name!r}", _of_sensor(composed, part, failure)
    return ValueError(f"{name}, step {step}: {cause.what}; give {cause.remedy}")


def _of_predictor(composed: ModularFilter, failure: Failure, u: FloatArray) -> Cause:
    predictor, space = composed.predictor, composed.of
    work, after = new_workspace(space, NOTHING), empty(space)
    predictor.predict(predictor.motion, space, failure.at, u, composed.dt, after, work)
    if predictor.kind == "extended":
        return (
            _of_function("f(x, u, dt, out)", space, after.x, failure.at.x, u)
            or _of_jacobian("f", work.F, failure.at.x, u)
            or _of_numbers(composed, failure)
        )
    if predictor.kind == "unscented":
        return _of_points("f(x, u, dt, out)", space, predictor.motion, work, work.moved, failure, u) or _of_numbers(
            composed, failure
        )
    return _of_numbers(composed, failure)


def _of_sensor(composed: ModularFilter, number: int, failure: Failure) -> Cause:
    space, corrector = composed.of, composed.sensors[number].corrector
    view, work = corrector.view(space.errors), new_workspace(space, corrector.observed)
    corrector.expect(view, corrector.observed, space, failure.at, work)
    if corrector.kind == "extended":
        return (
            _of_function("h(x, out)", corrector.observed, work.expected, failure.at.x)
            or _of_jacobian("h", work.H, failure.at.x)
            or _of_numbers(composed, failure)
        )
    if corrector.kind == "unscented":
        return _of_points("h(x, out)", corrector.observed, view, work, work.seen, failure) or _of_numbers(
            composed, failure
        )
    return _of_numbers(composed, failure)


def _of_function(name: str, space: Space, value: FloatArray, *arguments: FloatArray) -> Cause | None:
    if is_point(space, value):
        return None
    without = "has an attitude without length" if np.isfinite(value).all() else "is not finite"
    return _of_value(f"{name} {without}", arguments)


def _of_jacobian(function: str, value: FloatArray, *arguments: FloatArray) -> Cause | None:
    return None if np.isfinite(value).all() else _of_value(f"the Jacobian of {function} is not finite", arguments)


def _of_value(what: str, arguments: tuple[FloatArray, ...]) -> Cause:
    where = ", ".join(f"{name} = {value.tolist()}" for name, value in zip("xu", arguments, strict=False))
    return Cause(
        f"{what} at {where}, so that the estimate is no longer finite",
        "it a value there, or a start and inputs from which the filter does not get there",
    )


def _of_points(
    name: str, space: Space, unscented: Any, work: Workspace, images: FloatArray, failure: Failure, *u: FloatArray
) -> Cause | None:
    for point, image in zip(work.points, images, strict=True):
        cause = _of_function(name, space, image, point, *u)
        if cause:
            return cause
    if unscented.weighing.covariance_0 < 0 and not _has_grown(failure):
        return Cause(
            f"the covariance is no longer positive definite, for sigma point 0 counts "
            f"{unscented.weighing.covariance_0:.3g} times in it",
            "more noise (Q, R), or spread the points by merwe() with alpha = 1 and kappa = 0, which leaves no weight "
            "negative",
        )
    return None


def _of_numbers(composed: ModularFilter, failure: Failure) -> Cause:
    if _has_grown(failure):
        return Cause(
            "the estimate is no longer finite: the model lets it grow beyond all numbers",
            "a sensor that sees what grows, more of its measurements, or a model that does not grow so",
        )
    variances = np.diag(failure.at.P)
    form = []
    if not unscented_parts(composed):
        form = ["update='u-d' (with late='recalculate')"] if composed.update != "u-d" else []
    elif composed.update == "short":
        form = ["update='joseph'"]
    return Cause(
        f"the covariance is no longer positive definite: rounding is more than what is left of variances of "
        f"{variances.min():.3g} to {variances.max():.3g}",
        ", ".join([*form, "more noise (Q, R) or a smaller P0, so that one measurement does not tell so much"]),
    )


def _has_grown(failure: Failure) -> bool:
    return any((np.abs(value) > GROWN).any() for value in (*failure.at, *failure.after))
