"""The true error covariance against the filter's own, simulated errors, and a closed form."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters import multirate_gain
from filters.delayed import standard
from filters.error_covariance import true_covariance
from filters.system import System
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from tests.strategies import problem, seeds, systems


@given(system=systems(), steps=st.integers(0, 12), seed=seeds)
def test_with_the_optimal_gain_it_is_the_filters_own(system: System, steps: int, seed: int) -> None:
    data = problem(system, 1, 0, 0, steps, seed)
    found = standard.run(*data, backend="numpy")
    true = true_covariance(system, data.P0, found.gains)
    np.testing.assert_allclose(true.before, found.P_reference, rtol=1e-9, atol=1e-9)


def test_filters_side_by_side() -> None:
    system = example_system(3, 1, 2, seed=1)
    gains = 0.1 * np.random.default_rng(0).normal(size=(2, 4, 6, 3, 2))
    found = true_covariance(system, np.eye(3), gains)
    for index in np.ndindex(2, 4):
        alone = true_covariance(system, np.eye(3), gains[index])
        np.testing.assert_allclose(found.before[index], alone.before)
        np.testing.assert_allclose(found.after[index], alone.after)


def test_the_errors_of_simulated_filters_have_it() -> None:
    """8,000 filters with the multirate gain; each entry of their covariance is within five of its standard errors."""
    n, steps, runs = 3, 7, 8000
    system = linear_system([[1.0, 0.5], [0.0, 0.9]], [[0.0], [0.0]], [[1.0, 0.0]], np.diag([0.1, 0.4]), [[0.7]])
    P0 = np.array([[2.0, 0.5], [0.5, 1.0]])
    nothing = np.zeros((steps, 1)), np.zeros((steps + 1, 1))
    gains = multirate_gain.run(system, n, np.zeros(2), P0, *nothing, L=2, backend="numpy").gains
    true = true_covariance(system, P0, gains)

    random = np.random.default_rng(1)
    Phi, _, H, Q, R = (matrix[0] for matrix in system.parameters)
    errors = random.multivariate_normal(np.zeros(2), P0, size=runs)
    for j in range(steps + 1):
        if j > 0:
            errors = errors @ Phi.T + random.multivariate_normal(np.zeros(2), Q, size=runs)
        measured = -errors @ H.T + random.multivariate_normal(np.zeros(1), R, size=runs)  # y - H x^-
        errors = errors + measured @ gains[j].T
        P = true.after[j]
        standard_error = np.sqrt((P**2 + np.outer(np.diag(P), np.diag(P))) / runs)
        assert np.all(np.abs(errors.T @ errors / runs - P) < 5 * standard_error)


@pytest.mark.parametrize("gain", [0.02, 0.3, 1.0, 1.7])
def test_scalar_steady_state(gain: float) -> None:
    """P = (1 - K)^2 (P + Q) + K^2 R, solved for P."""
    q, r = 0.3, 2.0
    system = linear_system([[1.0]], [[0.0]], [[1.0]], [[q]], [[r]])
    found = true_covariance(system, np.eye(1), np.full((2000, 1, 1), gain)).after[-1, 0, 0]
    kept = (1 - gain) ** 2
    assert found == pytest.approx((kept * q + gain**2 * r) / (1 - kept), rel=1e-12)


def test_shapes_are_checked() -> None:
    system = example_system(3, 1, 2)
    with pytest.raises(ValueError, match=r"gains \(5, 2, 3\), needed is \(..., steps \+ 1, 3, 2\)"):
        true_covariance(system, np.eye(3), np.zeros((5, 2, 3)))
    with pytest.raises(ValueError, match=r"P0 has shape \(2, 2\), needed is \(3, 3\)"):
        true_covariance(system, np.eye(2), np.zeros((5, 3, 2)))
