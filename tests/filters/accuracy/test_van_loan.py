"""From continuous time to steps."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from filters.accuracy.van_loan import matrix_exponential


@pytest.mark.parametrize("size", [0.0, 1e-9, 1e-3, 0.1, 1.0, 20.0])
@pytest.mark.parametrize("seed", range(4))
def test_the_exponential_is_that_of_scipy(size: float, seed: int) -> None:
    A = size * np.random.default_rng(seed).normal(size=(6, 6))
    expected = expm(A)
    assert_allclose(matrix_exponential(A), expected, rtol=1e-12, atol=1e-13 * np.abs(expected).max())
