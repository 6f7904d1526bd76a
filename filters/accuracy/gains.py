"""The accuracy of a filter whose gain is not the best one: it assumes a noise that is not the true one.

The gain settles by the Riccati equation that the filter believes; the error by the one that holds for any gain,
X = A X A^T + Phi_N K R K^T Phi_N^T + Q_N with A = Phi_N (I - K H).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.accuracy.model import LinearModel
from filters.accuracy.periodic import by_age, noise_by_age, not_found, or_infinite
from filters.accuracy.prefix import prefix
from filters.accuracy.riccati import gain, steady_prior, steady_state, updated
from filters.accuracy.unseen import check_seen
from filters.accuracy.visible import visible
from filters.arrays import FloatArray

CycleNoise: TypeAlias = Callable[[LinearModel, int], FloatArray]
"""What a filter takes for the noise of N steps, (n, n)."""


NO_GAIN = (
    "no noise in Q stirs a mode that does not decay, so that its gain goes to zero and what this method makes of it "
    "depends on all that ever was; give it a noise"
)


class Assumed(NamedTuple):
    """A filter with such a gain in its periodic regime.

    K (n, p); radius: spectral radius of the error from cycle to cycle, unstable from 1 on; before, believed_before
    (outputs, outputs): C P^-_N C^T as it is, and as the filter's own P says; variances, believed (ages,): tr V_N(a) so,
    with the true noise since the measurement; jumps (ages,): as in `Steady`. Nothing that is true is finite where the
    radius is 1 or more.
    """

    K: FloatArray
    radius: float
    before: FloatArray
    believed_before: FloatArray
    variances: FloatArray
    believed: FloatArray
    jumps: FloatArray


def summed_noise(model: LinearModel, N: int) -> FloatArray:
    """Q' over N steps: only summed (Steffes 2014, Eq. 23)."""
    return N * model.Q


def halved_noise(model: LinearModel, N: int) -> FloatArray:
    """Q'' over N steps: the first half of the sum goes through the transition (Steffes 2014, Eq. 24)."""
    Phi, first = np.linalg.matrix_power(model.Phi, N), N // 2
    return np.asarray(first * Phi @ model.Q @ Phi.T + (N - first) * model.Q)


def with_assumed(
    model: LinearModel,
    outputs: FloatArray,
    N: int,
    oldest: int,
    cycle_noise: CycleNoise | None = None,
    R: FloatArray | None = None,
    divided: int = 1,
) -> Assumed:
    """cycle_noise: of the model that is left of it (`visible`); R (p, p): what the filter takes for the noise of a
    measurement; the true ones if not given. divided: by how much the gain is divided.

    With divided = n the cycle is one step of the n that the gain is computed over (K / n, the multirate gain).
    Raises ValueError as `steady` does.
    """
    reduced, C = visible(model, outputs)
    if divided == 1:
        check_seen(model, outputs, N)
    with np.errstate(over="ignore", invalid="ignore"):
        over = prefix(reduced, max(N * divided, oldest))
        Phi, H = over.Phi[N], reduced.H
        assumed_Q = over.Q[N * divided] if cycle_noise is None else cycle_noise(reduced, N)
        assumed_R = reduced.R if R is None else R
        prior = steady_prior(over.Phi[N * divided], assumed_Q, H, assumed_R)
        if not np.isfinite(prior).all():
            raise ValueError(not_found(N * divided, over.Phi[N * divided]))
        K = gain(prior, H, assumed_R) / divided
        A = Phi @ (np.eye(reduced.states) - K @ H)
        true_prior = steady_state(A, Phi @ K @ reduced.R @ K.T @ Phi.T + over.Q[N])
        after, believed = updated(true_prior, K, H, reduced.R), updated(prior, K, H, assumed_R)
        moved = K @ (H @ true_prior @ H.T + reduced.R) @ K.T
        noise = noise_by_age(over, C, oldest)
        return Assumed(
            K,
            float(np.abs(np.linalg.eigvals(A)).max()),
            C @ true_prior @ C.T,
            C @ prior @ C.T,
            or_infinite(by_age(over, C, after[None], oldest)[0] + noise),
            or_infinite(by_age(over, C, believed[None], oldest)[0] + noise),
            or_infinite(by_age(over, C, moved[None], oldest)[0]),
        )
