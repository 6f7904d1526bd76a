"""PX4's output predictor: the closed form is what the engine finds on the stacked buffer."""

from __future__ import annotations

from collections.abc import Iterator
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, lossless, predictor_response, px4_predictor, shipped_model
from filters.accuracy.cyclic.engine import regime
from filters.accuracy.cyclic.gain import settled_gain
from filters.accuracy.cyclic.output_predictor import predicted_output
from filters.accuracy.periodic import steady
from filters.arrays import FloatArray
from tests.filters.accuracy.cases import CV, all_outputs, models, seen_well


@pytest.mark.parametrize("worth", [0, predictor_response.WORTH], ids=["step by step", "as it is"])
@given(models(), st.integers(1, 6), st.integers(0, 9), st.sampled_from([0.05, 0.2, 0.5, 1.0]))
def test_it_is_what_the_engine_finds(worth: int, model: LinearModel, N: int, D: int, g: float) -> None:
    assume(seen_well(model, N))
    engine = regime(predicted_output(model, all_outputs(model), N, D, g, settled_gain(model, N)))
    assume(not 0.995 < engine.radius < 1.01)
    with patch.object(predictor_response, "WORTH", worth):
        found = px4_predictor(model, all_outputs(model), N, D, g)
    if engine.radius > 1:
        assert found.verdict == "unstable"
        return
    assert found.verdict == "approximate"
    np.testing.assert_allclose(found.worst**2, engine.variances.max(), rtol=1e-9)
    np.testing.assert_allclose(found.rms**2, engine.variances.mean(), rtol=1e-9)
    np.testing.assert_allclose(found.jump**2, engine.moves.max(), rtol=1e-9)


@pytest.mark.parametrize("D", [0, 4, 30])
@pytest.mark.parametrize("g", [0.4, 0.1, 0.02])
def test_it_is_what_its_definition_adds_up_to(D: int, g: float) -> None:
    N = 10
    exact, added, moved = lossless(CV, [0], N, D), np.zeros(N), np.zeros(N)
    for step, (apart, move) in enumerate(after_an_innovation(CV, N, D, g, steps=round(400 / g))):
        added[step % N] += np.square(apart[0]).sum()
        moved[step % N] += np.square(move[0]).sum()
    found = px4_predictor(CV, [0], N, D, g)
    variances = steady(CV, np.eye(1, 2), N, N + D).variances[0, D : N + D]
    np.testing.assert_allclose(found.worst, np.sqrt((variances + added).max()), rtol=1e-9)
    np.testing.assert_allclose(found.rms, np.sqrt((variances + added).mean()), rtol=1e-9)
    np.testing.assert_allclose(found.jump, np.sqrt(moved.max()), rtol=1e-9)
    assert found.worst > exact.worst


def after_an_innovation(
    model: LinearModel, N: int, D: int, g: float, steps: int
) -> Iterator[tuple[FloatArray, FloatArray]]:
    """What it makes of the output, less an exact replay, and by how much it is moved, in each step: the horizon's
    estimate gets it at once, and the outputs o_{j-D} .. o_j are drawn after it."""
    before = steady(model, np.eye(model.states), N, 0).before[0]
    S = model.H @ before @ model.H.T + model.R
    horizon = before @ model.H.T @ np.linalg.inv(S) @ np.linalg.cholesky(S)
    outputs, total = [np.zeros_like(horizon)] * (D + 1), np.zeros_like(horizon)
    replay = np.linalg.matrix_power(model.Phi, D)
    for _ in range(steps):
        err = horizon - outputs[0]
        total = total + err
        move = g * err + 0.1 * g**2 * total
        outputs = [output + move for output in outputs]
        yield outputs[-1] - replay @ horizon, move
        horizon = model.Phi @ horizon
        outputs = [*outputs[1:], model.Phi @ outputs[-1]]


def test_slow_smoothing_takes_no_longer() -> None:
    """Without delay, and with a time constant of 50 s: in as many products as its steps have digits."""
    shipped = shipped_model("ins-gps")
    found = px4_predictor(shipped.model(400.0), [0, 1, 2], shipped.N, 0, 1 / (400 * 50.0))
    assert found.verdict == "approximate"
    assert found.worst > px4_predictor(shipped.model(400.0), [0, 1, 2], shipped.N, 0, 1 / 400).worst


def test_the_less_it_smooths_the_nearer_it_is_to_an_exact_replay() -> None:
    exact = lossless(CV, [0], 10, 4)
    costs = [px4_predictor(CV, [0], 10, 4, g).rms / exact.rms - 1 for g in (0.05, 0.1, 0.2, 0.4, 0.8)]
    assert costs == sorted(costs, reverse=True)
    assert all(cost > 0 for cost in costs)


@pytest.mark.parametrize(("name", "worst", "rms"), [("ins-gps", "2.5", "5.7"), ("ins-rtk", "13.2", "27.7")])
def test_what_it_costs_inertial_navigation_at_a_quarter_of_a_second(name: str, worst: str, rms: str) -> None:
    """In per cent, of an exact replay from the same horizon; a Monte Carlo of 800 flights agrees."""
    shipped = shipped_model(name)
    model, states = shipped.model(400.0), shipped.outputs["position"].states
    found = px4_predictor(model, states, shipped.N, shipped.M, 1 / (400 * 0.25))
    exact = lossless(model, states, shipped.N, shipped.M)
    assert f"{100 * (found.worst / exact.worst - 1):.1f}" == worst
    assert f"{100 * (found.rms / exact.rms - 1):.1f}" == rms


@pytest.mark.parametrize("g", [0.0, -1.0, np.nan, np.inf, "0.1"])
def test_a_gain_that_is_none_is_refused(g: float) -> None:
    with pytest.raises(ValueError, match=r"g=.* must be positive: it is the period of a step over the time constant"):
        px4_predictor(CV, [0], 10, 4, g)
