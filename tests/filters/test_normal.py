"""Draws have the covariance asked for, and hang on its last digits no more than by their own."""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.normal import normal

COVARIANCES = [np.eye(4), np.diag([4.0, 0.0, 1.0]), np.array([[4.0, 2.0], [2.0, 1.0]]), np.zeros((2, 2))]


@pytest.mark.parametrize("covariance", COVARIANCES)
def test_draws_have_the_covariance_also_where_it_is_singular(covariance: FloatArray) -> None:
    random = np.random.default_rng(0)
    draws = np.array([normal(random, covariance) for _ in range(20_000)])
    np.testing.assert_allclose(draws.T @ draws / len(draws), covariance, atol=0.02 * 4)


@pytest.mark.parametrize("seed", range(5))
def test_a_draw_with_equal_variances_does_not_turn_with_the_last_digits_of_the_covariance(seed: int) -> None:
    wrong = np.random.default_rng(seed).uniform(-1e-15, 1e-15, (6, 6))
    one, other = (
        normal(np.random.default_rng(7), covariance) for covariance in (np.eye(6), np.eye(6) + wrong + wrong.T)
    )
    np.testing.assert_allclose(one, other, rtol=0, atol=1e-13)
