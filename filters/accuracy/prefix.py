"""The transition and the noise over 0, 1, 2, ... steps of a constant model."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from filters.accuracy.model import LinearModel
from filters.arrays import FloatArray

KEPT = 8
"""Of models, in case the next question is of the same ones."""

MOST_KEPT = 200_000
"""Numbers of one that is kept."""


class Prefix(NamedTuple):
    """Phi (steps + 1, n, n), Q (steps + 1, n, n): over a steps, Eqs. (15) to (18); a = 0: the identity and zero."""

    Phi: FloatArray
    Q: FloatArray


def prefix(model: LinearModel, steps: int) -> Prefix:
    """Not to be written into: it may be kept."""
    longest = 1 << steps.bit_length()
    Phi, Q = (np.asarray(matrix, dtype=float) for matrix in (model.Phi, model.Q))
    if longest * model.states**2 > MOST_KEPT:
        return _made(Phi, Q, steps)
    kept = _kept(Phi.tobytes(), Q.tobytes(), model.states, longest)
    return Prefix(kept.Phi[: steps + 1], kept.Q[: steps + 1])


@lru_cache(maxsize=KEPT)
def _kept(Phi: bytes, Q: bytes, n: int, steps: int) -> Prefix:
    found = _made(np.frombuffer(Phi).reshape(n, n), np.frombuffer(Q).reshape(n, n), steps)
    for of in found:
        of.setflags(write=False)
    return found


def _made(transition: FloatArray, noise: FloatArray, steps: int) -> Prefix:
    n = len(transition)
    Phi, Q = np.empty((steps + 1, n, n)), np.empty((steps + 1, n, n))
    Phi[0], Q[0] = np.eye(n), 0.0
    for a in range(steps):
        transition.dot(Phi[a], Phi[a + 1])  # (16)
        np.add(transition.dot(Q[a]).dot(transition.T), noise, Q[a + 1])  # (18)
    return Prefix(Phi, Q)
