"""Checks of what is given to a run of a modular filter."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray
from filters.modular.check import as_numbers, check_start
from filters.modular.composition import ModularFilter, check_composed, unscented_parts
from filters.modular.trial import try_functions
from filters.records import Estimate


def check_problem(
    composed: ModularFilter, x0: ArrayLike, P0: ArrayLike, inputs: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """x0, P0 and the inputs (steps, any) as arrays that the filter may write to or read row by row.

    The filter's functions are tried at the start.

    Raises:
        ValueError: as `check.check_start` and `trial.try_functions`; the inputs are no matrix, or not finite.
    """
    check_composed(composed)
    x, P = check_start(composed.of, x0, P0)
    rows = as_numbers("inputs", inputs)
    if rows.ndim != 2:
        raise ValueError(f"inputs has shape {rows.shape}; needed is (steps, inputs of the predictor)")
    wrong = ~np.isfinite(rows).all(axis=1)
    if wrong.any():
        raise ValueError(f"inputs holds a value that is not finite, in row {wrong.argmax()}; give each step its input")
    try_functions(composed, Estimate(x, P), rows[0] if len(rows) else None)
    return x, P, rows


def check_linearised(composed: ModularFilter, late: str) -> None:
    """Raises ValueError, naming the part, if one is unscented: `late`, the way to use late measurements, needs F, H.

    So does update='u-d', for `late` needs the covariance itself.
    """
    check_composed(composed)
    if composed.update == "u-d":
        raise ValueError(
            f"update='u-d' keeps factors of the covariance, and late={late!r} works on the covariance; use "
            f"late='recalculate', or update='joseph'"
        )
    for part in unscented_parts(composed):
        raise ValueError(
            f"{part}: late={late!r} needs the matrices of linear and extended parts, and this one is unscented; "
            f"use late='recalculate', which works with all, or make it extended"
        )
