"""The accuracy of a constant model's output by its age after each measurement of a repetition; of one if all intervals
are the same."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from filters.accuracy.model import LinearModel
from filters.accuracy.pattern import Interval, repeats_soon, taken
from filters.accuracy.periodic import by_age, mean, noise_by_age, not_found, or_infinite, steady, worst
from filters.accuracy.prefix import Prefix, prefix
from filters.accuracy.repeating import repeating_priors
from filters.accuracy.riccati import noise_scale, posterior
from filters.accuracy.unseen import check_seen
from filters.accuracy.visible import visible
from filters.arrays import FloatArray

MOST_RAISED = 1_000
"""So often a bound is raised until it holds."""


class Regime(NamedTuple):
    """q cycles, each from a measurement to the next.

    intervals (q,): their steps. before (q, n, n): P^- of the measurement. variances (q, ages): tr V(a) after it; jumps
    (q, ages): as in `periodic.Steady`. bound: whether these are of two cycles, the shorter and the longer, and no cycle
    of their kind is worse, in any order.
    """

    intervals: NDArray[np.int64]
    before: FloatArray
    variances: FloatArray
    jumps: FloatArray
    bound: bool = False


def regime(model: LinearModel, outputs: FloatArray, N: Interval, oldest: int) -> Regime:
    """outputs (o, n): C; oldest: the greatest age. Raises ValueError as `periodic.steady` does."""
    if isinstance(N, int):
        one = steady(model, outputs, [N], oldest)
        return Regime(one.N, one.before, one.variances, one.jumps)
    reduced, C = visible(model, outputs)
    check_seen(model, outputs, N)
    longest = ceil(N)
    with np.errstate(over="ignore", invalid="ignore"):
        over = prefix(reduced, max(longest, oldest))
        soon = repeats_soon(N)
        intervals = np.diff(taken(N)) if soon else np.array([floor(N), longest])
        if soon:
            before = repeating_priors(over.Phi[intervals], over.Q[intervals], reduced.H, reduced.R)
        else:
            before = np.stack([_never_above(reduced, over, intervals)] * 2)
        if not np.isfinite(before).all():
            raise ValueError(not_found(N, over.Phi[longest]) if soon else _no_bound(N))
        _, after = posterior(before, reduced.H, reduced.R)
        moved = before - after if soon else before
        return Regime(
            intervals,
            before,
            or_infinite(by_age(over, C, after, oldest) + noise_by_age(over, C, oldest)),
            or_infinite(by_age(over, C, moved, oldest)),
            bound=not soon,
        )


def worst_of(of: Regime, L: ArrayLike) -> FloatArray:
    """The greatest variance of all steps, for each L."""
    each = [worst(variances, int(n), L) for variances, n in zip(of.variances, of.intervals, strict=True)]
    return np.asarray(np.max(each, axis=0))


def mean_of(of: Regime, L: ArrayLike) -> FloatArray:
    """The mean over all steps, for each L; of a bound the greater of those after a shorter and a longer interval."""
    each = np.array([mean(variances, int(n), L) for variances, n in zip(of.variances, of.intervals, strict=True)])
    if of.bound:
        return np.asarray(each.max(axis=0))
    return np.asarray(np.average(each, axis=0, weights=of.intervals))


def in_steps(of: Regime, L: int) -> FloatArray:
    """Variances (steps,) of all steps of a repetition, from the landing of its first measurement on."""
    return np.concatenate([each[L : L + n] for each, n in zip(of.variances, of.intervals, strict=True)])


def _no_bound(N: Interval) -> str:
    return (
        f"measurements every {float(N):.9g} steps repeat their pattern after {Fraction(N).denominator:,} of them, and "
        f"no bound was found that holds in any order of their intervals; take an interval that repeats sooner"
    )


def _never_above(model: LinearModel, over: Prefix, intervals: NDArray[np.int64]) -> FloatArray:
    """A P^- (n, n) that neither a cycle of the one interval nor of the other raises: whatever their order, what they
    settle to is not above it, for a greater P^- is never followed by a smaller. nan where none is found."""
    scale = noise_scale(over.Q[intervals])
    units = np.outer(scale, scale)

    def next_ones(P: FloatArray) -> FloatArray:
        Phi = over.Phi[intervals]
        after = posterior(P, model.H, model.R)[1]
        return np.asarray((Phi @ after @ np.swapaxes(Phi, -1, -2) + over.Q[intervals]) / units)

    bound = repeating_priors(over.Phi[intervals[-1:]], over.Q[intervals[-1:]], model.H, model.R)[0] / units
    for _ in range(MOST_RAISED):
        if not np.isfinite(bound).all():
            break
        raised = bound
        for P in next_ones(bound * units):
            values, vectors = np.linalg.eigh(P - raised)
            raised = raised + (vectors * values.clip(0.0)) @ vectors.T
        if np.trace(raised - bound) <= 1e-12 * np.trace(bound):
            return np.asarray(raised * units)
        bound = raised
    return np.full_like(bound, np.nan)
