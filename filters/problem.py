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
    _check_start_and_inputs(system, x0, P0, inputs)
    _check_shape("measurements", measurements, (len(measurements), system.measurements))


def check_multirate_problem(
    system: System, n: int, L: int, x0: FloatArray, P0: FloatArray, inputs: FloatArray, measurements: FloatArray
) -> None:
    """Raises ValueError, naming the argument, unless 0 <= L <= n, n >= 1, and all shapes fit: a measurement a step."""
    if not isinstance(n, int | np.integer) or n < 1:
        raise ValueError(f"n={n!r} must be a whole number, at least 1: it is the number of steps between gains")
    if not isinstance(L, int | np.integer) or not 0 <= L <= n:
        raise ValueError(f"L={L}, n={n} must satisfy 0 <= L <= n: a gain is in use before the next one is computed")
    _check_start_and_inputs(system, x0, P0, inputs)
    _check_shape("measurements", measurements, (len(inputs) + 1, system.measurements))


def check_covariance(name: str, P: FloatArray) -> None:
    """Raises ValueError unless P (n, n) is finite, symmetric, and positive semidefinite, up to rounding."""
    if not np.isfinite(P).all():
        raise ValueError(f"{name} holds a value that is not finite")
    scale = np.abs(P).max(initial=0.0)
    if not np.allclose(P, np.transpose(P), rtol=0.0, atol=1e-9 * scale):
        raise ValueError(
            f"{name} is not symmetric, so it is no covariance; give half the sum of it and its transpose "
            f"if that is meant"
        )
    smallest = np.linalg.eigvalsh(P)[0]
    if smallest < -1e-9 * scale:
        raise ValueError(f"{name} is no covariance: its smallest eigenvalue is {smallest:.3g}, which is negative")


def check_measurement_noise(R: FloatArray, k: int) -> None:
    """Raises ValueError unless R (p, p) of step k is symmetric and positive definite beyond rounding."""
    if not np.allclose(R, R.T, rtol=1e-9, atol=0.0):
        raise ValueError(f"R of step {k} is not symmetric; it is the covariance of the measurement noise")
    eigenvalues = np.linalg.eigvalsh(R)
    if not eigenvalues[0] > len(R) * np.finfo(np.float64).eps * abs(eigenvalues[-1]):
        raise ValueError(
            f"R of step {k} is not positive definite: its smallest eigenvalue is {eigenvalues[0]:.3g}; give each "
            f"measurement noise of its own (a positive variance), or leave out those that follow from the others"
        )


def _check_start_and_inputs(system: System, x0: FloatArray, P0: FloatArray, inputs: FloatArray) -> None:
    n, m = system.states, system.inputs
    _check_shape("x0", x0, (n,))
    _check_shape("P0", P0, (n, n))
    check_covariance("P0", P0)
    _check_shape("inputs", inputs, (len(inputs), m))


def _check_shape(name: str, array: FloatArray, needed: tuple[int, ...]) -> None:
    if np.shape(array) != needed:
        raise ValueError(f"{name} has shape {np.shape(array)}, the system needs {needed}")


def check_choice(name: str, value: str, choices: tuple[str, ...]) -> None:
    """Raises ValueError unless the value is one of the choices."""
    if value not in choices:
        raise ValueError(f"{name}={value!r} is unknown; give one of {', '.join(choices)}")
