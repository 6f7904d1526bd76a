"""Checks of what is given to a run of a modular filter."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter
from filters.modular.predictors import Predictor


def check_inputs(predictor: Predictor, inputs: ArrayLike) -> FloatArray:
    """The inputs (steps, any) as a contiguous array.

    Raises:
        ValueError: they are no matrix, or not finite, or not as many in a step as a linear predictor's B has columns.
    """
    rows = np.ascontiguousarray(inputs, dtype=np.float64)
    if rows.ndim != 2:
        raise ValueError(f"inputs has shape {rows.shape}; needed is (steps, inputs of the predictor)")
    if not np.isfinite(rows).all():
        raise ValueError("inputs holds a value that is not finite")
    columns = predictor.motion.B.shape[1] if predictor.kind == "linear" else 0
    if columns not in (0, rows.shape[1]):
        raise ValueError(f"inputs has shape {rows.shape}, the predictor's B needs (steps, {columns})")
    return rows


def check_linearised(composed: ModularFilter, late: str) -> None:
    """Raises ValueError, naming the part, if one is unscented: `late`, the way to use late measurements, needs F, H."""
    parts = [("predictor", composed.predictor.kind)]
    parts += [(f"sensor {sensor.name!r}", sensor.corrector.kind) for sensor in composed.sensors]
    for part, kind in parts:
        if kind == "unscented":
            raise ValueError(
                f"{part}: late={late!r} needs the matrices of linear and extended parts, and this one is unscented; "
                f"use late='recalculate', which works with all, or make it extended"
            )
