"""What no measurement ever says: it is left out where the outputs do not depend on it, and refused where they do.

Hovering, an attitude filter's yaw is never seen: its variance grows without bound while the position is right.
"""

from __future__ import annotations

import numpy as np

from filters.accuracy.model import LinearModel
from filters.accuracy.prefix import prefix
from filters.arrays import FloatArray

NOTHING = 1e-12
"""A singular value of scaled matrices that is zero but for rounding."""
ROUNDED = 1e-15
"""A row of H with no greater number in it is one of zeros, as the cosine of a right angle is computed: 6e-17."""


def visible(model: LinearModel, outputs: FloatArray) -> tuple[LinearModel, FloatArray]:
    """The model and its outputs C without the modes that no measurement says anything of and that do not decay.

    What is left is a model of its own, for those modes act on nothing else that is measured: exact.
    Raises ValueError where the outputs depend on such a mode (test of Popov, Belevitch and Hautus): their variance has
    no bound.
    """
    scale = state_scale(model)
    Phi, H, C = model.Phi * scale / scale[:, None], measured_rows(model, scale), outputs * scale
    hidden = _undecaying(Phi, unobservable(Phi, H))
    if not hidden.shape[1]:
        return model, outputs
    if np.linalg.norm(C @ hidden) > 1e-9 * np.linalg.norm(C):
        mode = hidden[:, np.linalg.norm(C @ hidden, axis=0).argmax()]
        raise ValueError(
            f"no measurement ever says anything of a mode of {states_of(model, mode)} that does not decay, and the "
            f"outputs depend on it: their variance grows without bound; measure it, or ask for other outputs"
        )
    kept = np.linalg.svd(hidden)[0][:, hidden.shape[1] :]  # orthonormal, across what is hidden
    down, up = kept.T / scale, scale[:, None] * kept
    left = LinearModel(down @ model.Phi @ up, down @ model.Q @ down.T, model.H @ up, model.R)
    return left, outputs @ up


def seen(model: LinearModel, outputs: FloatArray) -> tuple[LinearModel, FloatArray]:
    """The model and its outputs C without what the outputs do not depend on; without measurements, (0, n) and (0, 0).

    What is left is a model of its own, for it is acted on by nothing else.
    """
    scale = state_scale(model)
    Phi, C = model.Phi * scale / scale[:, None], outputs * scale
    hidden = unobservable(Phi, _normalised(C))
    kept = np.linalg.svd(hidden)[0][:, hidden.shape[1] :] if hidden.shape[1] else np.eye(model.states)
    down, up = kept.T / scale, scale[:, None] * kept
    part = LinearModel(down @ model.Phi @ up, down @ model.Q @ down.T, np.empty((0, kept.shape[1])), np.empty((0, 0)))
    return part, outputs @ up


def unobservable(Phi: FloatArray, rows: FloatArray, nothing: float = NOTHING, least_move: float = 0.0) -> FloatArray:
    """An orthonormal basis (n, hidden) of the largest subspace that the rows do not see and Phi does not leave; all
    scaled, rows of length 1. least_move: of Phi less the identity; what is below it by `nothing` is rounding."""
    basis = _null(rows, nothing)
    moved = Phi - np.eye(len(Phi))  # leaves the same subspaces
    moved /= max(np.abs(moved).max(), least_move, np.finfo(float).tiny)
    while basis.shape[1]:
        beyond = moved @ basis
        beyond -= basis @ (basis.T @ beyond)
        kept = _null(beyond, nothing)
        if kept.shape[1] == basis.shape[1]:
            return basis
        basis = basis @ kept
    return basis


def _undecaying(Phi: FloatArray, hidden: FloatArray) -> FloatArray:
    if not hidden.shape[1]:
        return hidden
    from scipy.linalg import schur

    _, vectors, lasting = schur(
        hidden.T @ Phi @ hidden, output="real", sort=lambda re, im: bool(np.hypot(re, im) >= 1 - 1e-9)
    )
    return np.asarray(hidden @ vectors[:, :lasting])


def _null(matrix: FloatArray, nothing: float) -> FloatArray:
    """An orthonormal basis of what the matrix makes zero."""
    _, values, rows = np.linalg.svd(matrix)
    return np.asarray(rows[np.count_nonzero(values > nothing) :].T)


def measured_rows(model: LinearModel, scale: FloatArray) -> FloatArray:
    """H of scaled states (`state_scale`), rows of length 1; of zeros where nothing but rounding is in it."""
    rows = model.H * scale
    signal = np.linalg.norm(rows, axis=1) / np.sqrt(np.diag(model.R))
    nothing = (np.abs(model.H).max(axis=1) <= ROUNDED) & (signal <= NOTHING)
    return np.where(nothing[:, None], 0.0, _normalised(rows))


def _normalised(rows: FloatArray) -> FloatArray:
    return np.asarray(rows / np.linalg.norm(rows, axis=1, keepdims=True).clip(np.finfo(float).tiny))


def states_of(model: LinearModel, mode: FloatArray) -> str:
    """The names of those that it is mostly of; mode (n,): in scaled states."""
    names = model.names or tuple(f"state {i}" for i in range(model.states))
    return ", ".join(names[i] for i in np.argsort(-np.abs(mode)) if abs(mode[i]) > 0.1 * np.abs(mode).max())


def state_scale(model: LinearModel) -> FloatArray:
    """One of each state: the deviation that noise gives it in some steps, 1 where there is none."""
    variances = np.diag(prefix(model, 2 * model.states).Q[-1])
    return np.asarray(np.where(variances > 0.0, np.sqrt(variances), 1.0))
