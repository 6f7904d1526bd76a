"""The model that every filter takes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from filters.arrays import FloatArray
from filters.sparse.structure import Structure

Parameters: TypeAlias = Any  # of one system: a named tuple of arrays and floats


class System(NamedTuple):
    """A discrete system x_{j+1} = f(x_j, u_j) + w_j, y_k = h(x_k) + nu_k, w_j ~ N(0, Q_j), nu_k ~ N(0, R_k).

    Linear as in Eqs. (1) and (2), or nonlinear: then Phi and H are the Jacobians along the estimated trajectory and
    the filters are the extended ones.

    states, inputs, measurements: n, m, p, the lengths of x, u and y.
    f(j, x, u, parameters, out): writes x_{j+1} into out (n,), from x (n,) and u (m,). out is not x.
    F(j, x, u, parameters): Phi_j = df/dx (n, n).
    Q(j, parameters): covariance of w_j (n, n).
    h(k, x, parameters, out): writes the measurement expected at x into out (p,).
    H(k, x, parameters): dh/dx (p, n).
    R(k, parameters): covariance of nu_k (p, p).
    parameters: passed to all of them; a named tuple of arrays and floats. No function changes them, nor x or u; what it
        needs memory for may be a field named scratch, whose content means nothing to the next call.
    structure: which entries of F, H, Q and R are zero, or one, at all states, inputs and steps. The delayed filters
        leave them out of their products, and compute of what is symmetric one half; a run in which one is not what is
        stated ends with an error. None: all entries are multiplied.

    The functions are plain Python that numba can compile: module-level, positional arguments, NumPy for sin and sqrt.
    f and h fill an array that they are given, because at step k + 1 the dual-rate filter does little else than f and
    an allocation would be as long again. The others return a matrix which nobody changes later, neither they nor
    the filters, so that the products of transition matrices start from it without a copy; it may be the same each time.
    A new one each time costs several times what a small model computes. F and Q may fill two of scratch in turn,
    [j % 2], for that of step j is read until step j + 1 is done; H and R one.
    """

    states: int
    inputs: int
    measurements: int
    f: Callable[[int, FloatArray, FloatArray, Parameters, FloatArray], None]
    F: Callable[[int, FloatArray, FloatArray, Parameters], FloatArray]
    Q: Callable[[int, Parameters], FloatArray]
    h: Callable[[int, FloatArray, Parameters, FloatArray], None]
    H: Callable[[int, FloatArray, Parameters], FloatArray]
    R: Callable[[int, Parameters], FloatArray]
    parameters: Parameters
    structure: Structure | None = None
