"""The compiled filter against FilterPy's `KalmanFilter`: 9 states, 3 inputs, 3 measurements, an update every step."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from filterpy.kalman import KalmanFilter

from benchmarks.timing import Result, seconds
from filters import standard
from filters.simulation import simulate_truth
from filters.systems.example import example_system
from filters.systems.linear import linear_system

STEPS = 5000


def results() -> Iterator[Result]:
    varying = example_system(9, 3, 3).parameters
    Phi, B, H, Q, R = (matrices[0] for matrices in varying)
    system = linear_system(Phi, B, H, Q, R)
    x0, P0 = np.zeros(9), np.eye(9)
    inputs = np.random.default_rng(1).normal(size=(STEPS, 3))
    measurements = simulate_truth(system, 1, x0, P0, inputs, 2).measurements

    def ours() -> np.ndarray:
        return standard.run(system, 1, 0, 0, x0, P0, inputs, measurements, update="short", backend="compiled").x

    def theirs() -> np.ndarray:
        kalman = KalmanFilter(dim_x=9, dim_z=3, dim_u=3)
        kalman.F, kalman.B, kalman.H, kalman.Q, kalman.R, kalman.P = Phi, B, H, Q, R, P0.copy()
        kalman.x = x0.copy()
        found = []
        for step in range(STEPS + 1):
            if step:
                kalman.predict(inputs[step - 1])
            kalman.update(measurements[step])
            found.append(kalman.x.copy())
        return np.array(found)

    np.testing.assert_allclose(ours(), theirs(), rtol=1e-9, atol=1e-9)
    yield Result("filter step: faster than FilterPy's KalmanFilter", seconds(theirs, 2) / seconds(ours), 30)
