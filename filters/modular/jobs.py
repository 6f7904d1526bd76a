"""The jobs of a composed filter: what it does in every step, and for each measurement, so that it can be costed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from numpy.typing import ArrayLike

from filters.jobs import Job
from filters.modular.arrivals import whole
from filters.modular.composition import ModularFilter, unscented_parts
from filters.modular.correction import correction
from filters.modular.dual_rate_jobs import dual_rate_jobs
from filters.modular.estimate import empty
from filters.modular.in_flight_jobs import (
    arguments_beside,
    arguments_of_carrying,
    arguments_of_landing,
    carry_from,
    correct_beside,
    land_from,
)
from filters.modular.kept import keep
from filters.modular.larsen import larsen_correction
from filters.modular.larsen_jobs import (
    accumulating,
    arguments_of_correction,
    arguments_of_prediction,
    larsen_correction_from,
)
from filters.modular.prediction import prediction
from filters.modular.space import NOTHING
from filters.modular.typical import Moment, near, typical_moment
from filters.modular.workspace import new_workspace


def modular_jobs(
    composed: ModularFilter,
    x0: ArrayLike | None = None,
    P0: ArrayLike | None = None,
    u: ArrayLike | None = None,
    seed: int = 0,
) -> dict[str, Job]:
    """The jobs by part of the filter: "predict", and "correct.NAME" for each sensor. See `registry.Job`.

    Where no part is unscented and the covariance is not kept as factors, also those of Larsen's way with late
    measurements: "predict_accumulate", and for each sensor "correct_accumulate.NAME" and "correct_late.NAME"; and those
    of several in flight. Of carried gains for each sensor "carry.NAME", a step of one that it measured, "beside.NAME",
    what each in flight adds to a correction by it, and "land.NAME". Of products of transitions "carry_product", and
    "beside_product.NAME" and "land_product.NAME". Of the dual-rate filter "hr_propagate", "hr_restart", "hr_update" and
    "lr_propagate", and for each sensor "gain.NAME", "gain_again.NAME", "gain_kept.NAME", "lr_correct.NAME" and
    "hr_pass.NAME".

    x0, P0, u: a typical state and covariance to start from, and a typical input, see `typical.typical_moment`.

    Raises:
        ValueError: as `typical_moment`.
    """
    typical = typical_moment(composed, x0, P0, u, seed)

    def job(kind: str, function: Callable[..., None], arguments: Callable[[Moment], tuple[Any, ...]]) -> Job:
        return Job(kind, function, lambda index: arguments(near(composed, typical, seed, index)))

    predict = prediction(composed)
    jobs = [job("predict", predict, partial(_predict, composed))]
    for number, sensor in enumerate(composed.sensors):
        correct = correction(composed, sensor.corrector)
        jobs.append(job(f"correct.{sensor.name}", correct, partial(_correct, composed, number)))
    if not unscented_parts(composed) and composed.update != "u-d":
        accumulate = accumulating(predict)
        jobs.append(job("predict_accumulate", accumulate, partial(arguments_of_prediction, composed)))
        for number, sensor in enumerate(composed.sensors):
            correct = larsen_correction_from(larsen_correction(composed, sensor.corrector))
            for kind, late in (("correct_accumulate", False), ("correct_late", True)):
                arguments = partial(arguments_of_correction, composed, number, late)
                jobs.append(job(f"{kind}.{sensor.name}", correct, arguments))
        for products in (False, True):
            jobs += _in_flight_jobs(composed, job, products)
        jobs += dual_rate_jobs(composed, job)
    return {job.kind: job for job in jobs}


def _in_flight_jobs(composed: ModularFilter, job: Callable[..., Job], products: bool) -> list[Job]:
    """products: of transitions are carried, not gains."""
    kind = "_product" if products else ""
    jobs = []
    for number, sensor in enumerate(composed.sensors):
        carry, beside, lands = (
            partial(arguments, composed, number, products)
            for arguments in (arguments_of_carrying, arguments_beside, arguments_of_landing)
        )
        if not products:
            jobs.append(job(f"carry.{sensor.name}", carry_from, carry))
        elif number == 0:  # whatever the sensor
            jobs.append(job("carry_product", carry_from, carry))
        jobs += [job(f"beside{kind}.{sensor.name}", correct_beside, beside)]
        jobs += [job(f"land{kind}.{sensor.name}", land_from, lands)]
    return jobs


def _predict(composed: ModularFilter, at: Moment) -> tuple[Any, ...]:
    space, motion = composed.of, composed.predictor.motion
    return motion, space, keep(composed, at.estimate), at.u, composed.dt, empty(space), new_workspace(space, NOTHING)


def _correct(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    space, corrector = composed.of, composed.sensors[number].corrector
    view, observed = corrector.view(space.errors), corrector.observed
    work = new_workspace(space, observed)
    return view, observed, space, keep(composed, at.estimate), at.y[number], whole(observed), empty(space), work
