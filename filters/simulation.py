"""A true trajectory and its measurements, from a system model and a seed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.noises import check_noises
from filters.normal import normal
from filters.problem import check_system
from filters.running import running
from filters.seed import check_seed
from filters.system import System
from filters.systems.shaped import shaped


class Truth(NamedTuple):
    """x (steps + 1, n): the true states. measurements (cycles, p): those taken at k = 0, N, 2N, ..."""

    x: FloatArray
    measurements: FloatArray


@running("system")
def simulate_truth(system: System, N: int, x0: FloatArray, P0: FloatArray, inputs: FloatArray, seed: int) -> Truth:
    """Draw an initial state from N(x0, P0), then process and measurement noise as the model has them.

    inputs (steps, m): the noise-free inputs that the filter will be given too.

    Raises:
        ValueError: system is none, or the seed no whole number; f or h of the system gives a value that is not finite,
            or Q or R is no covariance, and the step is named.
    """
    check_system("system", system)
    check_seed(seed)
    random, system = np.random.default_rng(seed), shaped(system)
    steps = len(inputs)
    check_noises(system, range(steps), range(0, steps + 1, N), "numpy")
    x = np.empty((steps + 1, system.states))
    x[0] = x0 + normal(random, P0)
    for j in range(steps):
        system.f(j, x[j], inputs[j], system.parameters, x[j + 1])
        x[j + 1] += normal(random, system.Q(j, system.parameters))
        _check_finite("f", j, x[j], x[j + 1])
    measurements = np.empty((steps // N + 1, system.measurements))
    for cycle, y in enumerate(measurements):
        system.h(cycle * N, x[cycle * N], system.parameters, y)
        y += normal(random, system.R(cycle * N, system.parameters))
        _check_finite("h", cycle * N, x[cycle * N], y)
    return Truth(x, measurements)


def _check_finite(function: str, j: int, x: FloatArray, value: FloatArray) -> None:
    if not np.isfinite(value).all():
        raise ValueError(
            f"step {j}: {function} of the system gives a value that is not finite at the simulated state x = {x}; mend "
            f"the model there, or start elsewhere"
        )
