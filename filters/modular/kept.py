"""What is kept of a covariance between the parts of a filter: itself, or its factors U and D."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.dense import copy
from filters.kernels.u_d import u_d_factors, u_d_product
from filters.modular.composition import ModularFilter
from filters.modular.estimate import is_sound
from filters.modular.space import Space
from filters.modular.u_d import are_sound
from filters.records import Estimate


class Kept(NamedTuple):
    """keep(P, out) writes what is kept of P (n, n), as an array (n, n); covariance(kept, out): P again.

    is_sound(space, estimate, scratch): whether an estimate with what is kept in place of its P is one.
    """

    keep: Callable[[FloatArray, FloatArray], None]
    covariance: Callable[[FloatArray, FloatArray], None]
    is_sound: Callable[[Space, Estimate, FloatArray], bool]


_AS_IT_IS, _FACTORS = Kept(copy, copy, is_sound), Kept(u_d_factors, u_d_product, are_sound)


def kept_by(composed: ModularFilter) -> Kept:
    """What this filter keeps."""
    return _FACTORS if composed.update == "u-d" else _AS_IT_IS


def keep(composed: ModularFilter, estimate: Estimate) -> Estimate:
    """The estimate as the filter keeps it."""
    kept = np.zeros_like(estimate.P)
    kept_by(composed).keep(estimate.P, kept)
    return Estimate(estimate.x, kept)


def restore(covariance: Callable[..., None], kept: FloatArray, scratch: FloatArray) -> None:
    """In place of what was kept (any, n, n), the covariances; scratch is (n, n)."""
    for i in range(kept.shape[0]):
        copy(kept[i], scratch)
        covariance(scratch, kept[i])


def with_covariance(composed: ModularFilter, kept: Estimate) -> Estimate:
    """The estimate that is kept so."""
    P = np.empty_like(kept.P)
    kept_by(composed).covariance(kept.P, P)
    return Estimate(kept.x, P)
