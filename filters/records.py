"""The records that steps of a filter read and write: named tuples of arrays, which numba takes as they are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.system import System


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
    """Scratch arrays, allocated once for a filter. What a job leaves in them means nothing to the next.

    Two exceptions: I is the identity, never written; a covariance form's `gain` may leave things to its `covariance`.
    """

    I: FloatArray  # (n, n)
    nn1: FloatArray  # (n, n)
    nn2: FloatArray
    nn3: FloatArray
    PHt: FloatArray  # (n, p)
    np1: FloatArray
    HP: FloatArray  # (p, n)
    pn1: FloatArray
    S: FloatArray  # (p, p)
    S_inverse: FloatArray
    pp1: FloatArray
    n1: FloatArray  # (n,)
    p1: FloatArray  # (p,)


class Sample(NamedTuple):
    """A moment k at which a measurement is taken, and m, at which it is available.

    reference: x_{k^-}, P_{k^-}. y (p,): the measurement. correction: what it says at k. P_posterior: P_{k^+}.
    now: x_{m^-}, P_{m^-}, not corrected. transition: Phi_{k->m}, Q_{k->m}. u (m,): the input of step m.
    """

    k: int
    m: int
    reference: Estimate
    y: FloatArray
    correction: Correction
    P_posterior: FloatArray
    now: Estimate
    transition: Transition
    u: FloatArray


def new_estimate(system: System) -> Estimate:
    """Memory for an estimate, zero."""
    n = system.states
    return Estimate(np.zeros(n), np.zeros((n, n)))


def new_correction(system: System) -> Correction:
    """Memory for a correction, zero."""
    n, p = system.states, system.measurements
    return Correction(np.zeros(p), np.zeros((n, p)), np.zeros(n))


def new_transition(system: System) -> Transition:
    """Memory for a transition, zero."""
    n = system.states
    return Transition(np.zeros((n, n)), np.zeros((n, n)))


def new_workspace(system: System) -> Workspace:
    """Scratch memory for all jobs of a filter."""
    n, p = system.states, system.measurements
    return Workspace(
        I=np.eye(n),
        nn1=np.zeros((n, n)),
        nn2=np.zeros((n, n)),
        nn3=np.zeros((n, n)),
        PHt=np.zeros((n, p)),
        np1=np.zeros((n, p)),
        HP=np.zeros((p, n)),
        pn1=np.zeros((p, n)),
        S=np.zeros((p, p)),
        S_inverse=np.zeros((p, p)),
        pp1=np.zeros((p, p)),
        n1=np.zeros(n),
        p1=np.zeros(p),
    )
