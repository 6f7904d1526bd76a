"""A system whose matrices are looked at each time: an entry that is not what the structure says ends the run.

A filter without the products would go on with wrong numbers. Only runs look: the jobs that are measured are given the
system itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.sparse.structure import ANY, Pattern, Structure
from filters.system import System


class Fixed(NamedTuple):
    """Where an entry of a matrix is always the same, and what it is there."""

    where: NDArray[np.bool_]
    value: FloatArray


class CheckedParameters(NamedTuple):
    """The system as it was given, and what of its matrices is fixed."""

    system: System
    F: Fixed
    H: Fixed
    Q: Fixed
    R: Fixed


def checked(system: System, structure: Structure) -> System:
    """The system; where F, Q, H or R are not of this structure, it raises what `unstructured` explains."""
    parameters = CheckedParameters(system, *(fixed(pattern) for pattern in structure))
    return System(*system[:3], _f, _F, _Q, _h, _H, _R, parameters)


def fixed(pattern: Pattern) -> Fixed:
    """The entries of a pattern that are always zero or one."""
    return Fixed(
        np.array([[entry != ANY for entry in row] for row in pattern]),
        np.array([[0.0 if entry == ANY else float(entry) for entry in row] for row in pattern]),
    )


@contextmanager
def unstructured() -> Iterator[None]:
    """Raises ValueError, naming function, step and entry, where a `checked` system has found another number."""
    try:
        yield
    except ArithmeticError as error:
        match error.args:
            case (str(), str(signature), step, row, column, found, stated):
                raise ValueError(
                    f"step {step}: {signature} has {found} at [{row}, {column}], where the structure of the system "
                    f"says {stated:.0f}; write * there"
                ) from None
        raise


def _f(j: int, x: FloatArray, u: FloatArray, checked: CheckedParameters, out: FloatArray) -> None:
    checked.system.f(j, x, u, checked.system.parameters, out)


def _F(j: int, x: FloatArray, u: FloatArray, checked: CheckedParameters) -> FloatArray:
    matrix = checked.system.F(j, x, u, checked.system.parameters)
    _check_stated(checked.F, matrix, "F(j, x, u, p)", j)
    return matrix


def _Q(j: int, checked: CheckedParameters) -> FloatArray:
    matrix = checked.system.Q(j, checked.system.parameters)
    _check_stated(checked.Q, matrix, "Q(j, p)", j)
    return matrix


def _h(k: int, x: FloatArray, checked: CheckedParameters, out: FloatArray) -> None:
    checked.system.h(k, x, checked.system.parameters, out)


def _H(k: int, x: FloatArray, checked: CheckedParameters) -> FloatArray:
    matrix = checked.system.H(k, x, checked.system.parameters)
    _check_stated(checked.H, matrix, "H(k, x, p)", k)
    return matrix


def _R(k: int, checked: CheckedParameters) -> FloatArray:
    matrix = checked.system.R(k, checked.system.parameters)
    _check_stated(checked.R, matrix, "R(k, p)", k)
    return matrix


def _check_stated(stated: Fixed, matrix: FloatArray, signature: str, step: int) -> None:
    """A function of its own, for as C one that fails still returns, and a matrix is read behind it."""
    for i in range(matrix.shape[0]):
        for j in range(matrix.shape[1]):
            if stated.where[i, j] and matrix[i, j] != stated.value[i, j]:
                raise ArithmeticError(
                    "a matrix is not of the structure that the system states; backend='reference' names the entry",
                    signature,
                    step,
                    i,
                    j,
                    matrix[i, j],
                    stated.value[i, j],
                )
