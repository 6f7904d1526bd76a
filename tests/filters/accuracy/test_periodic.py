"""The closed form is what the engine finds by replaying cycles, what conditioning gives, and what SciPy solves."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.linalg import solve_discrete_are

from filters.accuracy import LinearModel, latest_landing, linear_model, lossless, lossless_each
from filters.accuracy.cyclic.engine import regime
from filters.accuracy.cyclic.gain import over_cycle, settled_gain
from filters.accuracy.cyclic.methods import carried, replayed, undelayed
from filters.accuracy.periodic import mean, steady, worst
from filters.arrays import FloatArray
from tests.filters.accuracy.cases import CV, all_outputs, conditioned, models, seen_well

periods = st.integers(1, 8)
landings = st.integers(0, 20)


def by_step(model: LinearModel, N: int, L: int) -> FloatArray:
    """The closed form's variance in each step of a cycle, from that of a measurement on: a = L + (r - L) mod N."""
    variances = steady(model, all_outputs(model), N, N + L).variances[0]
    steps = np.arange(N)
    return np.asarray(variances[L + (steps - L) % N])


@given(models(), periods, landings)
def test_every_lossless_method_is_as_accurate_as_the_age_says(model: LinearModel, N: int, L: int) -> None:
    assume(seen_well(model, N))
    K = settled_gain(model, N)
    for method in (replayed, carried):
        found = regime(method(model, all_outputs(model), N, L, K))
        np.testing.assert_allclose(found.variances, by_step(model, N, L), rtol=1e-12)


@given(models(), periods, landings)
def test_worst_rms_and_jump_are_those_of_the_engine(model: LinearModel, N: int, L: int) -> None:
    assume(seen_well(model, N))
    found = regime(carried(model, all_outputs(model), N, L, settled_gain(model, N)))
    expected = lossless(model, all_outputs(model), N, L)
    np.testing.assert_allclose(expected.worst**2, found.variances.max(), rtol=1e-12)
    np.testing.assert_allclose(expected.rms**2, found.variances.mean(), rtol=1e-12)
    np.testing.assert_allclose(expected.jump**2, found.moves.max(), rtol=1e-10)


@given(models(), periods)
def test_without_delay_it_is_the_standard_filter(model: LinearModel, N: int) -> None:
    assume(seen_well(model, N))
    found = regime(undelayed(model, all_outputs(model), N, settled_gain(model, N)))
    np.testing.assert_allclose(found.variances, by_step(model, N, 0), rtol=1e-12)


@given(models(), st.integers(1, 5), st.integers(0, 9), st.integers(1, 3))
def test_it_is_the_joint_gaussian_conditioned_on_what_was_measured(
    model: LinearModel, N: int, age: int, cycles: int
) -> None:
    assume(seen_well(model, N))
    found = steady(model, all_outputs(model), N, age)
    expected = conditioned(model, found.before[0], N, age, cycles)
    np.testing.assert_allclose(found.variances[0, age], np.trace(expected), rtol=1e-11)


@given(models(), periods)
def test_it_solves_the_riccati_equation_as_scipy_does(model: LinearModel, N: int) -> None:
    Phi, Q = over_cycle(model, N)
    assume(np.linalg.cond(Phi) < 1e6 and seen_well(model, N))
    expected = solve_discrete_are(Phi.T, model.H.T, Q, model.R)
    found = steady(model, all_outputs(model), N, 0).before[0]
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-8 * np.abs(expected).max())


@given(models(), st.integers(0, 9))
def test_units_change_nothing(model: LinearModel, decade: int) -> None:
    """The states in other units, one of them by a factor of ten thousand million."""
    assume(seen_well(model, 4))
    units = np.ones(model.states)
    units[decade % model.states] = 10.0 ** (10 if decade % 2 else -10)
    scaled = linear_model(
        model.Phi * units[:, None] / units, model.Q * np.outer(units, units), model.H / units, model.R
    )
    for L in (0, 3, 7):
        found, expected = lossless(scaled, np.diag(1 / units), 4, L), lossless(model, all_outputs(model), 4, L)
        np.testing.assert_allclose(found[4:10:1][:4], expected[4:10:1][:4], rtol=1e-9)


@given(st.lists(st.floats(0, 100), min_size=12, max_size=40), st.integers(1, 12))
def test_the_window_slides(values: list[float], N: int) -> None:
    variances = np.array(values)
    first = np.arange(len(values) - N + 1)
    windows = [variances[L : L + N] for L in first]
    np.testing.assert_array_equal(worst(variances, N, first), [window.max() for window in windows])
    np.testing.assert_allclose(mean(variances, N, first), [window.mean() for window in windows], rtol=1e-9, atol=1e-12)


def test_several_landings_at_once_are_those_one_by_one() -> None:
    together = lossless_each(CV, [0, 1], 10, [0, 4, 8, 14])
    for L, found in zip([0, 4, 8, 14], together, strict=True):
        alone = lossless(CV, [0, 1], 10, L)
        np.testing.assert_allclose(found[4:8], alone[4:8], rtol=1e-13)
        assert (found.N, found.L, found.oldest, found.mean_age) == (10, L, L + 9, L + 4.5)


def test_what_is_too_large_for_a_number_is_infinite() -> None:
    """A mode that doubles in a step, thousands of steps after the last measurement."""
    model = linear_model([[2]], [[1]], [[1]], [[1]])
    assert lossless(model, [0], 1, 2000).worst == np.inf
    found = latest_landing(model, [0], 1, 1e9, 0, most=3000)
    assert (found.L, found.bounded) == (29, True)
