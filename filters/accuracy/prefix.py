"""The transition and the noise over 0, 1, 2, ... steps of a constant model."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.accuracy.model import LinearModel
from filters.arrays import FloatArray


class Prefix(NamedTuple):
    """Phi (steps + 1, n, n), Q (steps + 1, n, n): over a steps, Eqs. (15) to (18); a = 0: the identity and zero."""

    Phi: FloatArray
    Q: FloatArray


def prefix(model: LinearModel, steps: int) -> Prefix:
    n = model.states
    Phi, Q = np.empty((steps + 1, n, n)), np.empty((steps + 1, n, n))
    Phi[0], Q[0] = np.eye(n), 0.0
    for a in range(steps):
        model.Phi.dot(Phi[a], Phi[a + 1])  # (16)
        np.add(model.Phi.dot(Q[a]).dot(model.Phi.T), model.Q, Q[a + 1])  # (18)
    return Prefix(Phi, Q)
