"""Eqs. (4) to (6) of the patent: measurements that follow ever more closely, and the continuous filter they tend to.

Of the receiver of `filters.systems.gps`, settled, with the satellites where they are in step 0. However many
measurements there are, they say as much in a second: R dT is that of one measurement each second.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.accuracy.riccati import gain, steady_prior, steady_state
from filters.arrays import FloatArray
from filters.systems.coarse import CoarseNoise
from filters.systems.gps import POSITION, gps, gps_coarse, motion

RANGE_SIGMA_M = 5.0
"""Of a measurement, where there is one each second."""


class Tending(NamedTuple):
    """What a receiver tends to: gains per second, by `share`, over that of the continuous filter.

    optimal: K(dT) / dT. averaged, sampled: (K(n dT) / n) / dT, computed with R / n or with R.
    averaged_ratio, sampled_ratio: the true variance of the position error with those gains, over the optimum.
    """

    n: int
    period_s: float
    optimal: float
    averaged: float
    sampled: float
    averaged_ratio: float
    sampled_ratio: float


def tending(acceleration_noise: float, period_s: float, n: int) -> Tending:
    """period_s: dT, between measurements; n of them for each gain."""
    continuous = share(continuous_gain(acceleration_noise))
    sigma_m = RANGE_SIGMA_M / period_s**0.5
    model = gps(period_s, 0, acceleration_noise, range_sigma_m=sigma_m).parameters
    matrices = (model.Phi, model.Q, model.H[0], model.R)
    best = _settled(*matrices)

    def divided(noise: CoarseNoise) -> FloatArray:
        coarse = gps_coarse(n, period_s, 0, acceleration_noise, range_sigma_m=sigma_m, noise=noise).parameters
        return _settled(coarse.Phi, coarse.Q, coarse.H[0], coarse.R) / n

    gains = [best, divided("averaged"), divided("sampled")]
    rates = [share(K) / period_s / continuous for K in gains]
    optimum, *variances = [_position_variance(*matrices, K) for K in gains]
    return Tending(n, period_s, *rates, *(variance / optimum for variance in variances))


def continuous_gain(acceleration_noise: float) -> FloatArray:
    """K (8, 4), per second, of the settled continuous filter: P H^T R^-1, the limit that Eq. (4) speaks of.

    P is the stable solution of A P + P A^T - P H^T R^-1 H P + W = 0, from the eigenvectors of its Hamiltonian matrix.
    """
    A, W = motion(acceleration_noise)
    H, R = _H(), RANGE_SIGMA_M**2
    values, vectors = np.linalg.eig(np.block([[A.T, -H.T @ H / R], [-W, -A]]))
    stable = vectors[:, values.real < 0]
    P = np.real(stable[8:] @ np.linalg.inv(stable[:8]))
    return np.asarray(P @ H.T / R)


def share(K: FloatArray) -> float:
    """The largest eigenvalue of H K: the share of an innovation that the filter believes."""
    return float(np.abs(np.linalg.eigvals(_H() @ K)).max())


def _H() -> FloatArray:
    H: FloatArray = gps(steps=0).parameters.H[0]
    return H


def _settled(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray) -> FloatArray:
    return gain(steady_prior(Phi, Q, H, R), H, R)


def _position_variance(Phi: FloatArray, Q: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray) -> float:
    kept = np.eye(len(Phi)) - K @ H
    P = steady_state(kept @ Phi, kept @ Q @ kept.T + K @ R @ K.T)
    return float(np.trace(P[POSITION, POSITION]))
