"""Modes that go unseen because measurements come at their rhythm: refused where the outputs depend on them.

Two modes of the same growth, of eigenvalues a and b, cannot be told apart by measurements every N steps if a^N = b^N:
an oscillation by half its period, and of such a pair one combination is never seen. The covariance of it has no bound,
although its figures come out of rounding as large numbers, so it is looked for before.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from filters.accuracy.model import LinearModel
from filters.accuracy.pattern import Interval, repeats_soon, taken
from filters.accuracy.visible import NOTHING, measured_rows, state_scale, states_of, unobservable
from filters.arrays import FloatArray

APART = 1e-3
"""Moduli of eigenvalues that are further apart, as shares, are not of the same growth: a defective one is computed as
several."""
DOUBTFUL = 0.1
"""Radians: so near to each other after a cycle two modes are looked at closely."""


def check_seen(model: LinearModel, outputs: FloatArray, N: Interval) -> None:
    """outputs (o, n): C. Raises ValueError, naming the states of the mode, for one that does not decay, that no
    measurement in the steps of N sees, and that the outputs depend on."""
    hidden = _hidden(model, outputs, N)
    if hidden is not None:
        raise ValueError(
            f"with a measurement every N={N} steps a mode of {states_of(model, hidden)} that does not decay goes "
            f"unseen, for it comes back to the same in that time, and the outputs depend on it: their variance grows "
            f"without bound; take another N, or measure what tells its states apart"
        )


def _hidden(model: LinearModel, outputs: FloatArray, N: Interval) -> FloatArray | None:
    """Such a mode (n,), in scaled states."""
    if not repeats_soon(N):
        return None
    scale, steps = state_scale(model), taken(N)
    Phi, H, C = model.Phi * scale / scale[:, None], measured_rows(model, scale), outputs * scale
    cycle = int(steps[-1])
    for basis in _of_one_growth(Phi, cycle):
        part = basis.T @ Phi @ basis
        growth = float(np.abs(np.linalg.eigvals(part)).max())
        powers = _powers(part / growth, steps)
        rows = (H @ basis @ powers[:-1]).reshape(-1, basis.shape[1])
        if len(rows) > len(part):
            rows = np.linalg.qr(rows)[1]
        rows = rows / max(float(np.abs(rows).max()), np.finfo(float).tiny)
        unseen = unobservable(powers[-1], rows, NOTHING * max(cycle / 100, 1.0), least_move=1.0)
        lasting = basis @ _lasting(powers[-1], unseen, cycle * np.log(growth))
        if lasting.shape[1]:
            reached = _reached(Phi, C, lasting, int(steps[1]))
            if reached.max() > 1e-9 * np.linalg.norm(C):
                return np.asarray(lasting[:, reached.argmax()])
    return None


def _of_one_growth(Phi: FloatArray, cycle: int) -> Iterator[FloatArray]:
    """Orthonormal bases (n, m) of the modes of each growth that do not decay, where any two may turn into the same in a
    cycle."""
    eigenvalues = np.linalg.eigvals(Phi)
    moduli = np.sort(np.abs(eigenvalues))[::-1]
    lasting = moduli[moduli >= 1.0 - APART]
    for group in np.split(lasting, np.flatnonzero(lasting[1:] < lasting[:-1] * (1.0 - APART)) + 1):
        if len(group) < 2:
            continue
        low, high = group[-1] * (1.0 - APART / 2), group[0] * (1.0 + APART / 2)
        angles = np.angle(eigenvalues[(np.abs(eigenvalues) >= low) & (np.abs(eigenvalues) <= high)])
        apart = np.abs(angles[:, None] - angles) * cycle
        if (apart < np.pi).all() or (np.abs((apart + np.pi) % (2 * np.pi) - np.pi)[apart > np.pi] > DOUBTFUL).all():
            continue
        from scipy.linalg import schur

        def within(re: float, im: float, low: float = low, high: float = high) -> bool:
            return bool(low <= np.hypot(re, im) <= high)

        _, vectors, count = schur(Phi, output="real", sort=within)
        yield vectors[:, :count]


def _powers(part: FloatArray, steps: NDArray[np.int64]) -> FloatArray:
    """Its powers (steps, m, m)."""
    found = [np.eye(len(part))]
    apart = {int(n): np.linalg.matrix_power(part, int(n)) for n in np.unique(np.diff(steps))}
    for n in np.diff(steps):
        found.append(apart[int(n)] @ found[-1])
    return np.array(found)


def _lasting(over_cycle: FloatArray, unseen: FloatArray, growth: float) -> FloatArray:
    """What of the unseen (m, hidden) does not decay; growth: logarithm of what `over_cycle` was divided by."""
    if not unseen.shape[1]:
        return unseen
    values, vectors = np.linalg.eig(unseen.T @ over_cycle @ unseen)
    kept = vectors[:, np.log(np.abs(values).clip(np.finfo(float).tiny)) + growth >= -1e-9]
    both = np.concatenate([kept.real, kept.imag], axis=1)
    return np.asarray(unseen @ both[:, np.linalg.norm(both, axis=0) > NOTHING])


def _reached(Phi: FloatArray, C: FloatArray, modes: FloatArray, steps: int) -> FloatArray:
    """The largest share of each mode (n, modes) that the outputs have in any of so many steps."""
    shares = np.zeros(modes.shape[1])
    for _ in range(steps):
        shares = np.maximum(shares, np.linalg.norm(C @ modes, axis=0) / np.linalg.norm(modes, axis=0))
        modes = Phi @ modes
    return shares
