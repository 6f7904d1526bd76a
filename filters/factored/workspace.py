"""Scratch memory of the factored forms."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.records import Workspace, new_workspace
from filters.system import System


class FactoredWorkspace(NamedTuple):
    """Scratch arrays, allocated once for a filter. What one call leaves in them means nothing to the next."""

    dense: Workspace
    L: FloatArray  # (p, p), R = L D L^T
    variances: FloatArray  # (p,), D
    decorrelated_H: FloatArray  # (p, n)
    gains: FloatArray  # (p, n)
    V: FloatArray  # (n, 2n), a root of the propagated covariance that is not triangular yet
    weights: FloatArray  # (2n,)
    weighted: FloatArray


def new_factored_workspace(system: System) -> FactoredWorkspace:
    """Scratch memory for the functions of any factored form."""
    n, p = system.states, system.measurements
    return FactoredWorkspace(
        dense=new_workspace(system),
        L=np.zeros((p, p)),
        variances=np.zeros(p),
        decorrelated_H=np.zeros((p, n)),
        gains=np.zeros((p, n)),
        V=np.zeros((n, 2 * n)),
        weights=np.zeros(2 * n),
        weighted=np.zeros(2 * n),
    )
