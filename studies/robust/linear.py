"""Linear systems to try the stability of the robust filter on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.robust.records import RobustModel

KALMAN = "Kalman filter"
NOTHING = (0.0, 0.0)
"""A row of E that says that nothing is uncertain."""


class Linear(NamedTuple):
    """A filter on a constant system. off (n, n): by how much F may be wrong, either way."""

    name: str
    system: str
    model: RobustModel
    mu: float
    off: FloatArray


def sayed(E_F: Sequence[float] = (0.0, 5.0)) -> RobustModel:
    """The example of Sayed 2001, with an uncertain element of F; both states decay."""
    Q = np.array([[1.9608, 0.0195], [0.0195, 1.9608]])
    return _two_states([[0.9802, 0.0196], [0.0, 0.9802]], [1.0, -1.0], E_F, Q, 0.0198)


def growing(E_F: Sequence[float] = (1.0, 0.0)) -> RobustModel:
    """One of its states grows by 5 % a step, and by how much is what is uncertain."""
    return _two_states([[1.05, 0.1], [0.0, 0.95]], [1.0, 0.0], E_F, np.eye(2), 0.1)


def _two_states(
    F: Sequence[Sequence[float]], H: Sequence[float], E_F: Sequence[float], Q: FloatArray, M: float
) -> RobustModel:
    return RobustModel(
        F=np.array(F), G=np.eye(2), H=np.array([H]), D=np.eye(1), Q=Q, R=np.eye(1),
        E_F=np.array([E_F]), E_G=np.zeros((1, 2)), E_H=np.zeros((0, 2)), E_D=np.zeros((0, 1)),
        M1=np.array([[M], [0.0]]), M2=np.zeros((1, 1)),
    )  # fmt: skip


CASES = tuple(
    Linear(name, system, model(NOTHING) if name == KALMAN else model(), mu, model().M1 @ model().E_F)
    for system, model in (("decaying", sayed), ("growing", growing))
    for name, mu in ((KALMAN, np.inf), ("robust, μ = 1", 1.0), ("robust, μ = ∞", np.inf))
)
"""The Kalman filter is the robust one of which nothing is uncertain."""


def random_system(seed: int, noises: int) -> RobustModel:
    """Of 1 to 4 states, with one uncertain row; the spectral radius of F is between 0.5 and 1.2."""
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 5))
    p, m = int(random.integers(1, n + 1)), noises
    F = random.normal(size=(n, n))
    F *= random.uniform(0.5, 1.2) / spectral_radius(F)
    return RobustModel(
        F=F, G=random.normal(size=(n, m)), H=random.normal(size=(p, n)), D=np.eye(p), Q=np.eye(m), R=np.eye(p),
        E_F=random.normal(size=(1, n)), E_G=random.normal(size=(1, m)), E_H=np.zeros((0, n)), E_D=np.zeros((0, p)),
        M1=random.normal(size=(n, 1)), M2=np.zeros((p, 1)),
    )  # fmt: skip


def spectral_radius(matrix: FloatArray) -> float:
    """The largest magnitude of an eigenvalue."""
    return float(np.abs(np.linalg.eigvals(matrix)).max())
