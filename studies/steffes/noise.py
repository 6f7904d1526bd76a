"""Steffes (2014), Sec. III.D: what Q' (Eq. 23) and Q'' (Eq. 24) cost in accuracy, where Q is small beside P and where
not.

All is in units that do not depend on those of the states: variances are compared in the direction in which they differ
most.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.delayed import dual_rate
from filters.delayed.low_rate_noise import LowRateNoise
from filters.error_covariance import true_covariance
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from sched_sim.design.timing import Timing

APPROXIMATIONS: tuple[LowRateNoise, ...] = ("sum", "euler")
TIMING = Timing(10, 4, 8)


class Tried(NamedTuple):
    """factors: by which the model's Q is multiplied; cycles: after which its covariances are compared."""

    system: System
    P0: FloatArray
    factors: tuple[float, ...]
    cycles: int


class Approximated(NamedTuple):
    """One approximation on one system.

    share: of Q_{(k-N)->k} in P_{k^-}, the mean over all directions, from 0 to 1; covariance: how far the filter's own
    P_{k^-} is from the right one, as a share of it; estimate: how much larger the standard deviation of its true error
    is than that of the exact filter, as a share. Both in the worst direction.
    """

    system: str
    noise: LowRateNoise
    share: float
    covariance: float
    estimate: float


def tried() -> dict[str, Tried]:
    """Two systems of 9 states: the example, which turns its states over a cycle, and a vehicle's position, velocity and
    accelerometer bias along three axes at 100 Hz, with a position fix in every tenth step."""
    return {
        "turning": Tried(example_system(), np.eye(9), (1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 10.0), 6),
        "inertial": Tried(
            inertial_system(), np.diag(np.repeat([1.0, 0.1, 0.01], 3)) ** 2, (1.0, 10.0, 100.0, 1e3, 1e4), 16
        ),
    }


def inertial_system(
    period_s: float = 0.01, noise: float = 0.02, drift: float = 1e-3, fix_sigma_m: float = 1.0
) -> System:
    """Position (m), velocity (m/s) and accelerometer bias (m/s^2) in three axes; inputs: measured acceleration.

    noise (m/s^2/sqrt(Hz)), drift (m/s^3/sqrt(Hz)): white noise of the accelerometer, random walk of its bias.
    """
    one, nothing = np.eye(3), np.zeros((3, 3))
    moved = 0.5 * period_s**2 * one
    Phi = np.block([[one, period_s * one, -moved], [nothing, one, -period_s * one], [nothing, nothing, one]])
    B = np.vstack([moved, period_s * one, nothing])
    Q = np.diag(np.repeat([0.0, noise**2 * period_s, drift**2 * period_s], 3))
    return linear_system(Phi, B, np.eye(3, 9), Q, fix_sigma_m**2 * one)


def approximations() -> list[Approximated]:
    """Of each system of `tried`, with each of its factors, by each approximation."""
    return [
        one
        for name, (system, P0, factors, cycles) in tried().items()
        for factor in factors
        for one in _approximated(name, with_noise(system, factor), P0, cycles)
    ]


def with_noise(system: System, factor: float) -> System:
    return system._replace(parameters=system.parameters._replace(Q=factor * system.parameters.Q))


def _approximated(name: str, system: System, P0: FloatArray, cycles: int) -> Iterator[Approximated]:
    N = TIMING.N
    steps = cycles * N
    inputs, measurements = np.zeros((steps, system.inputs)), np.zeros((cycles + 1, system.measurements))
    start = np.zeros(system.states)
    runs = {
        noise: dual_rate.run(
            system,
            *(TIMING.N, TIMING.M, TIMING.L),
            start,
            P0,
            inputs,
            measurements,
            low_rate_noise=noise,
            backend="numpy",
        )
        for noise in ("exact", *APPROXIMATIONS)
    }
    gains = np.zeros((len(runs), steps + 1, system.states, system.measurements))
    for of_run, run in zip(gains, runs.values(), strict=True):
        of_run[: len(run.gains) * N : N] = run.gains
    right, true = runs["exact"].P_reference[-1], true_covariance(system, P0, gains).before[:, -1]
    share = float(np.mean(beside(_over_a_cycle(system, steps - N), right)))
    for number, noise in enumerate(APPROXIMATIONS, start=1):
        off = beside(runs[noise].P_reference[-1], right) - 1
        more = np.sqrt(beside(true[number], true[0]).max()) - 1
        yield Approximated(name, noise, *(_digits(value) for value in (share, np.abs(off).max(), more)))


def _digits(value: float) -> float:
    """Three of them, which are the same on every machine."""
    return float(f"{value:.3g}")


def _over_a_cycle(system: System, first: int) -> FloatArray:
    """Q_{first->first+N}, Eq. (18)."""
    x, u, Q = np.zeros(system.states), np.zeros(system.inputs), np.zeros((system.states, system.states))
    for j in range(first, first + TIMING.N):
        Phi = system.F(j, x, u, system.parameters)
        Q = Phi @ Q @ Phi.T + system.Q(j, system.parameters)
    return Q


def beside(a: FloatArray, b: FloatArray) -> FloatArray:
    """Variances of `a` in units of those of `b`, in the directions in which they differ most and least."""
    root = np.linalg.cholesky(b)
    half = np.linalg.solve(root, a)
    ratios: FloatArray = np.linalg.eigvalsh(np.linalg.solve(root, half.T))
    return ratios
