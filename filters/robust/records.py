"""What a robust step reads and writes."""

from __future__ import annotations

from typing import NamedTuple

from filters.arrays import FloatArray


class RobustModel(NamedTuple):
    """x_{i+1} = (F + dF) x_i + (G + dG) w_i + c_i and y_i = (H + dH) x_i + (D + dD) v_i.

    F (n, n), G (n, m), H (p, n), D (p, q); Q (m, m) and R (q, q), the covariances of w and v, are positive definite.
    [dF dG] = M1 Delta_1 [E_F E_G] and [dH dD] = M2 Delta_2 [E_H E_D], with any contractions Delta_1 and Delta_2, for
    E_F (t1, n), E_G (t1, m), E_H (t2, n), E_D (t2, q), M1 (n, s1), M2 (p, s2). t1 = 0 or t2 = 0: no uncertainty there.
    """

    F: FloatArray
    G: FloatArray
    H: FloatArray
    D: FloatArray
    Q: FloatArray
    R: FloatArray
    E_F: FloatArray
    E_G: FloatArray
    E_H: FloatArray
    E_D: FloatArray
    M1: FloatArray
    M2: FloatArray


class Weights(NamedTuple):
    """Inverse weights: Phi1 (n, n) of the state equation, Phi2 (p, p) of the measurements, 1/lambda of the E rows."""

    Phi1: FloatArray
    Phi2: FloatArray
    inverse_lambda: float


class Predicted(NamedTuple):
    """The estimate x_{i|i-1} (n,) and its weighting matrix P_{i|i-1} (n, n), which is no covariance of its error."""

    x: FloatArray
    P: FloatArray
