"""Cycles compose: in any grouping, as one after the other, and towards the periodic regime."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from filters.accuracy import Cycles, LinearModel, applied, composed, linear_model, one_cycle, repeated
from filters.accuracy.periodic import steady
from filters.arrays import FloatArray
from tests.filters.accuracy.cases import all_outputs, models, random_model, seen_well

counts = st.integers(0, 12)


def one_by_one(model: LinearModel, N: int, present: list[bool], P: FloatArray) -> FloatArray:
    """Measurement, if there is one, and N steps; for each in turn."""
    for measured in present:
        if measured:
            K = P @ model.H.T @ np.linalg.inv(model.H @ P @ model.H.T + model.R)
            P = P - K @ model.H @ P
        for _ in range(N):
            P = model.Phi @ P @ model.Phi.T + model.Q
    return P


def assert_equal(found: FloatArray, expected: FloatArray, tolerance: float = 1e-10) -> None:
    np.testing.assert_allclose(found, expected, rtol=tolerance, atol=tolerance * np.abs(expected).max())


@given(models(), st.integers(1, 6), st.lists(st.booleans(), max_size=8))
def test_a_composition_is_one_cycle_after_the_other_with_some_measurements_missing(
    model: LinearModel, N: int, present: list[bool]
) -> None:
    n = model.states
    all_of_them = Cycles(np.eye(n), np.zeros((n, n)), np.zeros((n, n)))
    for measured in present:
        all_of_them = composed(all_of_them, one_cycle(model, N, measured=measured))
    P = 2.0 * np.eye(n)
    assert_equal(applied(all_of_them, P), one_by_one(model, N, present, P))


@given(st.lists(st.tuples(st.integers(0, 1000), st.integers(1, 4), st.booleans()), min_size=3, max_size=3))
def test_composition_is_associative(drawn: list[tuple[int, int, bool]]) -> None:
    a, b, c = (one_cycle(random_model(seed, 1.05, 3, 1), N, measured=measured) for seed, N, measured in drawn)
    for found, expected in zip(composed(composed(a, b), c), composed(a, composed(b, c)), strict=True):
        assert_equal(found, expected)


@given(models(), st.integers(1, 4), counts)
def test_repeated_by_doubling_is_one_after_the_other(model: LinearModel, N: int, times: int) -> None:
    P = np.eye(model.states)
    assert_equal(applied(repeated(one_cycle(model, N), times), P), one_by_one(model, N, [True] * times, P))


@given(models(), st.integers(1, 6))
def test_many_cycles_lead_to_the_periodic_regime(model: LinearModel, N: int) -> None:
    assume(seen_well(model, N))
    found = applied(repeated(one_cycle(model, N), 2**20), np.eye(model.states))
    assert_equal(found, steady(model, all_outputs(model), N, 0).before[0], 1e-9)


def test_what_is_known_exactly_stays_so_without_noise() -> None:
    model = linear_model([[1, 1], [0, 1]], np.zeros((2, 2)), [[1, 0]], [[1]])
    np.testing.assert_array_equal(applied(repeated(one_cycle(model, 5), 9), np.zeros((2, 2))), np.zeros((2, 2)))


def test_at_a_stated_time_a_variance_without_bound_has_a_value() -> None:
    """A random walk that nothing measures, beside one that is."""
    model = linear_model(np.eye(2), np.diag([0.01, 0.02]), [[1, 0]], [[1]])
    after = applied(repeated(one_cycle(model, 10), 1000), np.eye(2))
    assert after[1, 1] == pytest.approx(1 + 0.02 * 10_000, rel=1e-12)
    assert after[0, 0] == pytest.approx(0.370156211872, rel=1e-11)


@pytest.mark.parametrize("times", [-1, 0.5, True])
def test_a_number_of_times_that_is_none_is_refused(times: int) -> None:
    with pytest.raises(ValueError, match=r"times=.* must be a whole number, at least 0"):
        repeated(one_cycle(random_model(0, 0.9, 2, 1), 3), times)
