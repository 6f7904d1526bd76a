"""The scratch of a model: memory in its parameters that its functions write to."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.system import System


@contextmanager
def restored(system: System) -> Iterator[None]:
    """Afterwards the numbers in its scratch are what they were, whatever its functions wrote within."""
    arrays = [*_arrays(getattr(system.parameters, "scratch", None))]
    kept = [array.copy() for array in arrays]
    try:
        yield
    finally:
        for array, numbers in zip(arrays, kept, strict=True):
            array[...] = numbers


def _arrays(value: Any) -> Iterator[FloatArray]:
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple):
        for item in value:
            yield from _arrays(item)
