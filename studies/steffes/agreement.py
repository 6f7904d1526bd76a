"""Steffes (2014), Sec. IV: all filters give the same state when j is not in [m, l - 1], and the same P_{k^-}."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.delayed import dual_rate, larsen, recalculate
from filters.history import History
from filters.simulation import simulate_truth
from filters.system import System
from filters.systems.example import example_system
from sched_sim.design.timing import Timing

CYCLES = 4
BINARY_PLACES = 10
FLOOR = float(np.finfo(np.float64).eps)
"""The spacing of numbers as large as the largest state: what is less cannot be told from rounding."""


class Agreement(NamedTuple):
    """How far two methods are from the dual-rate filter, in units of the largest number of its states and of its P.

    state: by method, (steps + 1,), the largest difference of any state; covariance: by method, (cycles + 1,), that of
    any entry of P_{k^-}; waiting (steps + 1,): whether j is in [m, l - 1] of some cycle.
    """

    timing: Timing
    state: Mapping[str, FloatArray]
    covariance: Mapping[str, FloatArray]
    waiting: np.ndarray[tuple[int], np.dtype[np.bool_]]

    @property
    def elsewhere(self) -> float:
        """The largest difference of states outside [m, l - 1]."""
        return max(float(apart[~self.waiting].max()) for apart in self.state.values())

    @property
    def while_waiting(self) -> tuple[float, float]:
        """The least and the largest difference of states inside it."""
        inside = [apart[self.waiting] for apart in self.state.values()]
        return min(float(one.min()) for one in inside), max(float(one.max()) for one in inside)

    @property
    def of_covariance(self) -> float:
        """The largest difference of P_{k^-}."""
        return max(float(apart.max()) for apart in self.covariance.values())


def agreement(timing: Timing, cycles: int = CYCLES, seed: int = 1) -> Agreement:
    """Of the three filters on one record of the example's size, 9 states, 3 inputs and 3 measurements.

    Run as plain loops on numbers of few binary places, so that rounding is the same on every machine.
    """
    N, M, L = timing.N, timing.M, timing.L
    system, random = _short_numbers(example_system()), np.random.default_rng(seed)
    x0, P0 = _short(random.normal(size=system.states)), np.eye(system.states)
    inputs = _short(random.normal(size=(cycles * N, system.inputs)))
    measurements = _short(simulate_truth(system, N, x0, P0, inputs, seed).measurements)
    dual = dual_rate.run(system, N, M, L, x0, P0, inputs, measurements)
    others: dict[str, History] = {
        "larsen": larsen.run(system, N, M, L, x0, P0, inputs, measurements),
        "recalculate": recalculate.run(system, N, M, L, x0, P0, inputs, measurements),
    }
    steps = np.arange(len(inputs) + 1)
    largest, largest_P = np.abs(dual.x).max(), np.abs(dual.P_reference).max()
    return Agreement(
        timing,
        {name: np.abs(one.x - dual.x).max(axis=1) / largest for name, one in others.items()},
        {name: np.abs(one.P_reference - dual.P_reference).max(axis=(1, 2)) / largest_P for name, one in others.items()},
        (steps >= M) & ((steps - M) % N < L - M),
    )


def _short_numbers(system: System) -> System:
    matrices = system.parameters
    return system._replace(parameters=type(matrices)(*map(_short, matrices)))


def _short(values: FloatArray) -> FloatArray:
    rounded: FloatArray = np.round(values * 2**BINARY_PLACES) / 2**BINARY_PLACES
    return rounded
