"""A system of whose measurements some were lost: what is lost is a row of zeros in H.

A filter that is given such a row learns nothing from it and needs to know nothing of it: K has a column of zeros, and
x and P are those of H and R with the remaining rows.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.system import System


class LossyParameters(NamedTuple):
    """system: without losses. present (rows, p): which numbers of the measurement of step c `every` came, c its row."""

    system: System
    every: int
    present: NDArray[np.bool_]


def lossy(system: System, every: int, present: NDArray[np.bool_]) -> System:
    """The system, of whose measurements, one every so many steps, only those came that are present (rows, p)."""
    if present.all():
        return system
    parameters = LossyParameters(system, every, present)
    return System(*system[:3], _f, _F, _Q, _h, _H, _R, parameters)


def _f(j: int, x: FloatArray, u: FloatArray, lossy: LossyParameters, out: FloatArray) -> None:
    lossy.system.f(j, x, u, lossy.system.parameters, out)


def _F(j: int, x: FloatArray, u: FloatArray, lossy: LossyParameters) -> FloatArray:
    return lossy.system.F(j, x, u, lossy.system.parameters)


def _Q(j: int, lossy: LossyParameters) -> FloatArray:
    return lossy.system.Q(j, lossy.system.parameters)


def _h(k: int, x: FloatArray, lossy: LossyParameters, out: FloatArray) -> None:
    lossy.system.h(k, x, lossy.system.parameters, out)


def _H(k: int, x: FloatArray, lossy: LossyParameters) -> FloatArray:
    H = lossy.system.H(k, x, lossy.system.parameters).copy()
    present = lossy.present[k // lossy.every]
    for r in range(H.shape[0]):
        if not present[r]:
            for i in range(H.shape[1]):
                H[r, i] = 0.0
    return H


def _R(k: int, lossy: LossyParameters) -> FloatArray:
    """Noise of what was lost keeps its variance and goes with no other."""
    R = lossy.system.R(k, lossy.system.parameters).copy()
    present = lossy.present[k // lossy.every]
    for r in range(R.shape[0]):
        for s in range(r):
            if not (present[r] and present[s]):
                R[r, s] = 0.0
                R[s, r] = 0.0
    return R
