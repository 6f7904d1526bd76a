"""A system whose matrices are looked at each time: one of another size than in step 0 ends the run.

Neither compiled code nor loops over what there is would notice: they go on with a part of it, or with whatever lies
behind it. Only runs look: the jobs that are measured are given the system itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.system import System
from filters.systems.linear import is_linear


class ShapedParameters(NamedTuple):
    """The system as it was given."""

    system: System


def shaped(system: System) -> System:
    """The system, without its structure; where F, Q, H or R have another shape than they should, it raises what
    `misshapen` explains.

    One that `linear_system` made is known to have the right ones, and stays as it is.
    """
    system = system if system.structure is None else system._replace(structure=None)
    if is_linear(system):
        return system
    return System(*system[:3], _f, _F, _Q, _h, _H, _R, ShapedParameters(system))


@contextmanager
def misshapen() -> Iterator[None]:
    """Raises ValueError, naming function, step and shapes, where a `shaped` system has found another shape."""
    try:
        yield
    except LookupError as error:
        match error.args:
            case (str(signature), step, tuple(shape), tuple(needed)):
                raise ValueError(f"step {step}: {signature} has shape {shape}; needed is {needed}") from None
        raise


def _f(j: int, x: FloatArray, u: FloatArray, parameters: ShapedParameters, out: FloatArray) -> None:
    parameters.system.f(j, x, u, parameters.system.parameters, out)


def _F(j: int, x: FloatArray, u: FloatArray, parameters: ShapedParameters) -> FloatArray:
    n = parameters.system.states
    return _of_shape(n, n, parameters.system.F(j, x, u, parameters.system.parameters), "F(j, x, u, p)", j)


def _Q(j: int, parameters: ShapedParameters) -> FloatArray:
    n = parameters.system.states
    return _of_shape(n, n, parameters.system.Q(j, parameters.system.parameters), "Q(j, p)", j)


def _h(k: int, x: FloatArray, parameters: ShapedParameters, out: FloatArray) -> None:
    parameters.system.h(k, x, parameters.system.parameters, out)


def _H(k: int, x: FloatArray, parameters: ShapedParameters) -> FloatArray:
    n, p = parameters.system.states, parameters.system.measurements
    return _of_shape(p, n, parameters.system.H(k, x, parameters.system.parameters), "H(k, x, p)", k)


def _R(k: int, parameters: ShapedParameters) -> FloatArray:
    p = parameters.system.measurements
    return _of_shape(p, p, parameters.system.R(k, parameters.system.parameters), "R(k, p)", k)


def _of_shape(rows: int, columns: int, matrix: FloatArray, signature: str, step: int) -> FloatArray:
    if np.shape(matrix) != (rows, columns):
        raise LookupError(signature, step, np.shape(matrix), (rows, columns))
    return matrix
