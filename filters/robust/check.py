"""Checks of what is given to the robust filter."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.robust.records import RobustModel


def check_parameters(mu: float, xi: float) -> None:
    """Raises ValueError unless mu > 0, which may be infinite, and xi > 0, which may not."""
    if not mu > 0:
        raise ValueError(
            f"mu={mu} must be positive: it is the penalty on the model's equations; give inf for the limit"
        )
    if not (xi > 0 and np.isfinite(xi)):
        raise ValueError(f"xi={xi} must be positive and finite: lambda is (1 + xi) times its lower bound; 0.1 is usual")


def check_matrices(model: RobustModel) -> None:
    """Raises ValueError, naming the matrix, unless shapes fit, numbers are finite, and Q and R positive definite."""
    for name, matrix in zip(model._fields, model, strict=True):
        if np.ndim(matrix) != 2:
            raise ValueError(f"RobustModel: {name} has shape {np.shape(matrix)}; needed is a matrix (2-D)")
        if not np.isfinite(matrix).all():
            raise ValueError(f"RobustModel: {name} holds a value that is not finite")
    n, m, p, q = len(model.F), model.G.shape[1], len(model.H), model.D.shape[1]
    t1, t2 = len(model.E_F), len(model.E_H)
    needed = {
        "F": (n, n),
        "G": (n, m),
        "H": (p, n),
        "D": (p, q),
        "Q": (m, m),
        "R": (q, q),
        "E_F": (t1, n),
        "E_G": (t1, m),
        "E_H": (t2, n),
        "E_D": (t2, q),
        "M1": (n, model.M1.shape[1]),
        "M2": (p, model.M2.shape[1]),
    }
    for name, shape in needed.items():
        size = getattr(model, name).shape
        if size != shape:
            raise ValueError(
                f"RobustModel: {name} has shape {size}, needed is {shape}; F gives n={n}, G m={m}, H p={p}, D q={q}, "
                f"E_F t1={t1} and E_H t2={t2}"
            )
    if n == 0:
        raise ValueError("RobustModel: F is empty; there must be a state to estimate")
    check_positive_definite("Q", model.Q, "give each process noise a positive variance, or leave out its column of G")
    check_positive_definite(
        "R", model.R, "give each measurement noise a positive variance, or leave out its column of D"
    )


def check_positive_definite(name: str, matrix: FloatArray, remedy: str) -> None:
    """Raises ValueError unless the matrix (n, n) is finite, symmetric up to rounding, and positive definite."""
    if not np.isfinite(matrix).all():
        raise ValueError(f"{name} holds a value that is not finite")
    scale = np.abs(matrix).max(initial=0.0)
    if not np.allclose(matrix, matrix.T, rtol=0.0, atol=1e-9 * scale):
        raise ValueError(f"{name} is not symmetric; give ({name} + {name}.T) / 2 if that is meant")
    deviations = np.sqrt(np.abs(np.diag(matrix)))
    deviations[deviations == 0] = 1.0
    smallest = np.linalg.eigvalsh(matrix / np.outer(deviations, deviations)).min(initial=1.0)
    if not smallest > 0:
        raise ValueError(
            f"{name} is not positive definite (smallest eigenvalue {smallest:.3g} when its diagonal is scaled to 1); "
            f"{remedy}"
        )


def check_existence(model: RobustModel) -> None:
    """Raises ValueError unless [[H 0 D], [E_F E_G 0], [E_H 0 E_D]] has full row rank: the step for infinite mu exists.

    The rows are exact equations then, and must not follow from one another.
    """
    m, q = model.G.shape[1], model.D.shape[1]
    rows = np.vstack(
        [
            np.hstack([model.H, np.zeros((len(model.H), m)), model.D]),
            np.hstack([model.E_F, model.E_G, np.zeros((len(model.E_F), q))]),
            np.hstack([model.E_H, np.zeros((len(model.E_H), m)), model.E_D]),
        ]
    )
    lengths = np.linalg.norm(rows, axis=1, keepdims=True)
    rank = np.linalg.matrix_rank(rows / np.where(lengths > 0, lengths, 1.0)) if len(rows) else 0
    if rank < len(rows):
        raise ValueError(
            f"mu=inf: the rows [H 0 D], [E_F E_G 0], [E_H 0 E_D] have rank {rank}, but there are {len(rows)}, so that "
            f"the step has no unique solution; leave out E rows that follow from the others (such as E_H = E_D H where "
            f"D is the identity), or give a finite mu"
        )


def check_start(model: RobustModel, x: FloatArray, P: FloatArray) -> None:
    """Raises ValueError, naming the argument, unless x and P fit the model, and P is positive definite."""
    n = len(model.F)
    _check_array("x", x, (n,))
    _check_array("P", P, (n, n))
    check_positive_definite("P", P, "start from a positive definite one; later, see that the states are scaled alike")


def check_inputs(model: RobustModel, y: FloatArray, c: FloatArray) -> None:
    """Raises ValueError, naming the argument, unless y (p,) and c (n,), or rows of them, fit the model."""
    _check_array("y", y, (*y.shape[:-1], len(model.H)))
    _check_array("c", c, (*y.shape[:-1], len(model.F)))


def _check_array(name: str, array: FloatArray, needed: tuple[int, ...]) -> None:
    if array.shape != needed:
        raise ValueError(f"{name} has shape {array.shape}, the model needs {needed}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name} holds a value that is not finite")
