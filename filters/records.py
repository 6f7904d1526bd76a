"""The records that steps of a filter read and write. Each is a named tuple of arrays, so that numba takes it as it is."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.systems.system import System


class Estimate(NamedTuple):
    """A whole-state estimate x (n,) and the covariance P (n, n) of its error."""

    x: FloatArray
    P: FloatArray


class Correction(NamedTuple):
    """What one measurement says: innovation z (p,), gain K (n, p), estimated error delta_x (n,) (Eqs. 5, 9, 10)."""

    z: FloatArray
    K: FloatArray
    delta_x: FloatArray


class Transition(NamedTuple):
    """Phi_{k->j} (n, n) and Q_{k->j} (n, n), which take error and covariance from k to j (Eqs. 13, 14)."""

    Phi: FloatArray
    Q: FloatArray


class Workspace(NamedTuple):
    """Scratch arrays, allocated once for a filter. What is in them means nothing after a job, save what is said here.

    An update form's `gain` leaves PHt for its `covariance`.
    """

    nn1: FloatArray  # (n, n)
    nn2: FloatArray
    nn3: FloatArray
    PHt: FloatArray  # (n, p)
    np1: FloatArray
    np2: FloatArray
    HP: FloatArray  # (p, n)
    S: FloatArray  # (p, p)
    S_inverse: FloatArray
    pp1: FloatArray
    n1: FloatArray  # (n,)


def new_estimate(system: System) -> Estimate:
    """Memory for an estimate, not yet filled."""
    n = system.states
    return Estimate(np.empty(n), np.empty((n, n)))


def new_correction(system: System) -> Correction:
    """Memory for a correction, not yet filled."""
    n, p = system.states, system.measurements
    return Correction(np.empty(p), np.empty((n, p)), np.empty(n))


def new_transition(system: System) -> Transition:
    """Memory for a transition, not yet filled."""
    n = system.states
    return Transition(np.empty((n, n)), np.empty((n, n)))


def new_workspace(system: System) -> Workspace:
    """Scratch memory for all jobs of a filter."""
    n, p = system.states, system.measurements
    shapes = Workspace._fields
    sizes = {"nn": (n, n), "np": (n, p), "pp": (p, p)}
    named = {"PHt": (n, p), "HP": (p, n), "S": (p, p), "S_inverse": (p, p), "n1": (n,)}
    return Workspace(*(np.empty(named.get(field) or sizes[field[:2]]) for field in shapes))
