"""Checks of the matrices that parts of a modular filter are made of."""

from __future__ import annotations

from types import FunctionType

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray, as_floats, check_unmasked
from filters.covariances import check_covariance
from filters.kernels.definite import is_semidefinite
from filters.modular.space import Space
from filters.robust.check import check_positive_definite


def as_numbers(name: str, value: ArrayLike) -> FloatArray:
    """A contiguous copy. Raises ValueError, naming it, unless it is an array of real numbers, finite or not."""
    check_unmasked(name, value)
    try:
        return as_floats(value)
    except (TypeError, ValueError, OverflowError) as error:
        shown = " ".join(repr(value).split())
        raise ValueError(f"{name} is {shown:.60}; needed is an array of real numbers ({error})") from None


def as_matrix(name: str, value: ArrayLike, shape: tuple[int | None, int | None]) -> FloatArray:
    """A contiguous copy. Raises ValueError, naming it, unless it is a finite matrix of this shape; None: any length."""
    matrix = as_numbers(name, value)
    fits = matrix.ndim == 2 and all(want in (None, have) for want, have in zip(shape, matrix.shape, strict=True))
    if not fits:
        needed = ", ".join("any" if length is None else str(length) for length in shape)
        raise ValueError(f"{name} has shape {matrix.shape}; needed is ({needed})")
    if not np.isfinite(matrix).all():
        raise ValueError(f"{name} holds a value that is not finite")
    return matrix


def as_covariance(name: str, value: ArrayLike) -> FloatArray:
    """A square matrix, not empty. Raises ValueError unless it is symmetric and positive semidefinite."""
    matrix = as_numbers(name, value)
    if matrix.ndim != 2:
        raise ValueError(f"{name} has shape {matrix.shape}; needed is a covariance (n, n), n the number of errors")
    size = len(matrix)
    matrix = as_matrix(name, matrix, (size, size))
    if size == 0:
        raise ValueError(f"{name} is empty; it gives the number of errors")
    check_covariance(name, matrix)
    return matrix


def as_noise(name: str, value: ArrayLike) -> FloatArray:
    """The covariance of a measurement's error. Raises ValueError unless it is positive definite."""
    matrix = as_covariance(name, value)
    check_positive_definite(name, matrix, "give each measurement noise of its own, a positive variance")
    return matrix


def check_functions(part: str, model: object, arguments: str) -> None:
    """Raises ValueError, naming the part, unless the functions of its model are plain ones."""
    for name in ("f", "h", "jacobian"):
        function = getattr(model, name, None)
        if hasattr(model, name) and not isinstance(function, FunctionType):
            raise ValueError(
                f"{part}: {name}({arguments}) is a {type(function).__name__}; give a plain function, made by def or "
                f"lambda"
            )


def check_start(space: Space, x0: ArrayLike, P0: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Copies of the estimate and covariance to start from; the covariance is symmetric to the last digit.

    Raises:
        ValueError: a shape does not fit the space, x0 is not finite, an attitude in it has no length, or P0 is no
            covariance. It may be singular: of states that are known exactly, or go together.
    """
    x = as_numbers("x0", x0)
    if x.shape != (space.numbers,) or not np.isfinite(x).all():
        raise ValueError(f"x0 has shape {x.shape}, the filter needs {(space.numbers,)}, and finite numbers")
    for start in space.attitudes:
        length = np.linalg.norm(x[start : start + 4])
        if not np.isclose(length, 1.0, rtol=0, atol=1e-6):
            remedy = "divide by it" if 0 < length < np.inf else "give a unit quaternion, 1, 0, 0, 0 if it turns nothing"
            raise ValueError(f"x0: the attitude at {start} has length {length:.6g}; {remedy}")
    P = as_matrix("P0", P0, (space.errors, space.errors))
    check_covariance("P0", P)
    P = 0.5 * (P + P.T)
    if not is_semidefinite(P, np.empty_like(P)):
        raise ValueError(
            f"P0 is no covariance: beside variances of {np.diag(P).min():.3g} to {np.diag(P).max():.3g} a state, or a "
            f"combination of them, has a negative one; give each a variance of its own, zero if it is known exactly"
        )
    return x, P
