"""The jobs of the dual-rate filter of several sensors, of linear and extended parts, see `high_rate` and `low_rate`.

Each starts from the same memory, which it copies first where it is written to: done again and again on its own result
it would vanish or overflow.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

from filters.arrays import Flags, FloatArray
from filters.jobs import Job
from filters.kernels.dense import copy, copy_diagonal, copy_vector
from filters.modular.arrivals import whole
from filters.modular.carried_gain import taking_by
from filters.modular.composition import ModularFilter
from filters.modular.estimate import empty
from filters.modular.high_rate import hr_pass, hr_update, propagating, restarting
from filters.modular.low_rate import gain_again, lr_correct, lr_propagate
from filters.modular.space import NOTHING
from filters.modular.typical import Moment
from filters.modular.updates import Covariance, covariance_of, joseph
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Transition

Arguments = Callable[[Moment], tuple[Any, ...]]


def dual_rate_jobs(composed: ModularFilter, job: Callable[[str, Callable[..., None], Arguments], Job]) -> list[Job]:
    """The high-rate task's in a step after a knot, in any other, and at a landing; the low-rate task's from knot to
    knot. Then for each sensor: its gain; again, after a loss; the covariance with the gain that it has, where that has
    landed; delta on arrival; and a landing that goes past it."""
    evolve = composed.predictor.evolve
    assert evolve is not None  # no part is unscented, see `modular_jobs`
    jobs = [
        job("hr_propagate", propagating(evolve), partial(_propagating, composed)),
        job("hr_restart", restarting(evolve), partial(_restarting, composed)),
        job("hr_update", hr_update, partial(_updating, composed)),
        job("lr_propagate", lr_propagate, partial(_carrying, composed)),
    ]
    for number, sensor in enumerate(composed.sensors):
        corrector = sensor.corrector
        covariance = covariance_of(composed.update, corrector.kind)
        for kind, function, arguments in (
            ("gain", taking_by(corrector.expect, covariance), _taking),
            ("gain_again", gain_again(covariance), _gaining_again),
            ("gain_kept", keeping_gain(joseph), _keeping),
            ("lr_correct", lr_correct, _correcting),
            ("hr_pass", pass_from, _passing),
        ):
            jobs.append(job(f"{kind}.{sensor.name}", function, partial(arguments, composed, number)))
    return jobs


def pass_from(
    Phi: FloatArray,
    H: FloatArray,
    gain: FloatArray,
    start: FloatArray,
    delta: FloatArray,
    known: FloatArray,
    scratch: FloatArray,
) -> None:
    """Job: a landing goes past a knot."""
    copy_vector(start, delta)
    hr_pass(Phi, H, gain, delta, known, scratch)


@cache
def keeping_gain(covariance: Covariance) -> Callable[..., None]:
    """Job: the covariance of a knot whose gain stays, where that before it is another. Same function in, same out."""

    def keep_gain(
        view: Any, P: FloatArray, H: FloatArray, gain: FloatArray, P_after: FloatArray, work: Workspace
    ) -> None:
        copy(H, work.H)
        copy(gain, work.gain)
        covariance(view, P, P_after, work)

    return keep_gain


def _restarting(composed: ModularFilter, at: Moment) -> tuple[Any, ...]:
    space, motion = composed.of, composed.predictor.motion
    work = new_workspace(space, NOTHING)
    copy_diagonal(at.estimate.P, work.variances)
    n, x_next = space.errors, at.estimate.x.copy()
    following = Transition(np.zeros((n, n)), np.zeros((n, n)))
    return motion, space, at.estimate.x, at.u, composed.dt, x_next, following, work


def _propagating(composed: ModularFilter, at: Moment) -> tuple[Any, ...]:
    *given, following, work = _restarting(composed, at)
    return *given, _transition(composed, at), following, work


def _updating(composed: ModularFilter, at: Moment) -> tuple[Any, ...]:
    space = composed.of
    delta = np.sqrt(np.diag(at.estimate.P))
    corrected, work = at.estimate.x.copy(), new_workspace(space, NOTHING)
    return space, at.estimate.x, _transition(composed, at).Phi, delta, corrected, work


def _carrying(composed: ModularFilter, at: Moment) -> tuple[Any, ...]:
    work = new_workspace(composed.of, NOTHING)
    return at.estimate.P, _transition(composed, at), np.zeros_like(at.estimate.P), work


def _taking(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    corrector = composed.sensors[number].corrector
    view, observed = corrector.view(composed.of.errors), corrector.observed
    return view, observed, composed.of, at.estimate, empty(composed.of), new_workspace(composed.of, observed)


def _gaining_again(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    """Of a knot behind the one that was lost: of its own nothing is."""
    view, observed, *_, work = _taken(composed, number, at)
    return view, at.estimate.P, whole(observed), np.zeros_like(at.estimate.P), work


def _keeping(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    view, *_, work = _taken(composed, number, at)
    P = at.estimate.P
    return view, P, work.H.copy(), work.gain.copy(), np.zeros_like(P), work


def _correcting(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    _, observed, *_, work = _taken(composed, number, at)
    lost: Flags = whole(observed)
    known, delta = np.sqrt(np.diag(work.S)), np.zeros(composed.of.errors)
    return observed, at.y[number], lost, work.expected.copy(), known, work.gain.copy(), delta, work


def _passing(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    *_, work = _taken(composed, number, at)
    start = np.sqrt(np.diag(at.estimate.P))
    delta, known, scratch = np.zeros_like(start), np.zeros(len(work.S)), np.zeros_like(start)
    return _transition(composed, at).Phi, work.H.copy(), work.gain.copy(), start, delta, known, scratch


def _taken(composed: ModularFilter, number: int, at: Moment) -> tuple[Any, ...]:
    """A knot of the sensor, taken now: what took it has its arguments."""
    arguments = _taking(composed, number, at)
    corrector = composed.sensors[number].corrector
    taking_by(corrector.expect, covariance_of(composed.update, corrector.kind))(*arguments)
    return arguments


def _transition(composed: ModularFilter, at: Moment) -> Transition:
    """Of one step."""
    evolve = composed.predictor.evolve
    assert evolve is not None
    arguments = _restarting(composed, at)
    restarting(evolve)(*arguments)
    following: Transition = arguments[-2]
    return following
