"""Laws of how much a gain changes: nothing where it is constant, the same in whatever units the states are."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from studies.multirate.accuracy import optimal_gains, random_walk
from studies.multirate.constancy import changes, constant_from


def test_a_constant_gain_does_not_change() -> None:
    assert changes(np.ones((30, 2, 3)), 5).tolist() == [0.0] * 25


@given(st.floats(0.1, 0.9), st.integers(1, 9))
def test_a_gain_that_decays_changes_by_the_same_share_in_each_step(rate: float, n: int) -> None:
    gains = rate ** np.arange(20.0)[:, np.newaxis, np.newaxis] * np.array([[1.0, 2.0], [3.0, -1.0]])
    np.testing.assert_allclose(changes(gains, n), rate**-n - 1)


@given(st.floats(1e-6, 1e6))
def test_units_do_not_matter(scale: float) -> None:
    gains = np.random.default_rng(1).normal(size=(20, 2, 2))
    np.testing.assert_allclose(changes(gains * np.array([[scale], [1.0]]), 3), changes(gains, 3))


def test_the_scalar_gain_halves_at_first_and_then_is_constant() -> None:
    """From a large P, K_k is 1 / (k + 1) while noise says nothing: in step 0, 5 steps change it by five times."""
    change = changes(optimal_gains(random_walk(0.01)), 5)
    assert 0.8 < change[0] * optimal_gains(random_walk(0.01))[5, 0, 0] < 1.0
    assert change[-1] < 1e-12
    assert change[constant_from(change) - 1] > 0.05 >= change[constant_from(change) :].max()
