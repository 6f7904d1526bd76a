"""What a modular filter leaves behind."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.measurements import Measurement
from filters.modular.space import Space


class Estimates(NamedTuple):
    """x (steps + 1, numbers); P (steps + 1, n, n): the covariance of its error, of length n."""

    x: FloatArray
    P: FloatArray


class ModularHistory(Estimates):
    """The estimate at the end of every step, with what had been used by then: x, P, as which it unpacks.

    dropped: measurements that came too late to be used, in the order in which they came.
    """

    dropped: tuple[Measurement, ...] = ()

    def __new__(cls, x: FloatArray, P: FloatArray, dropped: tuple[Measurement, ...] = ()) -> ModularHistory:
        history = super().__new__(cls, x, P)
        history.dropped = dropped
        return history


def new_estimates(space: Space, steps: int) -> Estimates:
    """Memory for steps 0 to `steps`."""
    return Estimates(np.empty((steps + 1, space.numbers)), np.empty((steps + 1, space.errors, space.errors)))
