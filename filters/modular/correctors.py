"""Correctors: what one measurement of one sensor says about the state. Linear, extended or unscented."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import Flags, FloatArray
from filters.kernels.dense import copy, copy_diagonal, matmul_blocked, matvec
from filters.kernels.place import clear
from filters.kernels.solve import cholesky, solve_cholesky
from filters.modular.check import as_matrix, as_noise, as_numbers
from filters.modular.predictors import Kind, difference
from filters.modular.sigma_points import USUAL, SigmaPoints, Weights, add_covariance, draw, mean, weights
from filters.modular.space import Space, as_space, minus, plain, space
from filters.modular.workspace import Workspace
from filters.records import Estimate

Observation: TypeAlias = Callable[[FloatArray, FloatArray], None]
"""h(x, out) writes the measurement expected at the state x into out."""


class Corrector(NamedTuple):
    """What a measurement of one sensor says about the state; as `linear_corrector` and others make it for `Sensor`.

    expect(view, observed, space, before, work) fills `expected`, `S` and `cross` of work, and `H` unless unscented.
    observe(view, observed, space, x, work): its part that fills `expected` and `H`; None if it is unscented.
    view(n): the model that expect takes, for a state whose error has length n; raises ValueError if it does not fit.
    observed: what a measurement stands for; of: what the state stands for. R (p, p): of the measurement's error.
    """

    kind: Kind
    expect: Callable[..., None]
    observe: Callable[..., None] | None
    view: Callable[[int], Any]
    observed: Space
    R: FloatArray


class LinearView(NamedTuple):
    """y = H x + v, v ~ N(0, R), where an attitude in x counts as zero."""

    H: FloatArray
    R: FloatArray


class ExtendedView(NamedTuple):
    """y = h(x) with an error v ~ N(0, R); jacobian(x, out) writes that of y's error with respect to x's (p, n)."""

    h: Observation
    jacobian: Observation
    R: FloatArray


class NumericView(NamedTuple):
    """An `ExtendedView`, its Jacobian by central differences."""

    h: Observation
    R: FloatArray


class UnscentedView(NamedTuple):
    """An `ExtendedView` without Jacobian."""

    h: Observation
    weighing: Weights
    R: FloatArray


def linear_corrector(H: ArrayLike, R: ArrayLike, *, observed: Space | None = None) -> Corrector:
    """y = H x + v. H (p, n), n the length of the state's error; R (p, p), positive definite.

    observed: what a measurement stands for, where it holds angles, which come round; plain quantities if not given.
    Raises ValueError for a measured attitude, which is no linear function of the state.
    Of this and the other correctors: what is wrong with one is found when the filter is composed, which names the
    sensor.
    """
    noise, seen = _noise_and_space(R, observed)
    if seen.attitudes.size:
        raise ValueError("observed has attitudes, which no H x can be: give extended_corrector or unscented_corrector")
    matrix = as_numbers("H", H)

    def view(n: int) -> LinearView:
        return LinearView(as_matrix("H", matrix, (len(noise), n)), noise)

    return Corrector("linear", expect_linear, observe_linear, view, seen, noise)


def extended_corrector(
    h: Observation, R: ArrayLike, jacobian: Observation | None = None, *, observed: Space | None = None
) -> Corrector:
    """Any observation, linearised at the estimate.

    h(x, out) writes the measurement expected at the state x into out; R (p, p), positive definite.
    jacobian(x, out) writes into out (p, n) what an error of x does to it; by central differences if not given.
    observed: what a measurement stands for, where it holds angles or attitudes; plain quantities if not given.
    The functions are plain Python that numba can compile.
    """
    noise, seen = _noise_and_space(R, observed)
    if jacobian is None:
        return Corrector("extended", expect_numeric, observe_numeric, lambda _n: NumericView(h, noise), seen, noise)
    derivative = jacobian
    return Corrector(
        "extended", expect_extended, observe_extended, lambda _n: ExtendedView(h, derivative, noise), seen, noise
    )


def unscented_corrector(
    h: Observation, R: ArrayLike, points: SigmaPoints = USUAL, *, observed: Space | None = None
) -> Corrector:
    """Any observation, of 2 n + 1 sigma points. h, R, observed as in `extended_corrector`."""
    noise, seen = _noise_and_space(R, observed)
    return Corrector(
        "unscented", expect_unscented, None, lambda n: UnscentedView(h, weights(points, n), noise), seen, noise
    )


def check_noise(corrector: Corrector) -> None:
    """Raises ValueError unless R is the positive definite covariance of an error of what is observed."""
    p = corrector.observed.errors
    if np.shape(corrector.R) != (p, p):
        raise ValueError(
            f"R has shape {np.shape(corrector.R)}; needed is {(p, p)}, for an error of a measurement has {p} numbers "
            f"(that of an attitude has 3)"
        )
    as_noise("R", corrector.R)


def observe_linear(view: LinearView, _observed: Space, space: Space, x: FloatArray, work: Workspace) -> None:
    """H x, and H."""
    plain(space, x, work.n1)
    matvec(view.H, work.n1, work.expected)
    copy(view.H, work.H)


def observe_extended(view: ExtendedView, _observed: Space, _of: Space, x: FloatArray, work: Workspace) -> None:
    """h(x), and H its Jacobian at x."""
    view.h(x, work.expected)
    view.jacobian(x, work.H)


def observe_numeric(view: NumericView, observed: Space, space: Space, x: FloatArray, work: Workspace) -> None:
    """`observe_extended` with H by central differences of h; work has the variances of x."""
    view.h(x, work.expected)
    for i in range(space.errors):
        step = difference(space, x, i, work)
        view.h(work.points[0], work.seen[0])
        view.h(work.points[1], work.seen[1])
        minus(observed, work.seen[0], work.seen[1], work.z)
        scale = 0.5 / step
        for r in range(observed.errors):
            work.H[r, i] = scale * work.z[r]


def _expectation_by(observe: Callable[..., None]) -> Callable[..., None]:
    """`expect` of a linear or extended corrector: also S = H P H^T + R and H P."""

    def expect(view: Any, observed: Space, space: Space, before: Estimate, work: Workspace) -> None:
        copy_diagonal(before.P, work.variances)
        observe(view, observed, space, before.x, work)
        project(view.R, before.P, work)

    return expect


expect_linear = _expectation_by(observe_linear)
expect_extended = _expectation_by(observe_extended)
expect_numeric = _expectation_by(observe_numeric)


def expect_unscented(view: UnscentedView, observed: Space, space: Space, before: Estimate, work: Workspace) -> None:
    """Mean, covariance and cross-covariance of the sigma points, each observed by h; R is added."""
    draw(space, before.x, before.P, view.weighing.spread, work.nn1, work.errors, work.points)
    for i in range(len(work.points)):
        view.h(work.points[i], work.seen[i])
    mean(observed, work.seen, view.weighing, work.seen_errors, work.z, work.expected)
    copy(view.R, work.S)
    add_covariance(work.seen_errors, work.seen_errors, view.weighing, work.S)
    clear(work.cross)
    add_covariance(work.seen_errors, work.errors, view.weighing, work.cross)


def estimate_error(observed: Space, space: Space, y: FloatArray, lost: Flags, work: Workspace) -> None:
    """K^T = S^-1 cross in gain, and the error K z that the measurement y (numbers,) tells in n1, once `expect` has run.

    lost (p,): what its error has no number of. y and lost may be longer: what is behind is not read.
    """
    minus(observed, y, work.expected, work.z)
    for r in range(observed.errors):
        if lost[r]:
            leave_out(r, work)
    cholesky(work.S, work.pp1)
    solve_cholesky(work.pp1, work.cross, work.gain)
    for e in range(space.errors):
        total = work.gain[0, e] * work.z[0]
        for r in range(1, observed.errors):
            total += work.gain[r, e] * work.z[r]
        work.n1[e] = total


def leave_out(r: int, work: Workspace) -> None:
    """Row r of a measurement says nothing: the others are corrected with as if it were not there."""
    for column in range(work.S.shape[0]):
        work.S[r, column] = work.S[column, r] = 0.0
    work.S[r, r] = 1.0
    for e in range(work.cross.shape[1]):
        work.cross[r, e] = work.H[r, e] = 0.0
    for i in range(work.seen_errors.shape[0]):
        work.seen_errors[i, r] = 0.0
    work.z[r] = 0.0


def project(R: FloatArray, P: FloatArray, work: Workspace) -> None:
    """S = H P H^T + R and cross = H P with the H in work."""
    matmul_blocked(work.H, P, work.cross)
    for i in range(R.shape[0]):
        for j in range(R.shape[0]):
            total = R[i, j]
            for e in range(P.shape[0]):
                total += work.cross[i, e] * work.H[j, e]
            work.S[i, j] = total


def _noise_and_space(R: ArrayLike, observed: Space | None) -> tuple[FloatArray, Space]:
    noise = np.atleast_1d(as_numbers("R", R))
    return noise, space(max(len(noise), 1)) if observed is None else as_space("observed", observed)
