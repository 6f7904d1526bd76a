"""The model whose accuracy is computed: constant matrices, or a system as it is at one state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray, as_array
from filters.covariances import check_covariance, check_measurement_noise
from filters.problem import check_system
from filters.system import System


class LinearModel(NamedTuple):
    """x_{j+1} = Phi x_j + w_j, y_k = H x_k + nu_k, w ~ N(0, Q), nu ~ N(0, R) (Steffes 2014, Eqs. 1, 2).

    Phi, Q (n, n); H (p, n); R (p, p). names: of the states, for messages; none if they have none.
    """

    Phi: FloatArray
    Q: FloatArray
    H: FloatArray
    R: FloatArray
    names: tuple[str, ...] = ()

    @property
    def states(self) -> int:
        return len(self.Phi)


def linear_model(Phi: ArrayLike, Q: ArrayLike, H: ArrayLike, R: ArrayLike, names: Sequence[str] = ()) -> LinearModel:
    """Raises ValueError, naming the matrix, for a wrong shape, what is not finite, and a noise that is no covariance; R
    must be positive definite."""
    model = LinearModel(as_array("Phi", Phi), as_array("Q", Q), as_array("H", H), as_array("R", R), tuple(names))
    n = len(model.Phi) if model.Phi.ndim == 2 else 0
    p = len(model.H) if model.H.ndim == 2 else 0
    needed = {"Phi": (n, n), "Q": (n, n), "H": (p, n), "R": (p, p)}
    for name, matrix in zip(needed, model[:4], strict=True):
        if 0 in matrix.shape or matrix.shape != needed[name]:
            raise ValueError(f"{name} has shape {matrix.shape}, needed is {needed[name]}: Phi (n, n), H (p, n)")
        if not np.isfinite(matrix).all():
            at = ", ".join(map(str, np.argwhere(~np.isfinite(matrix))[0]))
            raise ValueError(f"{name} holds a value that is not finite, at [{at}]; give numbers")
    if names and len(names) != n:
        raise ValueError(f"names={tuple(names)!r} are {len(names)}, the model has {n} states; give one for each")
    check_covariance("Q", model.Q)
    check_measurement_noise(model.R, None)
    return model


def linearised(system: System, x: ArrayLike | None = None, u: ArrayLike | None = None) -> LinearModel:
    """The system in step 0 at the state x (n,) with the input u (m,), both zero if not given.

    Raises ValueError as `linear_model` does, and for a wrong x or u.
    """
    check_system("system", system)
    at = np.zeros(system.states) if x is None else as_array("x", x)
    moved = np.zeros(system.inputs) if u is None else as_array("u", u)
    for name, value, length in (("x", at, system.states), ("u", moved, system.inputs)):
        if value.shape != (length,):
            raise ValueError(f"{name} has shape {value.shape}, the system needs ({length},)")
        if not np.isfinite(value).all():
            raise ValueError(f"{name} holds a value that is not finite; give numbers")
    parameters = system.parameters
    return linear_model(
        system.F(0, at, moved, parameters),
        system.Q(0, parameters),
        system.H(0, at, parameters),
        system.R(0, parameters),
    )


def output_rows(outputs: ArrayLike, states: int) -> FloatArray:
    """C (outputs, n). outputs: that matrix, or the numbers of the states that are the outputs, each once."""
    array = as_array("outputs", outputs)
    if array.ndim == 1:
        if not len(array) or not np.isin(array, np.arange(states)).all():
            raise ValueError(f"outputs {outputs!r}: give numbers of states, from 0 to {states - 1}")
        chosen = array.astype(int)
        if repeated := [int(state) for state in dict.fromkeys(chosen) if (chosen == state).sum() > 1]:
            raise ValueError(f"outputs {outputs!r}: state {repeated[0]} is there twice: give each state once")
        rows: FloatArray = np.eye(states)[chosen]
        return rows
    if array.ndim != 2 or array.shape[1] != states or not len(array) or not np.isfinite(array).all():
        raise ValueError(f"outputs has shape {array.shape}: give finite rows of {states} numbers, one for each state")
    return array
