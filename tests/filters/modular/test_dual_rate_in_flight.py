"""The dual-rate filter of several late sensors: that which gets each measurement in the step in which it lands.

Two oracles: the error as a linear map of all noises, stacked; and the carried gain, whose sums go another way.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.accuracy.trace import along
from filters.modular import Measurement, ModularFilter, Sensor, linear_corrector, linear_predictor, run
from filters.modular.low_rate import LowRate
from tests.filters.modular.cases import measured
from tests.filters.modular.test_carried_gain import FILTER, NAMES, P0, X0, H, R, batch, inputs, record, undelayed
from tests.filters.modular.test_larsen import small_attitude

L = {"gps": 26, "camera": 17, "sonar": 9}
"""Shorter than the others' delays: landings overtake one another."""


def landing(measurements: Sequence[Measurement], lands: dict[str, int] = L) -> list[Measurement]:
    """The same, if each arrived in the step in which it lands."""
    return [one._replace(arrives=one.taken + lands[one.sensor]) for one in measurements]


def in_time(measurements: Sequence[Measurement], lands: dict[str, int] = L) -> list[Measurement]:
    """Those that arrive before they have to land."""
    return [one for one in measurements if one.arrives < one.taken + lands[one.sensor]]


def filtered(steps: int, measurements: Sequence[Measurement], **options: Any) -> tuple[Any, ...]:
    return tuple(run(FILTER, X0, P0, inputs(steps), measurements, **({"late": "dual-rate", "L": L} | options)))


def test_three_sensors_out_of_order_are_the_batch_of_what_has_landed() -> None:
    """A model that changes with time: estimate and true covariance in every step; at the end all has landed."""
    steps = 50
    measurements = in_time(record(20, 25, seed=1))
    assert len(measurements) >= 10
    x, P = filtered(steps, measurements)
    expected = batch(steps, landing(measurements))
    np.testing.assert_allclose(x, expected.x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(P, expected.P, rtol=0, atol=1e-10)
    undelayed_x, undelayed_P = run(FILTER, X0, P0, inputs(steps), undelayed(measurements))
    np.testing.assert_allclose(x[-1], undelayed_x[-1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(P[-1], undelayed_P[-1], rtol=0, atol=1e-10)


def test_without_what_puts_the_others_right_it_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    measurements = in_time(record(20, 25, seed=1))
    expected = filtered(50, measurements)[0]

    def only_carried(_: LowRate, knot: Any, delta: Any) -> None:
        if knot.transition is not None:
            delta[:] = knot.transition.Phi @ delta

    monkeypatch.setattr(LowRate, "_go_past", only_carried)
    assert np.abs(filtered(50, measurements)[0][-1] - expected[-1]).max() > 1e-3


@st.composite
def arriving(draw: st.DrawFn, steps: int, lands: dict[str, int], *, losses: bool = False) -> list[Measurement]:
    """Any sensors in any steps, several of one in one step too; numbers are lost, where that is asked for."""
    found = []
    for k in range(steps + 1):
        for name in draw(st.lists(st.sampled_from(NAMES), max_size=3)):
            y = list(np.sin(1.0 + k + np.arange(len(R[name]))))
            if losses and draw(st.integers(0, 3)) == 0:
                y = [None if draw(st.booleans()) else value for value in y]
            least = int(all(value is None for value in y))
            if least < lands[name]:
                found.append(Measurement(name, k, k + draw(st.integers(least, lands[name] - 1)), y))
    return found


SHORT = {"gps": 6, "camera": 3, "sonar": 2}


@settings(max_examples=25, deadline=None)
@given(measurements=arriving(7, SHORT))
def test_any_arrivals_are_the_batch_of_what_has_landed(measurements: list[Measurement]) -> None:
    x, P = filtered(9, measurements, L=SHORT)
    expected = batch(9, landing(measurements, SHORT))
    np.testing.assert_allclose(x, expected.x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(P, expected.P, rtol=0, atol=1e-10)


@settings(max_examples=25, deadline=None)
@given(measurements=arriving(7, SHORT, losses=True))
def test_with_losses_too_it_is_the_carried_gain_of_what_has_landed(measurements: list[Measurement]) -> None:
    x, P = filtered(14, measurements, L=SHORT)
    expected = filtered(14, landing(measurements, SHORT), late="carried-gain", L=None)
    np.testing.assert_allclose(x, expected[0], rtol=0, atol=1e-10)
    np.testing.assert_allclose(P, expected[1], rtol=0, atol=1e-10)


def test_what_comes_too_late_is_lost() -> None:
    measurements = record(20, 25, seed=1)
    found = run(FILTER, X0, P0, inputs(50), measurements, late="dual-rate", L=L, too_old="drop")
    good = in_time(measurements)
    assert sorted(one.taken for one in found.dropped) == sorted(one.taken for one in measurements if one not in good)
    as_lost = [one if one in good else one._replace(y=[None] * len(one.y)) for one in measurements]
    expected = filtered(50, landing(as_lost), late="carried-gain", L=None)
    for each, carried in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, carried, rtol=0, atol=1e-10)


def test_a_loss_that_is_known_late_is_neither_refused_nor_dropped() -> None:
    measurements = [Measurement("gps", 0, 40, [None]), Measurement("camera", 2, 5, [0.1, 0.2])]
    found = run(FILTER, X0, P0, inputs(50), measurements, late="dual-rate", L=L)
    known = [measurements[0]._replace(arrives=L["gps"]), *landing(measurements[1:])]
    for each, carried in zip(found, filtered(50, known, late="carried-gain", L=None), strict=True):
        np.testing.assert_allclose(each, carried, rtol=0, atol=1e-10)
    assert found.dropped == ()


def test_one_sensor_that_measures_between_its_cycles() -> None:
    """Taken when they are, at a quotient of steps or not, they are those that were all given at their landing."""
    alone = ModularFilter(FILTER.predictor, [Sensor("gps", linear_corrector(H["gps"], R["gps"]), Fraction(5, 2), 3)])
    taken = [Measurement("gps", k, k + 3, [np.sin(k)]) for k in alone.sensors[0].takes(15)]
    found = run(alone, X0, P0, inputs(20), taken, late="dual-rate")
    expected = run(alone, X0, P0, inputs(20), landing(taken, {"gps": 5}), history=5)
    for each, late in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, late, rtol=0, atol=1e-10)


def test_of_attitudes_it_is_the_carried_gain_too() -> None:
    """But for the steps of which Jacobians by differences are taken."""
    case = small_attitude(0.1)
    measurements = [one._replace(arrives=one.taken + 6 - one.taken // 2) for one in measured(case, 9, seed=1)]
    given_to_both = case.composed, case.x0, case.P0, case.inputs(20)
    found = run(*given_to_both, measurements, late="dual-rate", L=9)
    expected = run(*given_to_both, landing(measurements, {"stars": 9}), late="carried-gain")
    for each, carried in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, carried, rtol=0, atol=1e-6)


@pytest.mark.slow
@pytest.mark.exhaust
def test_compiled_equals_reference() -> None:
    measurements = record(20, 25, seed=1)
    both = [filtered(30, measurements, too_old="drop", backend=backend) for backend in ("compiled", "reference")]
    for compiled, reference in zip(*both, strict=True):
        np.testing.assert_allclose(compiled, reference, rtol=0, atol=1e-11)


@pytest.mark.parametrize(
    ("deviation", "lands", "worst", "average"), [(2.0, 30, 1.009, 1.0005), (0.3, 60, 1.865, 1.072)]
)
def test_what_has_been_overtaken_counts_in_the_gains_of_what_overtakes_it(
    deviation: float, lands: int, worst: float, average: float
) -> None:
    """Beside the best filter of what has landed: fixes every 20 steps, images of 0.55 m every 7 that land in k + 6."""
    Phi, Q, H = np.array([[1.0, 1.0], [0.0, 1.0]]), 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1]]), np.eye(1, 2)
    noises, when = {"fix": [[deviation**2]], "image": [[0.3]]}, {"fix": lands, "image": 6}
    every, steps = {"fix": 20, "image": 7}, 600
    sensors = [Sensor(name, linear_corrector(H, noises[name]), every[name], when[name] - 1) for name in every]
    measurements = [
        Measurement(name, k, k + when[name] - 1, [0.0]) for name in every for k in range(0, steps, every[name])
    ]
    composed, start = ModularFilter(linear_predictor(Phi, Q), sensors), np.diag([4.0, 1.0])
    found = run(composed, [0.0, 0.0], start, np.zeros((steps, 0)), measurements, late="dual-rate", L=when)
    landings = [(one.sensor, one.taken, one.taken + when[one.sensor]) for one in measurements]
    best = along(Phi, Q, {name: (H, R) for name, R in noises.items()}, [0], start, steps, landings).deviations
    over = np.sqrt(found.P[:, 0, 0]) / best
    assert over.min() > 1 - 1e-9
    assert over.max() == pytest.approx(worst, abs=0.001)
    assert np.sqrt(np.mean(found.P[:, 0, 0]) / np.mean(best**2)) == pytest.approx(average, abs=0.001)
