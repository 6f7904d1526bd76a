"""Estimates are made, copied, and looked at."""

from __future__ import annotations

import numpy as np

from filters.kernels.dense import copy, copy_vector
from filters.modular.space import Space
from filters.records import Estimate


def empty(of: Space) -> Estimate:
    """Memory for an estimate of this space."""
    return Estimate(np.empty(of.numbers), np.empty((of.errors, of.errors)))


def copy_estimate(source: Estimate, out: Estimate) -> None:
    """out = source."""
    copy_vector(source.x, out.x)
    copy(source.P, out.P)


def is_sound(estimate: Estimate) -> bool:
    """Whether all numbers of x are finite and no variance is negative or nan."""
    for value in estimate.x:
        if not np.isfinite(value):
            return False
    for i in range(estimate.P.shape[0]):
        variance = estimate.P[i, i]
        if variance < 0.0 or np.isnan(variance):
            return False
    return True
