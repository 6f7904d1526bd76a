"""Linearised parts on factors: P = U D U^T is never formed, so that half as many digits do for the same accuracy.

An estimate's P (n, n) holds U and D as in `filters.kernels.u_d`: Thornton's time update, and Bierman's measurement
update by one decorrelated number after the other. G. J. Bierman, Factorization Methods for Discrete Sequential
Estimation, 1977.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from filters.arrays import Flags, FloatArray
from filters.kernels.dense import copy
from filters.kernels.sequential import solve_unit_lower, unit_lower_factors
from filters.kernels.u_d import append_unit_product, bierman_update, gram_schmidt, u_d_factors
from filters.modular.correctors import leave_out
from filters.modular.space import Space, is_point, minus, plus
from filters.modular.workspace import Workspace
from filters.records import Estimate


@cache
def u_d_prediction_by(evolve: Callable[..., None], by_differences: bool) -> Callable[..., None]:
    """The job of a predictor. Same arguments in, same function out, so that it is compiled once."""

    def predict(
        motion: Any, space: Space, before: Estimate, u: FloatArray, dt: float, after: Estimate, work: Workspace
    ) -> None:
        if by_differences:
            _variances(before.P, work.variances)
        evolve(motion, space, before.x, u, dt, after.x, work)
        u_d_factors(motion.Q, work.V)
        append_unit_product(work.F, before.P, work.V, work.weights)
        gram_schmidt(work.V, work.weights, after.P, work.weighted)

    return predict


@cache
def u_d_correction_by(observe: Callable[..., None], by_differences: bool) -> Callable[..., None]:
    """The job of a corrector. Same arguments in, same function out, so that it is compiled once."""

    def correct(
        view: Any,
        observed: Space,
        space: Space,
        before: Estimate,
        y: FloatArray,
        lost: Flags,
        after: Estimate,
        work: Workspace,
    ) -> None:
        if by_differences:
            _variances(before.P, work.variances)
        observe(view, observed, space, before.x, work)
        minus(observed, y, work.expected, work.z)
        copy(view.R, work.S)
        for r in range(observed.errors):
            if lost[r]:
                leave_out(r, work)
        copy(before.P, after.P)
        _one_by_one(after.P, work)
        plus(space, before.x, work.n1, after.x)

    return correct


def _one_by_one(factors: FloatArray, work: Workspace) -> None:
    """The factors after a measurement whose error has covariance S, and in n1 the error that it tells."""
    p, n = work.H.shape
    unit_lower_factors(work.S, work.pp1, work.noises)
    solve_unit_lower(work.pp1, work.H, work.cross)
    for e in range(n):
        work.n1[e] = 0.0
    for r in range(p):
        for k in range(r):
            work.z[r] -= work.pp1[r, k] * work.z[k]
        bierman_update(factors, work.cross, work.noises, r, work.gain)
        innovation = work.z[r]
        for e in range(n):
            innovation -= work.cross[r, e] * work.n1[e]
        for e in range(n):
            work.n1[e] += work.gain[r, e] * innovation


def _variances(factors: FloatArray, out: FloatArray) -> None:
    """out (n,) = the diagonal of U D U^T."""
    n = factors.shape[0]
    for i in range(n):
        out[i] = factors[i, i]
        for j in range(i + 1, n):
            out[i] += factors[i, j] * factors[i, j] * factors[j, j]


def are_sound(space: Space, estimate: Estimate, _scratch: FloatArray) -> bool:
    """Whether x is a point of this space and P holds factors of a covariance."""
    n = estimate.P.shape[0]
    for i in range(n):
        variance = estimate.P[i, i]
        if not variance >= 0.0:
            return False
        for j in range(i + 1, n):
            variance += estimate.P[i, j] * estimate.P[i, j] * estimate.P[j, j]
        if not variance < np.inf:
            return False
    return is_point(space, estimate.x)
