"""Linear systems: the closed loop that is found, and what makes a filter stable and convergent or not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.robust.records import Predicted
from filters.robust.run import run
from filters.robust.step import step
from studies.robust.linear import CASES, KALMAN, growing, random_system, sayed, spectral_radius
from studies.robust.stability import STEPS, closed_loop, convergence, sample, stability


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_a_step_is_its_closed_loop_and_its_gain(seed: int) -> None:
    model, random = random_system(seed, 1), np.random.default_rng(seed)
    n, p = len(model.F), len(model.H)
    x, y, P = random.normal(size=n), random.normal(size=p), np.eye(n)
    closed, gain = closed_loop(model, P, 10.0)
    found = step(model, Predicted(x, P), y, np.zeros(n), mu=10.0).x
    np.testing.assert_allclose(found, closed @ x + gain @ y, atol=1e-9 * np.abs(found).max())


def test_of_the_kalman_filter_the_closed_loop_is_f_less_the_gain_times_h() -> None:
    """So that its error does not depend on the state, which that of the robust filter does."""
    certain, uncertain = growing((0.0, 0.0)), growing()
    closed, gain = closed_loop(certain, np.eye(2), np.inf)
    np.testing.assert_allclose(closed, certain.F - gain @ certain.H, atol=1e-12)
    closed, gain = closed_loop(uncertain, np.eye(2), np.inf)
    assert np.abs(uncertain.F - gain @ uncertain.H - closed).max() > 0.1


def test_the_filters_of_an_unstable_system_are_stable_and_only_the_kalman_filters_error_is_bounded() -> None:
    assert spectral_radius(growing().F) > 1
    for case in CASES[3:5]:
        found = stability(case)
        assert found.radius < 1
        assert found.of_system == pytest.approx(1.05)
        assert (found.error[1] < 1.01 * found.error[0]) == (case.name == KALMAN)


def test_where_f_is_wrong_the_robust_filters_of_sayeds_example_are_better_and_else_the_kalman_filter() -> None:
    """By another program, to stationary errors of 26.49, 23.05 and 20.66 dB, and 19.32, 19.81 and 20.09."""
    found = [stability(case) for case in CASES[:3]]
    np.testing.assert_allclose([20 * np.log10(each.wrong) for each in found], [26.49, 23.05, 20.66], atol=0.1)
    np.testing.assert_allclose([20 * np.log10(each.error[1]) for each in found], [19.32, 19.81, 20.09], atol=0.02)


@pytest.mark.parametrize(("mu", "noises"), [(10.0, 1), (np.inf, 2), (np.inf, 1)])
def test_random_systems_are_stable_and_convergent_in_the_limit_too(mu: float, noises: int) -> None:
    """Also where P comes to be singular, along what decays by itself."""
    found = sample("", mu, noises, systems=8)
    assert found.kept == found.systems
    assert found.radius < 1
    assert found.stopped == 0 or (mu, noises) == (np.inf, 1)


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_with_a_finite_mu_p_forgets_its_start(seed: int) -> None:
    model = random_system(seed, 1)
    n, p = len(model.F), len(model.H)
    small, large = (
        run(model, np.zeros(n), start * np.eye(n), np.zeros((200, p)), mu=10.0).P[-1] for start in (1e-2, 1e4)
    )
    np.testing.assert_allclose(small, large, atol=1e-6 * np.abs(small).max())
    assert spectral_radius(closed_loop(model, small, 10.0)[0]) < 1


@pytest.mark.parametrize("seed", range(6))
def test_with_an_infinite_mu_one_uncertain_row_ties_one_noise_down(seed: int) -> None:
    """A hundredth of hardly any P becomes a hundredth; with two noises one is left over, and P is what it adds."""

    def after(noises: int, start: float) -> float:
        model = random_system(seed, noises)
        n, p = len(model.F), len(model.H)
        return float(np.abs(step(model, Predicted(np.zeros(n), start * np.eye(n)), np.zeros(p), np.zeros(n)).P).max())

    assert after(1, 1e-8) == pytest.approx(100 * after(1, 1e-10), rel=0.01)
    assert after(2, 1e-8) == pytest.approx(after(2, 1e-10), rel=0.01)


def test_curves() -> None:
    """Sayed's example is one of those that are drawn, and estimates come together as its closed loop says."""
    case = CASES[1]
    np.testing.assert_array_equal(case.model.E_F, sayed().E_F)
    shown = convergence(case)
    assert shown.largest.shape == (3, STEPS + 1)
    np.testing.assert_allclose(shown.largest[:, 0], [1e-2, 1.0, 1e4])
    np.testing.assert_allclose(shown.largest[:, -1], shown.largest[0, -1], rtol=1e-4)
    assert shown.apart[0] == 1
    assert (shown.apart[-1] / shown.apart[-21]) ** (1 / 20) == pytest.approx(0.891, abs=0.001)
