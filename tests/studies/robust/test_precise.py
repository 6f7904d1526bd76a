"""The robust filter in a hundred digits is the filter, and its steady state what theory says of it."""

from __future__ import annotations

from decimal import localcontext

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.robust.records import Predicted, RobustModel
from filters.robust.run import run
from filters.robust.step import step
from studies.robust import precise
from studies.robust.linear import random_system, sayed, spectral_radius
from studies.robust.precise import as_predictor, following, steady_state
from studies.robust.stability import closed_loop

STARTS = (1e-2, 1e4)


def of_tied_noise(model: RobustModel) -> FloatArray:
    """Magnitudes of the eigenvalues of the system whose one noise is what its uncertain row says."""
    return np.abs(np.linalg.eigvals(model.F - model.G @ model.E_F / model.E_G[0, 0]))


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10_000), noises=st.integers(1, 2), mu=st.sampled_from([1.0, 10.0, np.inf]))
def test_a_step_in_a_hundred_digits_is_the_filters(seed: int, noises: int, mu: float) -> None:
    model = random_system(seed, noises)
    n, p = len(model.F), len(model.H)
    found = step(model, Predicted(np.zeros(n), np.eye(n)), np.zeros(p), np.zeros(n), mu=mu).P
    with localcontext() as context:
        context.prec = precise.DIGITS
        predictor = as_predictor(model, mu)
        exact = following(predictor, np.eye(n, dtype=np.int64).astype(object)).astype(np.float64)
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-6 * max(1.0, np.abs(exact).max()))


def test_without_an_uncertain_row_it_is_the_kalman_filter() -> None:
    model = sayed((0.0, 0.0))
    steady = steady_state(model, np.inf, STARTS)
    assert steady is not None
    by_run = run(model, np.zeros(2), np.eye(2), np.zeros((1000, 1))).P[-1]
    np.testing.assert_allclose(steady.P, by_run, rtol=1e-5)
    np.testing.assert_allclose(steady.closed, closed_loop(model, steady.P, np.inf)[0], atol=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_hundred_digits_lead_to_the_steady_state_of_the_filter(seed: int) -> None:
    """With a finite mu, where P is regular."""
    model = random_system(seed, 1)
    n = len(model.F)
    steady = steady_state(model, 10.0, STARTS)
    assert steady is not None
    by_run = run(model, np.zeros(n), np.eye(n), np.zeros((steady.steps, len(model.H))), mu=10.0).P[-1]
    np.testing.assert_allclose(steady.P, by_run, atol=1e-5 * np.abs(by_run).max())
    np.testing.assert_allclose(steady.closed, closed_loop(model, steady.P, 10.0)[0], atol=1e-9)


@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 160))
def test_where_no_noise_is_left_the_radius_is_that_of_the_tied_system_or_its_inverse(seed: int) -> None:
    """In the limit: eigenvalues that are unstable become their inverses, and P is singular along the others."""
    model = random_system(seed, 1)
    eigenvalues = of_tied_noise(model)
    steady = steady_state(model, np.inf, STARTS)
    assert steady is not None
    assert spectral_radius(steady.closed) == pytest.approx(np.minimum(eigenvalues, 1 / eigenvalues).max(), abs=1e-6)
    unstable = int(np.count_nonzero(eigenvalues > 1))
    sizes = np.linalg.svd(steady.P, compute_uv=False)
    assert (sizes[unstable:] < 1e-5).all()
    assert (sizes[:unstable] > 0).all()


def test_double_precision_stops_where_p_comes_to_nothing_and_a_hundred_digits_do_not() -> None:
    """A filter that was said to have no steady state, for rounding was all that was left of its P."""
    model = random_system(15, 1)
    n = len(model.F)
    assert of_tied_noise(model).max() < 1
    with pytest.raises(ValueError, match="positive semidefinite"):
        run(model, np.zeros(n), np.eye(n), np.zeros((2000, len(model.H))))
    steady = steady_state(model, np.inf, STARTS)
    assert steady is not None
    assert np.abs(steady.P).max() < 1e-5
    assert spectral_radius(steady.closed) == pytest.approx(of_tied_noise(model).max(), abs=1e-6)


def test_a_filter_that_does_not_forget_its_start_has_no_steady_state(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that does not see its state, which neither grows nor decays."""
    monkeypatch.setattr(precise, "LAST", 2**8)
    blind = sayed((0.0, 0.0))._replace(F=np.eye(2), H=np.array([[0.0, 1.0]]))
    assert steady_state(blind, np.inf, STARTS) is None
