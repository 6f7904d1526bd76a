"""What a factored form is."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from filters.arrays import FloatArray
from filters.factored.workspace import FactoredWorkspace

Conversion: TypeAlias = Callable[[FloatArray, FloatArray], None]
Propagation: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, FactoredWorkspace], None]
Update: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FactoredWorkspace], None]


class FactoredForm(NamedTuple):
    """How a covariance is kept between gains: as it is, as a triangular square root, or as U D U^T.

    What is kept is always one array (n, n), the factors; out is never one of the inputs.

    factor(P, out): writes the factors of P (n, n), symmetric and positive semidefinite.
    covariance(factors, out): writes the P (n, n) that the factors stand for.
    propagation(Phi, factors, Q, out, work): writes the factors of Phi P Phi^T + Q, Eq. (8), for Phi (n, n), Q (n, n)
        symmetric and positive semidefinite: singular where there are fewer noise sources than states, or zero.
    update(factors, H, R, K, out, work): writes the gain K (n, p) = P H^T (H P H^T + R)^-1, Eq. (9), and the factors of
        [I - K H] P, Eq. (11), for H (p, n) and R (p, p), symmetric and positive definite.
    """

    factor: Conversion
    covariance: Conversion
    propagation: Propagation
    update: Update
