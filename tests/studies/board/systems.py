"""Systems of which something is special in C."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system


class Scratch(NamedTuple):
    F: FloatArray
    H: FloatArray


class Parameters(NamedTuple):
    """spring: a number that is given to C as data."""

    spring: float
    Q: FloatArray
    R: FloatArray
    scratch: Scratch


def pendulum() -> System:
    """Without sines, so that its bits are those of any C library: F and H fill scratch memory."""
    scratch = Scratch(np.zeros((2, 2, 2)), np.zeros((1, 2)))
    return System(2, 1, 1, _f, _F, _Q, _h, _H, _R, Parameters(0.4, np.diag([1e-4, 1e-3]), np.array([[0.01]]), scratch))


def _f(_j: int, x: FloatArray, u: FloatArray, p: Any, out: FloatArray) -> None:
    out[0] = x[0] + 0.1 * x[1]
    out[1] = x[1] + 0.1 * (u[0] - p.spring * x[0] * (1.0 - x[0] * x[0] / 6.0))


def _F(j: int, x: FloatArray, _u: FloatArray, p: Any) -> FloatArray:
    Phi: FloatArray = p.scratch.F[j % 2]
    Phi[0, 0] = Phi[1, 1] = 1.0
    Phi[0, 1] = 0.1
    Phi[1, 0] = -0.1 * p.spring * (1.0 - 0.5 * x[0] * x[0])
    return Phi


def _Q(_j: int, p: Any) -> FloatArray:
    return p.Q  # type: ignore[no-any-return]


def _h(_k: int, x: FloatArray, _p: Any, out: FloatArray) -> None:
    out[0] = x[0] + 0.1 * x[0] ** 2


def _H(_k: int, x: FloatArray, p: Any) -> FloatArray:
    H: FloatArray = p.scratch.H
    H[0, 0] = 1.0 + 0.2 * x[0]
    H[0, 1] = 0.0
    return H


def _R(_k: int, p: Any) -> FloatArray:
    return p.R  # type: ignore[no-any-return]


def unchanging() -> System:
    """A linear system whose Phi and Q do not change, so that its model over several steps is known."""
    changing = example_system(3, 1, 2).parameters
    return linear_system(changing.Phi[0], changing.B, changing.H, changing.Q[0], changing.R)


def writing_to_its_parameters() -> System:
    """F fills a matrix of its parameters that is no scratch."""
    return pendulum()._replace(F=_F_in_Q)


def _F_in_Q(_j: int, x: FloatArray, _u: FloatArray, p: Any) -> FloatArray:
    p.Q[0, 0] = 1e-4 + x[0] * x[0]
    return np.array([[1.0, 0.1], [-0.1 * p.spring, 1.0]])


def beyond_floats() -> System:
    """A noise that single precision has no number for."""
    system = pendulum()
    return system._replace(parameters=system.parameters._replace(R=np.array([[1e-60]])))
