"""What stochastic cloning does to a measurement on its way, from k, where it is taken, to m, where it corrects.

Carried is W = Phi_{k->j} P_{k^-} H_k^T (n x p), the covariance of the state with what is expected of the measurement.
Where others have been taken before k and are on their way, each with its W_g and its innovation covariance S_g, it is
made independent of them at k, as by one more block of a Cholesky factor:

    G_g = H_k W_g S_g^-1 (p x p);  W = P_{k^-} H_k^T - sum of W_g G_g^T;  S_k = H_k W + R_k

So W is the covariance with the innovation of the filter without delay, and these innovations z are white: each corrects
the state by W S^-1 z and its covariance by W S^-1 W^T when it arrives, whatever else is on its way. What is expected of
the measurement of k lacks G_g z_g of those, and gets it as they arrive.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.covariance_forms.form import CovarianceForm
from filters.kernels.dense import (
    add,
    add_matvec,
    copy_vector,
    matmul_transposed_narrow,
    subtract,
    subtract_vectors,
)
from filters.records import Estimate, Workspace
from filters.system import System


class Clone(NamedTuple):
    """What is kept of step k until its measurement arrives.

    expected (p,): h(x_{k^-}). W (n, p): P_{k^-} H_k^T. S, factor (p, p): the innovation covariance, and what divides by
    it (see `CovarianceForm.factor`).
    """

    expected: FloatArray
    W: FloatArray
    S: FloatArray
    factor: FloatArray


def new_clone(system: System) -> Clone:
    """Memory for one, zero."""
    n, p = system.states, system.measurements
    return Clone(np.zeros(p), np.zeros((n, p)), np.zeros((p, p)), np.zeros((p, p)))


def cross(
    system: System, form: CovarianceForm, k: int, reference: Estimate, clone: Clone, work: Workspace
) -> FloatArray:
    """What can be had at k only: h(x_{k^-}) and W. Returns H_k."""
    H = system.H(k, reference.x, system.parameters)
    form.cross(reference.P, H, clone.W, work)
    system.h(k, reference.x, system.parameters, clone.expected)
    return H


def couple(
    form: CovarianceForm,
    H: FloatArray,
    earlier: Clone,
    W_earlier: FloatArray,
    W: FloatArray,
    W_apart: FloatArray,
    G: FloatArray,
    work: Workspace,
) -> None:
    """Job of step k, for each measurement that is on its way there: W is made independent of it.

    H (p, n): H_k. W_earlier (n, p): that of the other, as carried to k. W_apart (n, p): W - W_earlier G^T is written
    there; G (p, p): the share of the other's innovation in what is expected of this one.
    """
    form.expectation(H, W_earlier, work.S)
    form.cross_share(work.S, earlier.factor, G, work)
    matmul_transposed_narrow(W_earlier, G, work.np1)
    subtract(W, work.np1, W_apart)


def divide(system: System, form: CovarianceForm, k: int, H: FloatArray, clone: Clone, work: Workspace) -> None:
    """S from W, and its factor."""
    form.expectation(H, clone.W, clone.S)
    add(clone.S, system.R(k, system.parameters), clone.S)  # innovation covariance
    form.factor(clone.S, clone.factor, work)


def carry(form: CovarianceForm, Phi: FloatArray, W: FloatArray, W_next: FloatArray) -> None:
    """Job of steps k + 1 .. m - 1: W of the step before becomes that of this one, by its Phi."""
    form.carry(Phi, W, W_next)


def correct(
    form: CovarianceForm,
    y: FloatArray,
    clone: Clone,
    W: FloatArray,
    before: Estimate,
    after: Estimate,
    z: FloatArray,
    work: Workspace,
) -> None:
    """Eqs. (20) and (21) by W."""
    subtract_vectors(y, clone.expected, z)
    form.cross_update(before, W, clone.S, clone.factor, z, after, work)


def compensate(expected: FloatArray, C: FloatArray, z: FloatArray, now_expected: FloatArray) -> None:
    """Job of step m, for each later measurement that is on its way: what it is expected to be, with z in the state.

    C (p, p): what z adds to it.
    """
    copy_vector(expected, now_expected)
    add_matvec(C, z, now_expected)


def gain_at_k(form: CovarianceForm, clone: Clone, K: FloatArray, work: Workspace) -> None:
    """K_k (Eq. 9), which no job needs; for the record."""
    form.cross_gain(clone.W, clone.S, K, work)
