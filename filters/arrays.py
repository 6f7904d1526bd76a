"""The array types of this package."""

from __future__ import annotations

import sys
import warnings
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]


def as_floats(value: Any) -> FloatArray:
    """A contiguous copy. Raises TypeError, ValueError or OverflowError for what is no array of real numbers."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", np.exceptions.ComplexWarning)
        try:
            return np.array(value, dtype=np.float64, order="C")
        except np.exceptions.ComplexWarning:
            raise TypeError("it is complex") from None


def check_unmasked(name: str, value: Any) -> None:
    """Raises ValueError, naming it, where a number of an array, or of a list of them, is masked: as an array of floats
    it would be what it is under the mask."""
    if "numpy.ma" not in sys.modules:  # which takes long to import, and nothing is masked without it
        return
    if isinstance(value, list | tuple):
        for at, item in enumerate(value):
            if isinstance(item, np.ma.MaskedArray):
                check_unmasked(f"{name}[{at}]", item)
    if np.ma.is_masked(value):
        where = ", ".join(map(str, np.argwhere(np.ma.getmaskarray(value))[0]))
        raise ValueError(f"{name} is masked at [{where}]; give a number there")


def without_mask(values: Any) -> Any:
    """None in place of each masked number, in an array or in a list of numbers; what else there is stays as it is."""
    if isinstance(values, np.ma.MaskedArray):
        return values.tolist()
    return [without_mask(value) for value in values] if isinstance(values, list | tuple) else values


def as_array(name: str, value: ArrayLike) -> FloatArray:
    """A contiguous copy. Raises ValueError, naming it, unless it is an array of real numbers, none of them masked."""
    check_unmasked(name, value)
    try:
        return as_floats(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{name} is no array of numbers: {error}") from error
