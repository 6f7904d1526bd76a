"""What a modular filter leaves behind, or the error that says why it cannot."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter
from filters.modular.space import Space

SOUND, PREDICTOR = -1, -2
"""In place of a sensor's number, where a kernel says which part broke down."""


class ModularHistory(NamedTuple):
    """The estimate at the end of every step, with what had been used by then.

    x (steps + 1, numbers); P (steps + 1, n, n): the covariance of its error, of length n.
    """

    x: FloatArray
    P: FloatArray


def new_history(of: Space, steps: int) -> ModularHistory:
    """Memory for steps 0 to `steps`."""
    return ModularHistory(np.empty((steps + 1, of.numbers)), np.empty((steps + 1, of.errors, of.errors)))


def breakdown(composed: ModularFilter, culprit: int, step: int) -> ValueError:
    """The error that says which part of a filter left an estimate that is none."""
    part = "predictor" if culprit == PREDICTOR else f"sensor {composed.sensors[culprit].name!r}"
    return ValueError(
        f"{part}, step {step}: the covariance is no longer positive definite, or a value is no longer finite; give "
        f"more noise (Q, R) or a smaller P0, or spread sigma points with alpha = 1, which leaves no weight negative"
    )
