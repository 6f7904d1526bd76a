"""Checks of what is given to a filter run."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.systems.system import System


def check_problem(
    system: System,
    N: int,
    M: int,
    L: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: FloatArray,
) -> None:
    """Raises ValueError, naming the argument, unless 0 <= M <= L <= N, N >= 1, and all shapes fit the system."""
    if N < 1:
        raise ValueError(f"N={N} must be at least 1: it is the number of steps between measurements")
    if not 0 <= M <= L <= N:
        raise ValueError(f"M={M}, L={L}, N={N} must satisfy 0 <= M <= L <= N")
    n, m, p = system.states, system.inputs, system.measurements
    _check_shape("x0", x0, (n,))
    _check_shape("P0", P0, (n, n))
    _check_shape("inputs", inputs, (len(inputs), m))
    _check_shape("measurements", measurements, (len(measurements), p))


def _check_shape(name: str, array: FloatArray, needed: tuple[int, ...]) -> None:
    if np.shape(array) != needed:
        raise ValueError(f"{name} has shape {np.shape(array)}, the system needs {needed}")


def check_choice(name: str, value: str, choices: tuple[str, ...]) -> None:
    """Raises ValueError unless the value is one of the choices."""
    if value not in choices:
        raise ValueError(f"{name}={value!r} is unknown; give one of {', '.join(choices)}")
