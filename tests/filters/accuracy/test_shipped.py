"""The shipped models, and what is found with them: land later rather than skip fixes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.linalg import expm

from filters.accuracy import SHIPPED_MODELS, lossless, px4_predictor, shipped_model, with_low_rate_noise
from filters.accuracy.periodic import steady
from filters.accuracy.van_loan import discretised
from filters.arrays import FloatArray

each_model = pytest.mark.parametrize("name", SHIPPED_MODELS)


def per_cent(value: float, other: float, decimals: int) -> str:
    return f"{100 * (value / other - 1):.{decimals}f}"


@pytest.mark.parametrize(
    ("name", "cost", "decimals"),
    [("ins-gps", "3.7", 1), ("ins-rtk", "13.8", 1), ("star-tracker", "0.09", 2), ("camera", "27.6", 1)],
)
def test_what_landing_at_the_next_measurement_costs(name: str, cost: str, decimals: int) -> None:
    model, states, N, M = at_its_rate(name)
    late, prompt = lossless(model, states, N, N).worst, lossless(model, states, N, M).worst
    assert per_cent(late, prompt, decimals) == cost


@pytest.mark.parametrize(
    ("name", "cost"), [("ins-gps", "36"), ("ins-rtk", "44"), ("star-tracker", "22"), ("camera", "83")]
)
def test_what_using_every_second_fix_costs(name: str, cost: str) -> None:
    model, states, N, M = at_its_rate(name)
    skipping, prompt = lossless(model, states, 2 * N, M).worst, lossless(model, states, N, M).worst
    assert per_cent(skipping, prompt, 0) == cost


@each_model
def test_landing_later_costs_less_than_skipping_fixes(name: str) -> None:
    model, states, N, M = at_its_rate(name)
    assert lossless(model, states, N, N).worst < lossless(model, states, 2 * N, M).worst


@each_model
@pytest.mark.parametrize("noise", ["sum", "euler"])
def test_an_approximated_noise_is_nearly_free(name: str, noise: str) -> None:
    """At most 0.001 %."""
    model, states, N, _ = at_its_rate(name)
    for L in (N // 2 + 1, N):
        exact = lossless(model, states, N, L).worst
        found = with_low_rate_noise(model, states, N, L, noise).worst  # type: ignore[arg-type]
        assert exact * (1 - 1e-12) <= found <= exact * (1 + 1e-5)


def test_a_summed_noise_is_not_free_for_a_camera_at_2_hz() -> None:
    shipped = shipped_model("camera")
    model, states = shipped.model(200.0), shipped.outputs["position"].states
    summed, exact = with_low_rate_noise(model, states, 100, 100, "sum").worst, lossless(model, states, 100, 100).worst
    assert per_cent(summed, exact, 0) == "24"


@each_model
def test_the_screening_rule_bounds_what_a_landing_costs(name: str) -> None:
    """sqrt(P^- / P^+) - 1 at the measurement: small where landing late hardly matters."""
    model, states, N, M = at_its_rate(name)
    regime = steady(model, np.eye(model.states)[states], N, 0)
    rule = np.sqrt(sum(regime.before[0, i, i] for i in states) / sum(regime.after[0, i, i] for i in states)) - 1
    cost = lossless(model, states, N, N).worst / lossless(model, states, N, M).worst - 1
    assert cost < rule


def test_smoothing_costs_a_camera_whose_target_turns_fast_everything() -> None:
    model, states, N, M = at_its_rate("camera")
    exact = lossless(model, states, N, M).worst
    assert px4_predictor(model, states, N, M, 1 / (200 * 0.25)).worst > 5 * exact


@each_model
def test_a_faster_high_rate_is_the_same_model(name: str) -> None:
    shipped = shipped_model(name)
    for output in shipped.outputs.values():
        slow = lossless(shipped.model(shipped.hr_hz), output.states, shipped.N, shipped.M)
        fast = lossless(shipped.model(2 * shipped.hr_hz), output.states, 2 * shipped.N, 2 * shipped.M)
        assert slow.no_delay <= fast.no_delay  # whose last step is nearer to the next measurement
        assert fast.worst == pytest.approx(slow.worst, rel=0.06)
        assert fast.jump == pytest.approx(slow.jump, rel=1e-6)


@each_model
def test_each_says_what_it_is_and_where_its_figures_are_from(name: str) -> None:
    shipped = shipped_model(name)
    model = shipped.model(shipped.hr_hz)
    assert len(model.names) == model.states == max(output.end for output in shipped.outputs.values())
    assert shipped.output in shipped.outputs
    assert shipped.unit == shipped.outputs[shipped.output].unit
    assert 0 < shipped.M < shipped.N
    assert shipped.what
    assert shipped.source


def test_a_model_that_there_is_not_is_refused() -> None:
    with pytest.raises(ValueError, match=r"model='ins' is unknown; give one of ins-gps, ins-rtk, star-tracker, camera"):
        shipped_model("ins")
    with pytest.raises(ValueError, match=r"hr_hz=0 must be a positive number of steps in a second"):
        shipped_model("camera").model(0)


def test_van_loans_method_is_the_integral() -> None:
    random = np.random.default_rng(0)
    A, root = random.normal(size=(2, 3, 3))
    density = root @ root.T

    def at(time_s: float) -> FloatArray:
        return np.asarray(expm(A * time_s) @ density @ expm(A * time_s).T)

    Phi, Q = discretised(A, density, 0.3)
    np.testing.assert_allclose(Phi, expm(A * 0.3), rtol=1e-12)
    np.testing.assert_allclose(Q, quad_vec(at, 0, 0.3, epsabs=1e-13)[0], rtol=1e-10)
    with pytest.raises(ValueError, match="period_s=-1 must be a positive number of seconds"):
        discretised(A, density, -1)


def at_its_rate(name: str) -> tuple:  # type: ignore[type-arg]
    shipped = shipped_model(name)
    return shipped.model(shipped.hr_hz), shipped.outputs[shipped.output].states, shipped.N, shipped.M
