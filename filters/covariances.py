"""Whether a matrix that is given is a covariance."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray


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


def check_noise(name: str, noise: FloatArray, step: int) -> None:
    """Raises ValueError unless the Q or R that a system gives in this step is a covariance."""
    _check_noise_is_finite(name, noise, step)
    check_covariance(f"step {step}: {name} of the system", noise)


def check_measurement_noise(R: FloatArray, k: int | None, name: str = "R") -> None:
    """Raises ValueError, with this name, unless R (p, p) is finite, symmetric and positive definite beyond rounding.

    k: the step that it is of; None of a constant one.
    """
    if k is not None:
        _check_noise_is_finite(name, R, k)
    elif not np.isfinite(R).all():
        raise ValueError(f"{name} holds a value that is not finite; give numbers")
    said = name if k is None else f"{name} of step {k}"
    if not np.allclose(R, R.T, rtol=1e-9, atol=0.0):
        raise ValueError(f"{said} is not symmetric; it is the covariance of the measurement noise")
    eigenvalues = np.linalg.eigvalsh(R)
    if not eigenvalues[0] > len(R) * np.finfo(np.float64).eps * abs(eigenvalues[-1]):
        raise ValueError(
            f"{said} is not positive definite: its smallest eigenvalue is {eigenvalues[0]:.3g}; give each measurement "
            f"noise of its own (a positive variance), or leave out those that follow from the others"
        )


def _check_noise_is_finite(name: str, noise: FloatArray, step: int) -> None:
    if not np.isfinite(noise).all():
        lost = ", and None in place of a measurement, or of a number of one, that says nothing" if name == "R" else ""
        raise ValueError(f"step {step}: {name} of the system gives a value that is not finite; give numbers{lost}")
