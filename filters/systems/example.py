"""Random linear systems on which costs are measured and laws are tested."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.system import System
from filters.systems.linear import linear_system

PERIOD = 8  # steps after which the matrices repeat


def example_system(states: int = 9, inputs: int = 3, measurements: int = 3, seed: int = 0) -> System:
    """A random linear system whose five matrices differ from step to step; 9/3/3 is the size of Steffes' example.

    Stable and well conditioned: Phi is a rotation times a diagonal in [0.9, 1], so that no product of them grows,
    and all noise covariances have eigenvalues of about one tenth to one.

    Raises:
        ValueError: states or measurements are less than 1, or inputs less than 0.
    """
    if min(states, inputs + 1, measurements) < 1:
        raise ValueError(
            f"example_system: states={states}, inputs={inputs}, measurements={measurements}: there must be at least "
            f"one state and one measurement; of inputs there may be none"
        )
    random = np.random.default_rng(seed)
    return linear_system(
        Phi=np.array([_stable(random, states) for _ in range(PERIOD)]),
        B=random.normal(size=(PERIOD, states, inputs)),
        H=random.normal(size=(PERIOD, measurements, states)),
        Q=np.array([0.2 * _covariance(random, states) for _ in range(PERIOD)]),
        R=np.array([_covariance(random, measurements) for _ in range(PERIOD)]),
    )


def _stable(random: np.random.Generator, n: int) -> FloatArray:
    rotation, _ = np.linalg.qr(np.eye(n) + 0.3 * random.normal(size=(n, n)))
    Phi: FloatArray = rotation * random.uniform(0.9, 1.0, size=n)
    return Phi


def _covariance(random: np.random.Generator, n: int) -> FloatArray:
    rotation, _ = np.linalg.qr(random.normal(size=(n, n)))
    root: FloatArray = rotation * np.sqrt(random.uniform(0.5, 1.5, size=n))
    return root @ root.T
