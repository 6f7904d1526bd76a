"""Random covariances to propagate and update, and NumPy's own algebra for both."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from hypothesis import strategies as st

from filters.system import System
from filters.systems.linear import linear_system

Array = Any


class Problem(NamedTuple):
    """One propagation and one update, well conditioned."""

    Phi: Array
    P: Array
    Q: Array
    H: Array
    R: Array

    @property
    def system(self) -> System:
        return linear_system(self.Phi, np.zeros((len(self.P), 1)), self.H, self.Q, self.R)

    @property
    def propagated(self) -> Array:
        return self.Phi @ self.P @ self.Phi.T + self.Q

    @property
    def gain(self) -> Array:
        return self.P @ self.H.T @ np.linalg.inv(self.H @ self.P @ self.H.T + self.R)

    @property
    def updated(self) -> Array:
        return (np.eye(len(self.P)) - self.gain @ self.H) @ self.P


def problem(n: int, p: int, sources: int, seed: int) -> Problem:
    """n states, p measurements with correlated noise, and as many sources of process noise: Q has that rank."""
    random = np.random.default_rng(seed)
    G = random.normal(size=(n, sources))
    return Problem(
        Phi=np.eye(n) + 0.3 * random.normal(size=(n, n)),
        P=covariance(random, n),
        Q=G @ G.T,
        H=random.normal(size=(p, n)),
        R=covariance(random, p),
    )


def covariance(random: np.random.Generator, n: int) -> Array:
    A = random.normal(size=(n, n))
    return A @ A.T + 0.5 * np.eye(n)


numbers = st.tuples(st.integers(1, 9), st.integers(1, 4), st.integers(0, 9), st.integers(0, 2**31 - 1))
"""n, p, sources and seed of a problem."""
problems = st.builds(lambda drawn: problem(*drawn), numbers)


def close(found: Array, expected: Array) -> None:
    """Relative to the greatest element."""
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * np.max(np.abs(expected), initial=1e-300))
