"""The record of measurements that a filter is given, and what of it was lost."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray, as_floats, without_mask

Measurements: TypeAlias = FloatArray | Sequence[Any]
"""One row (p,) a measurement, as an array or a sequence; None in place of a row, or of a number, that was lost.

A masked array of NumPy's, of all rows or of one, says the same by its mask.
"""


class Measured(NamedTuple):
    """y (rows, p): the numbers, 0 where one was lost. present (rows, p): where none was."""

    y: FloatArray
    present: NDArray[np.bool_]


def measured(p: int, every: int, measurements: Measurements) -> Measured:
    """The record as arrays, p numbers a row; row c is of step c `every`.

    Raises:
        ValueError: measurements is no sequence of rows, a row has the wrong length, or a value is no finite number.
    """
    if isinstance(measurements, np.ndarray) and (measurements.ndim != 2 or measurements.shape[1] != p):
        count = len(measurements) if measurements.ndim else "any"
        raise ValueError(f"measurements has shape {measurements.shape}, the system needs ({count}, {p})")
    rows: Any = measurements.tolist() if isinstance(measurements, np.ma.MaskedArray) else measurements
    if not isinstance(rows, Iterable):
        raise ValueError(
            f"measurements is {rows!r:.60}; give a row for each, None in place of one that was lost, [] if there are "
            f"none"
        )
    if not isinstance(rows, np.ndarray):
        rows = np.array([_row(row, p, c * every) for c, row in enumerate(rows)], dtype=object).reshape(-1, p)
    present = np.not_equal(rows, None).astype(np.bool_)  # type: ignore[call-overload]  # entry by entry
    try:
        y = as_floats(np.where(present, rows, 0.0))
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"measurements holds a value that is no number: {error}") from error
    wrong = ~np.isfinite(y).all(axis=1)
    if wrong.any():
        c = int(wrong.argmax())
        raise ValueError(
            f"the measurement of step {c * every} is {y[c]}, which is not finite; give None in place of a measurement, "
            f"or of a number in it, that was lost"
        )
    return Measured(y, present)


def _row(row: Any, p: int, k: int) -> list[Any]:
    row = without_mask(row)
    if row is None:
        return [None] * p
    if np.shape(row) != (p,):
        raise ValueError(f"the measurement of step {k} has shape {np.shape(row)}, the system needs {(p,)}")
    return list(row)
