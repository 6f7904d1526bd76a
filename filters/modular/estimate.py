"""Estimates are made, copied, and looked at."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.definite import is_semidefinite
from filters.kernels.dense import copy, copy_vector
from filters.modular.space import Space, is_point
from filters.records import Estimate


def empty(space: Space) -> Estimate:
    """Memory for an estimate of this space."""
    return Estimate(np.empty(space.numbers), np.empty((space.errors, space.errors)))


def copy_estimate(source: Estimate, out: Estimate) -> None:
    """out = source."""
    copy_vector(source.x, out.x)
    copy(source.P, out.P)


def is_sound(space: Space, estimate: Estimate, scratch: FloatArray) -> bool:
    """Whether x is a point of this space and P (n, n) is a covariance, see `is_semidefinite`; scratch is (n, n)."""
    return is_point(space, estimate.x) and is_semidefinite(estimate.P, scratch)
