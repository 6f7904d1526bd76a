"""The compiled filter against FilterPy's `KalmanFilter`: 9 states, 3 inputs, 3 measurements, an update each step.

Both filter a whole record in their own loop and keep the estimate and covariance of every step.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from filterpy.kalman import KalmanFilter

from benchmarks.timing import Result, times_faster
from filters.arrays import FloatArray
from filters.delayed import standard
from filters.simulation import simulate_truth
from filters.systems.example import example_system
from filters.systems.linear import linear_system

STEPS = 5000


def results() -> Iterator[Result]:
    Phi, B, H, Q, R = (matrices[0] for matrices in example_system(9, 3, 3).parameters)
    system = linear_system(Phi, B, H, Q, R)
    x0, P0 = np.zeros(9), np.eye(9)
    inputs = np.random.default_rng(1).normal(size=(STEPS, 3))
    measurements = simulate_truth(system, 1, x0, P0, inputs, 2).measurements

    def ours() -> FloatArray:
        return standard.run(system, 1, 0, 0, x0, P0, inputs, measurements, update="short", backend="compiled").x

    def theirs() -> FloatArray:
        kalman = KalmanFilter(dim_x=9, dim_z=3, dim_u=3)
        kalman.F, kalman.B, kalman.H, kalman.Q, kalman.R = Phi, B, H, Q, R
        kalman.x, kalman.P = x0.copy(), P0.copy()
        means, _, _, _ = kalman.batch_filter(measurements, us=[*inputs, np.zeros(3)], update_first=True)
        return np.asarray(means).reshape(STEPS + 1, 9)

    np.testing.assert_allclose(ours(), theirs(), rtol=1e-9, atol=1e-9)
    yield Result("filter step: faster than FilterPy's KalmanFilter", times_faster(ours, theirs), 30)
