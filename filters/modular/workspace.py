"""Scratch memory of the steps of a modular filter."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.space import Space


class Workspace(NamedTuple):
    """A predictor's, or one corrector's. n, p: lengths of the errors of state and measurement.

    After a linear or extended part has run, F (n, n) or H (p, n) hold its matrix. After a correction z (p,) holds the
    innovation, S (p, p) its covariance, cross (p, n) its covariance with the state's error, gain (p, n) K^T.
    """

    F: FloatArray
    nn1: FloatArray
    nn2: FloatArray
    nn3: FloatArray
    points: FloatArray  # (2 n + 1, numbers of the state)
    moved: FloatArray
    errors: FloatArray  # (2 n + 1, n)
    moved_errors: FloatArray
    n1: FloatArray
    n2: FloatArray
    variances: FloatArray  # (n,), of the state, for differences
    V: FloatArray  # (n, 2 n), of factors
    weights: FloatArray  # (2 n,)
    weighted: FloatArray
    H: FloatArray
    z: FloatArray
    S: FloatArray
    cross: FloatArray
    gain: FloatArray
    K: FloatArray  # (n, p)
    pp1: FloatArray
    noises: FloatArray  # (p,)
    expected: FloatArray  # (numbers of the measurement,)
    seen: FloatArray  # (2 n + 1, numbers of the measurement)
    seen_errors: FloatArray  # (2 n + 1, p)


def new_workspace(space: Space, observed: Space) -> Workspace:
    """Memory for a corrector of these spaces, all zero; for a predictor, a space without numbers is observed."""
    n, p, count = space.errors, observed.errors, 2 * space.errors + 1
    return Workspace(
        F=np.zeros((n, n)),
        nn1=np.zeros((n, n)),
        nn2=np.zeros((n, n)),
        nn3=np.zeros((n, n)),
        points=np.zeros((count, space.numbers)),
        moved=np.zeros((count, space.numbers)),
        errors=np.zeros((count, n)),
        moved_errors=np.zeros((count, n)),
        n1=np.zeros(n),
        n2=np.zeros(n),
        variances=np.zeros(n),
        V=np.zeros((n, 2 * n)),
        weights=np.zeros(2 * n),
        weighted=np.zeros(2 * n),
        H=np.zeros((p, n)),
        z=np.zeros(p),
        S=np.zeros((p, p)),
        cross=np.zeros((p, n)),
        gain=np.zeros((p, n)),
        K=np.zeros((n, p)),
        pp1=np.zeros((p, p)),
        noises=np.zeros(p),
        expected=np.zeros(observed.numbers),
        seen=np.zeros((count, observed.numbers)),
        seen_errors=np.zeros((count, p)),
    )
