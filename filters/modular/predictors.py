"""Predictors: what takes the estimate from one step to the next. Linear, extended or unscented."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray
from filters.kernels.dense import (
    add_matmul_blocked,
    add_matvec,
    copy,
    copy_diagonal,
    matmul_blocked,
    matvec,
    mirror,
    transpose,
)
from filters.modular.check import as_covariance, as_matrix
from filters.modular.sigma_points import USUAL, SigmaPoints, Weights, add_covariance, draw, mean, weights
from filters.modular.space import Space, minus, plus
from filters.modular.workspace import Workspace
from filters.records import Estimate

Kind: TypeAlias = Literal["linear", "extended", "unscented"]
Evolution: TypeAlias = Callable[[FloatArray, FloatArray, float, FloatArray], None]
"""f(x, u, dt, out) writes the state (numbers,) a time dt after x, under the input u, into out."""

DIFFERENCE = 1e-3
"""Standard deviations of each error between the point and those at which a numerical Jacobian is taken."""


class Predictor(NamedTuple):
    """How an estimate gets from one step to the next; as `linear_predictor` and others make it for `ModularFilter`.

    predict(motion, space, before, u, dt, after, work) fills `after` from `before`; motion: the model that it takes.
    evolve(motion, space, x, u, dt, x_next, work): its part that leaves F in work; None if it is unscented.
    states: the length of the state's error.
    """

    kind: Kind
    states: int
    predict: Callable[..., None]
    evolve: Callable[..., None] | None
    motion: Any


class LinearMotion(NamedTuple):
    """x' = F x + B u + w, w ~ N(0, Q)."""

    F: FloatArray
    B: FloatArray
    Q: FloatArray


class ExtendedMotion(NamedTuple):
    """x' = f(x, u) with an error w ~ N(0, Q); jacobian(x, u, dt, out) writes that of the error's evolution (n, n)."""

    f: Evolution
    jacobian: Evolution
    Q: FloatArray


class NumericMotion(NamedTuple):
    """An `ExtendedMotion`, its Jacobian by central differences."""

    f: Evolution
    Q: FloatArray


class UnscentedMotion(NamedTuple):
    """An `ExtendedMotion` without Jacobian."""

    f: Evolution
    weighing: Weights
    Q: FloatArray


def linear_predictor(F: ArrayLike, Q: ArrayLike, B: ArrayLike | None = None) -> Predictor:
    """x' = F x + B u + w of one step. F (n, n), Q (n, n), B (n, inputs); without B, inputs are not used.

    Raises:
        ValueError: a shape does not fit, a number is not finite, or Q is no covariance.
    """
    noise = as_covariance("linear_predictor: Q", Q)
    n = len(noise)
    motion = as_matrix("linear_predictor: F", F, (n, n))
    entry = np.zeros((n, 0)) if B is None else as_matrix("linear_predictor: B", B, (n, None))
    return Predictor("linear", n, predict_linear, evolve_linear, LinearMotion(motion, entry, noise))


def extended_predictor(f: Evolution, Q: ArrayLike, jacobian: Evolution | None = None) -> Predictor:
    """Any evolution, linearised at the estimate.

    f(x, u, dt, out) writes the state a time dt after x into out, with input u; Q (n, n): the noise of one step.
    jacobian(x, u, dt, out) writes into out (n, n) how an error of x evolves; by central differences if not given.
    The functions are plain Python that numba can compile.

    Raises:
        ValueError: Q is no covariance.
    """
    noise = as_covariance("extended_predictor: Q", Q)
    if jacobian is None:
        return Predictor("extended", len(noise), predict_numeric, evolve_numeric, NumericMotion(f, noise))
    return Predictor("extended", len(noise), predict_extended, evolve_extended, ExtendedMotion(f, jacobian, noise))


def unscented_predictor(f: Evolution, Q: ArrayLike, points: SigmaPoints = USUAL) -> Predictor:
    """Any evolution, of 2 n + 1 sigma points. f, Q as in `extended_predictor`.

    Raises:
        ValueError: Q is no covariance, or the points have no spread.
    """
    noise = as_covariance("unscented_predictor: Q", Q)
    weighing = weights(points, len(noise))
    return Predictor("unscented", len(noise), predict_unscented, None, UnscentedMotion(f, weighing, noise))


def evolve_linear(
    motion: LinearMotion, _of: Space, x: FloatArray, u: FloatArray, _dt: float, x_next: FloatArray, work: Workspace
) -> None:
    """x' = F x + B u; F."""
    matvec(motion.F, x, x_next)
    add_matvec(motion.B, u, x_next)
    copy(motion.F, work.F)


def evolve_extended(
    motion: ExtendedMotion, _of: Space, x: FloatArray, u: FloatArray, dt: float, x_next: FloatArray, work: Workspace
) -> None:
    """x' = f(x, u), and F the Jacobian at x."""
    motion.f(x, u, dt, x_next)
    motion.jacobian(x, u, dt, work.F)


def evolve_numeric(
    motion: NumericMotion, space: Space, x: FloatArray, u: FloatArray, dt: float, x_next: FloatArray, work: Workspace
) -> None:
    """`evolve_extended` with F by central differences of f; work has the variances of x."""
    motion.f(x, u, dt, x_next)
    for i in range(space.errors):
        step = difference(space, x, i, work)
        motion.f(work.points[0], u, dt, work.moved[0])
        motion.f(work.points[1], u, dt, work.moved[1])
        minus(space, work.moved[0], work.moved[1], work.n1)
        scale = 0.5 / step
        for e in range(space.errors):
            work.F[e, i] = scale * work.n1[e]


def _prediction_by(evolve: Callable[..., None]) -> Callable[..., None]:
    """The job of a linear or extended predictor: x', and P' = F P F^T + Q."""

    def predict(
        motion: Any, space: Space, before: Estimate, u: FloatArray, dt: float, after: Estimate, work: Workspace
    ) -> None:
        copy_diagonal(before.P, work.variances)
        evolve(motion, space, before.x, u, dt, after.x, work)
        propagate(motion.Q, before.P, after.P, work)

    return predict


predict_linear = _prediction_by(evolve_linear)
predict_extended = _prediction_by(evolve_extended)
predict_numeric = _prediction_by(evolve_numeric)


def difference(space: Space, x: FloatArray, i: int, work: Workspace) -> float:
    """points[0] and points[1] of work = the point moved along error i, by the step that is returned and its negative.

    A small share of the standard deviation: as long as the errors that the filter expects, whatever their unit. work
    has the variances.
    """
    step: float = DIFFERENCE * np.sqrt(work.variances[i])
    if not step > 0.0:
        step = DIFFERENCE
    for e in range(space.errors):
        work.n1[e] = 0.0
    work.n1[i] = step
    plus(space, x, work.n1, work.points[0])
    work.n1[i] = -step
    plus(space, x, work.n1, work.points[1])
    return step


def predict_unscented(
    motion: UnscentedMotion,
    space: Space,
    before: Estimate,
    u: FloatArray,
    dt: float,
    after: Estimate,
    work: Workspace,
) -> None:
    """Job: x' and P' are mean and covariance of the sigma points, each moved by f; Q is added."""
    draw(space, before.x, before.P, motion.weighing.spread, work.nn1, work.errors, work.points)
    for i in range(len(work.points)):
        motion.f(work.points[i], u, dt, work.moved[i])
    mean(space, work.moved, motion.weighing, work.moved_errors, work.n1, after.x)
    copy(motion.Q, after.P)
    add_covariance(work.moved_errors, work.moved_errors, motion.weighing, after.P)
    mirror(after.P)


def propagate(Q: FloatArray, P: FloatArray, P_next: FloatArray, work: Workspace) -> None:
    """P_next = F P F^T + Q with the F in work."""
    matmul_blocked(work.F, P, work.nn1)
    transpose(work.F, work.nn2)
    add_matmul_blocked(Q, work.nn1, work.nn2, P_next)
    mirror(P_next)
