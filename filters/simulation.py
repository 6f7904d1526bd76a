"""A true trajectory and its measurements, from a system model and a seed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.systems.system import System


class Truth(NamedTuple):
    """x (steps + 1, n): the true states. measurements (cycles, p): those taken at k = 0, N, 2N, ..."""

    x: FloatArray
    measurements: FloatArray


def simulate_truth(system: System, N: int, x0: FloatArray, P0: FloatArray, inputs: FloatArray, seed: int) -> Truth:
    """Draw an initial state from N(x0, P0), then process and measurement noise as the model has them.

    inputs (steps, m): the noise-free inputs that the filter will be given too.
    """
    random = np.random.default_rng(seed)
    steps = len(inputs)
    x = np.empty((steps + 1, system.states))
    x[0] = x0 + _draw(random, P0)
    for j in range(steps):
        system.f(j, x[j], inputs[j], system.parameters, x[j + 1])
        x[j + 1] += _draw(random, system.Q(j, system.parameters))
    measurements = np.empty((steps // N + 1, system.measurements))
    for cycle, y in enumerate(measurements):
        system.h(cycle * N, x[cycle * N], system.parameters, y)
        y += _draw(random, system.R(cycle * N, system.parameters))
    return Truth(x, measurements)


def _draw(random: np.random.Generator, covariance: FloatArray) -> FloatArray:
    return random.multivariate_normal(np.zeros(len(covariance)), covariance, method="eigh")
