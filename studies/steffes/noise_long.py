"""Steffes (2014), Sec. III.D: what Q' and Q'' cost at the most, in many cycles one after another.

By the covariances alone, cycle by cycle, without the filters' own code.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.delayed.low_rate_noise import LowRateNoise
from filters.system import System
from studies.steffes.noise import APPROXIMATIONS, TIMING, beside, tried, with_noise

CYCLES = 100


class Worst(NamedTuple):
    """As in `Approximated`: the largest of all systems, factors and cycles, as a share."""

    covariance: float
    estimate: float


def worst(cycles: int = CYCLES) -> Mapping[LowRateNoise, Worst]:
    """Of each approximation."""
    found = [
        costs
        for system, P0, factors, _ in tried().values()
        for factor in factors
        for costs in over_cycles(with_noise(system, factor), P0, cycles)
    ]
    return {
        noise: Worst(*(max(of) for of in zip(*(costs[noise] for costs in found), strict=True)))
        for noise in APPROXIMATIONS
    }


def over_cycles(system: System, P0: FloatArray, cycles: int) -> Iterator[Mapping[LowRateNoise, Worst]]:
    """At the end of each cycle, the first at k = N."""
    believed: dict[LowRateNoise, FloatArray] = dict.fromkeys(("exact", *APPROXIMATIONS), P0)
    true, unit, x = dict(believed), np.eye(system.states), np.zeros(system.states)
    for k in range(0, cycles * TIMING.N, TIMING.N):
        H, R = system.H(k, x, system.parameters), system.R(k, system.parameters)
        Phi, noises = _cycle(system, k)
        for noise, P in believed.items():
            K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
            kept = unit - K @ H
            true[noise] = Phi @ (kept @ true[noise] @ kept.T + K @ R @ K.T) @ Phi.T + noises["exact"]
            believed[noise] = Phi @ kept @ P @ Phi.T + noises[noise]
        yield {
            noise: Worst(
                float(np.abs(beside(believed[noise], believed["exact"]) - 1).max()),
                float(np.sqrt(beside(true[noise], true["exact"]).max()) - 1),
            )
            for noise in APPROXIMATIONS
        }


def _cycle(system: System, k: int) -> tuple[FloatArray, dict[LowRateNoise, FloatArray]]:
    """Phi and Q from k to k + N: Eqs (16), (18), (23), (24)."""
    x, u = np.zeros(system.states), np.zeros(system.inputs)
    Phi, exact = np.eye(system.states), np.zeros((system.states, system.states))
    steps = [system.Q(j, system.parameters) for j in range(k, k + TIMING.N)]
    for j, Q in enumerate(steps, start=k):
        F = system.F(j, x, u, system.parameters)
        Phi, exact = F @ Phi, F @ exact @ F.T + Q
    half = TIMING.N // 2
    first, second = sum(steps[:half], 0 * exact), sum(steps[half:], 0 * exact)
    return Phi, {"exact": exact, "sum": first + second, "euler": second + Phi @ first @ Phi.T}
