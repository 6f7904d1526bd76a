"""What a robust step needs of an uncertain system: its matrices made ready, and how its equations are weighed."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.robust.check import check_existence, check_matrices, check_parameters
from filters.robust.records import RobustModel, Weights


def weights(model: RobustModel, mu: float = np.inf, xi: float = 0.1) -> Weights:
    """The weights of a model as `prepared` leaves it, for the penalty mu; an infinite one gives zeros.

    lambda = (1 + xi) mu max(|M1^T M1|, |M2^T M2|), Phi = I / mu - M M^T / lambda (Sayed and Nascimento 1999; Rocha and
    Terra 2021). Without uncertainty Phi = I / mu.

    Raises:
        ValueError: mu or xi is not positive.
    """
    check_parameters(mu, xi)
    n, p = len(model.F), len(model.H)
    if np.isinf(mu):
        return Weights(np.zeros((n, n)), np.zeros((p, p)), 0.0)
    lambda_ = (1.0 + xi) * mu * max(_squared_norm(model.M1), _squared_norm(model.M2))
    inverse_lambda = 1.0 / lambda_ if lambda_ > 0 else 0.0
    return Weights(
        np.eye(n) / mu - inverse_lambda * model.M1 @ model.M1.T,
        np.eye(p) / mu - inverse_lambda * model.M2 @ model.M2.T,
        inverse_lambda,
    )


def prepared(model: RobustModel, mu: float = np.inf, xi: float = 0.1) -> RobustModel:
    """The model as the steps need it: contiguous arrays of floats, no E row that is zero, M zero where E is.

    With a finite mu, E rows are dropped as well where M1 and M2 are zero. (With an infinite one M plays no part.)

    Raises:
        ValueError: a shape does not fit, a number is not finite, Q or R is not positive definite, mu or xi is not
            positive, or mu is infinite and the step has no solution.
    """
    check_parameters(mu, xi)
    arrays = RobustModel(*(np.array(matrix, dtype=np.float64, order="C") for matrix in model))
    check_matrices(arrays)
    known = np.isfinite(mu) and not arrays.M1.any() and not arrays.M2.any()
    used_1 = (arrays.E_F.any(axis=1) | arrays.E_G.any(axis=1)) & (not known)
    used_2 = (arrays.E_H.any(axis=1) | arrays.E_D.any(axis=1)) & (not known)
    ready = arrays._replace(
        E_F=arrays.E_F[used_1],
        E_G=arrays.E_G[used_1],
        E_H=arrays.E_H[used_2],
        E_D=arrays.E_D[used_2],
        M1=arrays.M1 if used_1.any() else np.zeros_like(arrays.M1),
        M2=arrays.M2 if used_2.any() else np.zeros_like(arrays.M2),
    )
    if np.isinf(mu):
        check_existence(ready)
    return ready


def without_measurement(model: RobustModel) -> RobustModel:
    """The model of a step in which nothing is measured: p = q = t2 = 0."""
    n = len(model.F)
    return model._replace(
        H=np.zeros((0, n)),
        D=np.zeros((0, 0)),
        R=np.zeros((0, 0)),
        E_H=np.zeros((0, n)),
        E_D=np.zeros((0, 0)),
        M2=np.zeros((0, 0)),
    )


def _squared_norm(M: FloatArray) -> float:
    """|M^T M|_2; 0 for a matrix without columns."""
    return float(np.linalg.norm(M, 2) ** 2) if M.size else 0.0
