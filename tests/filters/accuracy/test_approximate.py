"""Gains that are not those of the true model, and no gain at all: what the engine finds by replaying cycles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from filters.accuracy import (
    LinearModel,
    discarded,
    linear_model,
    lossless,
    with_divided_gain,
    with_low_rate_noise,
    with_wrong_noise,
)
from filters.accuracy.cyclic.engine import Regime, regime
from filters.accuracy.cyclic.gain import over_cycle, settled_gain
from filters.accuracy.cyclic.methods import carried, undelayed
from filters.accuracy.gains import with_assumed
from filters.accuracy.outcome import Accuracy
from filters.arrays import FloatArray
from filters.error_covariance import true_covariance
from filters.multirate_gain import run as run_multirate
from filters.systems.linear import linear_system
from tests.filters.accuracy.cases import CV, all_outputs, models, seen_well

periods = st.integers(1, 8)
landings = st.integers(0, 20)


def assert_equal(found: Accuracy, engine: Regime) -> None:
    if engine.radius > 0.5:  # of what dies out at once, the stack hides the rest in its rounding
        assert found.radius == pytest.approx(engine.radius, rel=1e-6)
    if not engine.radius < 1.0:
        assert (found.verdict, found.worst, found.rms, found.total) == ("unstable", np.inf, np.inf, np.inf)
        return
    assert found.verdict == "approximate"
    np.testing.assert_allclose(found.worst**2, engine.variances.max(), rtol=1e-11)
    np.testing.assert_allclose(found.rms**2, engine.variances.mean(), rtol=1e-11)
    np.testing.assert_allclose(found.jump**2, engine.moves.max(), rtol=1e-9)


def summed(model: LinearModel, N: int) -> FloatArray:
    """Eq. (23), as a sum."""
    return np.asarray(sum(model.Q for _ in range(N)))


def halved(model: LinearModel, N: int) -> FloatArray:
    """Eq. (24), as two sums."""
    Phi = over_cycle(model, N)[0]
    first, second = np.zeros_like(model.Q), np.zeros_like(model.Q)
    for step in range(N):
        if step < N // 2:
            first += model.Q
        else:
            second += model.Q
    return np.asarray(Phi @ first @ Phi.T + second)


@pytest.mark.parametrize(("name", "noise"), [("sum", summed), ("euler", halved)])
@given(model=models(), N=periods, L=landings)
def test_low_rate_noise(
    name: str, noise: Callable[[LinearModel, int], FloatArray], model: LinearModel, N: int, L: int
) -> None:
    assume(seen_well(model, N))
    K = settled_gain(model, N, noise(model, N))
    engine = regime(carried(model, all_outputs(model), N, L, K))
    assume(abs(engine.radius - 1.0) > 1e-3)
    assert_equal(with_low_rate_noise(model, all_outputs(model), N, L, name), engine)  # type: ignore[arg-type]  # it is one of the two


@given(models(), periods, landings, st.sampled_from([1e-3, 0.1, 1.0, 10.0, 1e3]))
def test_a_wrong_measurement_noise(model: LinearModel, N: int, L: int, factor: float) -> None:
    assume(seen_well(model, N))
    K = settled_gain(model, N, R=factor * model.R)
    engine = regime(carried(model, all_outputs(model), N, L, K))
    assume(abs(engine.radius - 1.0) > 1e-3)
    assert_equal(with_wrong_noise(model, all_outputs(model), N, L, factor * model.R), engine)


@given(models(), periods, landings)
def test_nothing_beats_the_true_noises(model: LinearModel, N: int, L: int) -> None:
    best = lossless(model, all_outputs(model), N, L)
    for found in (
        with_low_rate_noise(model, all_outputs(model), N, L, "sum"),
        with_wrong_noise(model, all_outputs(model), N, L, 4 * model.R),
    ):
        assert found.worst >= best.worst * (1 - 1e-9)
        assert found.no_delay == pytest.approx(best.no_delay, rel=1e-12)


@given(models(), periods, landings)
def test_a_wrong_noise_that_is_the_true_one_loses_nothing(model: LinearModel, N: int, L: int) -> None:
    best = lossless(model, all_outputs(model), N, L)
    found = with_wrong_noise(model, all_outputs(model), N, L, model.R)
    np.testing.assert_allclose([found.worst, found.rms, found.believed], [best.worst, best.rms, best.worst], rtol=1e-9)


@given(models(), st.integers(1, 8))
def test_the_divided_gain(model: LinearModel, n: int) -> None:
    assume(seen_well(model, n))
    K = settled_gain(model, n, R=model.R / n) / n
    engine = regime(undelayed(model, all_outputs(model), 1, K))
    assume(abs(engine.radius - 1.0) > 1e-3)
    assert_equal(with_divided_gain(model, all_outputs(model), n), engine)


def test_the_divided_gain_is_that_of_the_multirate_filter() -> None:
    system = linear_system(CV.Phi, np.zeros((2, 1)), CV.H, CV.Q, CV.R)
    steps = 400
    gains = run_multirate(
        system, 5, np.zeros(2), np.eye(2), np.zeros((steps, 1)), np.zeros((steps + 1, 1)), backend="numpy"
    ).gains
    settled = true_covariance(system, np.eye(2), gains).after[-1, 0, 0]
    assert with_divided_gain(CV, [0], 5).worst ** 2 == pytest.approx(settled, rel=1e-9)


def test_a_gain_may_make_the_filter_unstable() -> None:
    """Between measurements the model turns by half a revolution, of which a sum of noises knows nothing."""
    model = linear_model([[0, -1.4], [1.4, 0]], np.diag([1.0, 1e-6]), [[1, 0]], [[1]])
    found = with_divided_gain(model, [0, 1], 7)
    assert found.verdict == "unstable"
    assert found.radius is not None
    assert found.radius >= 1.0
    assert found.worst == np.inf
    assert found.no_delay == lossless(model, [0, 1], 1, 0).worst


@given(models(), periods)
def test_discarded_measurements_leave_what_decays_by_itself(model: LinearModel, N: int) -> None:
    found = discarded(model, all_outputs(model), N)
    radius = np.abs(np.linalg.eigvals(model.Phi)).max()
    assert found.radius == pytest.approx(radius, rel=1e-6)
    assert (found.L, found.oldest, found.mean_age) == (None, None, None)
    if radius > 1 - 1e-9:
        assert (found.verdict, found.worst) == ("diverges", np.inf)
    else:
        P = np.zeros_like(model.Q)
        for _ in range(2000):
            P = model.Phi @ P @ model.Phi.T + model.Q
        assert found.worst**2 == pytest.approx(np.trace(P), rel=1e-9)
        assert found.rms == found.worst


def test_discarded_measurements_hurt_only_outputs_that_depend_on_what_grows() -> None:
    model = linear_model(np.diag([0.5, 1.0]), np.eye(2), np.eye(2), np.eye(2))
    assert discarded(model, [0], 3).worst ** 2 == pytest.approx(1 / (1 - 0.25))
    assert discarded(model, [1], 3).verdict == "diverges"


def test_the_believed_covariance_is_the_filters_own() -> None:
    regime_ = with_assumed(CV, np.eye(2), 10, 0, summed)
    P = np.eye(2)
    for _ in range(200):
        K = P @ CV.H.T @ np.linalg.inv(CV.H @ P @ CV.H.T + CV.R)
        P = (np.eye(2) - K @ CV.H) @ P
        P = over_cycle(CV, 10)[0] @ P @ over_cycle(CV, 10)[0].T + 10 * CV.Q
    np.testing.assert_allclose(regime_.believed_before, P, rtol=1e-9)


def test_what_is_too_large_for_a_number_is_infinite() -> None:
    model = linear_model([[2]], [[1]], [[1]], [[1]])
    found = with_wrong_noise(model, [0], 1, 2000, [[2]])
    assert (found.verdict, found.worst, found.believed) == ("approximate", np.inf, np.inf)
