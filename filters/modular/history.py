"""What a modular filter leaves behind."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.space import Space


class ModularHistory(NamedTuple):
    """The estimate at the end of every step, with what had been used by then.

    x (steps + 1, numbers); P (steps + 1, n, n): the covariance of its error, of length n.
    """

    x: FloatArray
    P: FloatArray


def new_history(of: Space, steps: int) -> ModularHistory:
    """Memory for steps 0 to `steps`."""
    return ModularHistory(np.empty((steps + 1, of.numbers)), np.empty((steps + 1, of.errors, of.errors)))
