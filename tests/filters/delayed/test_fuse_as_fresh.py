"""The baseline: right without delay, biased by what moved meanwhile with one."""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.delayed import fuse_as_fresh, standard
from filters.history import History
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from tests.strategies import problem

PHI = np.array([[1.0, 1.0], [0.0, 1.0]])
Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
CONSTANT_VELOCITY = linear_system(PHI, np.zeros((2, 0)), np.array([[1.0, 0.0]]), Q, np.eye(1))


def test_without_delay_it_is_the_standard_filter() -> None:
    data = problem(example_system(4, 2, 2, seed=5), 5, 0, 0, 17, seed=2)
    for found, expected in zip(fuse_as_fresh.run(*data), standard.run(*data), strict=True):
        np.testing.assert_array_equal(found, expected)


def moving_at_one_unit_a_step(N: int, M: int, steps: int) -> tuple[History, FloatArray]:
    """The run, and its error: nothing but the delay can make one."""
    truth = np.column_stack([np.arange(steps + 1.0), np.ones(steps + 1)])
    seen = truth[::N, :1]
    found = fuse_as_fresh.run(CONSTANT_VELOCITY, N, M, M, np.zeros(2), np.eye(2), np.empty((steps, 0)), seen)
    return found, found.x - truth


@pytest.mark.parametrize(("N", "M"), [(10, 4), (10, 10), (7, 1)])
def test_it_lags_by_what_moved_meanwhile(N: int, M: int) -> None:
    _, error = moving_at_one_unit_a_step(N, M, 60 * N)
    np.testing.assert_allclose(error[-N:], np.tile([-float(M), 0.0], (N, 1)), rtol=0, atol=1e-9)


def test_what_it_believes_is_what_a_filter_without_delay_may() -> None:
    """Golden: standard deviation of the position in the step before an update, N = 10: no output is worse."""
    found, _ = moving_at_one_unit_a_step(10, 4, 600)
    P = found.P_reference[-1]
    for _ in range(3):
        P = PHI @ P @ PHI.T + Q
    assert np.sqrt(P[0, 0]) == pytest.approx(3.0236226199, abs=1e-10)


def test_a_measurement_that_arrives_as_the_next_is_taken_is_lost_with_its_own_row() -> None:
    data = problem(example_system(4, 2, 2, seed=5), 5, 5, 5, 17, seed=2)
    lost = [None, *data.measurements[1:]]
    assert np.isnan(fuse_as_fresh.run(*data._replace(measurements=lost)).innovations[0]).all()
    found = fuse_as_fresh.run(*data._replace(measurements=lost)).x
    without = standard.run(*data._replace(measurements=data.measurements[:0])).x
    np.testing.assert_allclose(found[:10], without[:10], rtol=1e-12)
    assert np.abs(found[10] - without[10]).max() > 1e-3
