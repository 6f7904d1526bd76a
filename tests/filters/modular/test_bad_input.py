"""Errors name the sensor, or the argument, its value and what to do."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from filters.modular import (
    Measurement,
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    maccormack,
    merwe,
    observe,
    run,
    space,
    unscented_corrector,
    unscented_predictor,
)
from tests.filters.modular import cases
from tests.filters.modular.cases import ATTITUDE, linear_case
from tests.filters.modular.refusals import GPS, POSITION, Y, refused

NOT_DEFINITE = np.array([[1.0, 2.0], [2.0, 1.0]])


@pytest.mark.parametrize(
    ("timing", "message"),
    [
        ({"every": 0}, "sensor 'gps': every=0 must be a whole number or a Fraction, at least 1"),
        ({"every": 1.5}, "sensor 'gps': every=1.5 must be a whole number or a Fraction"),
        ({"every": Fraction(1, 2)}, r"sensor 'gps': every=Fraction\(1, 2\) must be a whole number or a Fraction, at"),
        ({"delay": -1}, "sensor 'gps': delay=-1 must be a whole number, at least 0"),
        ({"delay": np.nan}, "sensor 'gps': delay=nan must be a whole number"),
        ({"delay": []}, r"sensor 'gps': delay=\[\] must be a whole number, at least 0, or a range or a list of such"),
        ({"delay": range(3, 3)}, r"sensor 'gps': delay=range\(3, 3\) must be a whole number"),
        ({"delay": range(-1, 3)}, r"sensor 'gps': delay=range\(-1, 3\) must be a whole number"),
        ({"delay": [2, 2.5]}, r"sensor 'gps': delay=\(2, 2.5\) must be a whole number"),
        ({"delay": "23"}, "sensor 'gps': delay='23' must be a whole number"),
        ({"dropout": 1.01}, r"sensor 'gps': dropout=1.01 must lie in \[0, 1\]: it is a probability; 10 % is 0.1"),
        ({"dropout": -0.1}, r"sensor 'gps': dropout=-0.1 must lie in \[0, 1\]"),
        ({"dropout": np.nan}, r"sensor 'gps': dropout=nan must lie in \[0, 1\]"),
        ({"dropout": "0.1"}, r"sensor 'gps': dropout='0.1' must lie in \[0, 1\]"),
    ],
)
def test_when_a_sensor_measures(timing: dict[str, Any], message: str) -> None:
    refused(message, lambda: Sensor("gps", POSITION, **timing))


@pytest.mark.parametrize(
    ("corrector", "message"),
    [
        (linear_corrector(cases.H_BOTH, NOT_DEFINITE), "R is not positive definite|R is no covariance"),
        (linear_corrector(cases.H_POSITION, [[0.0]]), "R is not positive definite .*; give each measurement noise"),
        (linear_corrector(cases.H_POSITION, [[np.nan]]), "R holds a value that is not finite"),
        (linear_corrector(cases.H_BOTH, [[1.0, 0.5], [0.0, 1.0]]), "R is not symmetric.*give"),
        (linear_corrector(cases.H_POSITION, [1.0]), r"R has shape \(1,\); needed is \(1, 1\)"),
        (linear_corrector(cases.H_POSITION, np.eye(2)), r"H has shape \(1, 2\); needed is \(2, 2\)"),
        (linear_corrector(np.ones((1, 3)), [[1.0]]), r"H has shape \(1, 3\); needed is \(1, 2\)"),
        (linear_corrector([[np.inf, 1.0]], [[1.0]]), "H holds a value that is not finite"),
        (extended_corrector(cases.height, [[-1.0]]), "R is no covariance: its smallest eigenvalue is -1"),
        (
            extended_corrector(cases.attitude, np.eye(4), observed=space(4, attitudes=[0])),
            "R has shape .*attitude has 3",
        ),
        (unscented_corrector(cases.height, np.zeros((1, 2))), r"R has shape \(1, 2\); needed is \(1, 1\)"),
        (unscented_corrector(cases.height, [[1.0]], merwe(kappa=-2.0)), "spread no sigma points for 2 states"),
    ],
)
def test_correctors_are_refused_with_the_sensor_s_name(corrector: Any, message: str) -> None:
    refused(f"sensor 'gps': .*({message})", lambda: linear_case(Sensor("good", POSITION), Sensor("gps", corrector)))


@pytest.mark.parametrize(
    ("predictor", "message"),
    [
        (lambda: linear_predictor(np.eye(3), cases.Q), r"linear_predictor: F has shape \(3, 3\); needed is \(2, 2\)"),
        (lambda: linear_predictor(cases.F, np.ones((2, 3))), r"linear_predictor: Q has shape \(2, 3\)"),
        (lambda: linear_predictor(cases.F, cases.Q, np.ones((3, 1))), r"linear_predictor: B has shape \(3, 1\)"),
        (lambda: linear_predictor(cases.F, NOT_DEFINITE), "linear_predictor: Q is no covariance"),
        (lambda: extended_predictor(cases.pendulum, -np.eye(2)), "extended_predictor: Q is no covariance"),
        (lambda: unscented_predictor(cases.pendulum, np.full((2, 2), np.nan)), "unscented_predictor: Q holds a value"),
        (lambda: unscented_predictor(cases.pendulum, cases.Q, merwe(alpha=0.0)), "merwe: alpha=0.0.*no sigma points"),
    ],
)
def test_predictors(predictor: Callable[[], Any], message: str) -> None:
    refused(message, predictor)


def test_composition() -> None:
    predictor, gps = linear_predictor(cases.F, cases.Q), Sensor("gps", POSITION)
    refused("sensor 'gps': the name is used twice; give each", lambda: ModularFilter(predictor, [gps, gps]))
    refused("dt=nan must be positive", lambda: ModularFilter(predictor, [gps], dt=np.nan))
    refused(r"predictor: its Q has shape \(2, 2\), but an error", lambda: ModularFilter(predictor, [gps], of=space(3)))
    of = space(4, attitudes=[0])
    turned = linear_predictor(np.eye(3), np.eye(3))
    refused("predictor: a linear one cannot turn an attitude; make it", lambda: ModularFilter(turned, [], of=of))
    refused(
        "sensor 'compass': H of a linear one sees an attitude",
        lambda: ATTITUDE.with_sensors(Sensor("compass", linear_corrector(np.eye(1, 6), np.eye(1)))),
    )


@pytest.mark.parametrize(
    ("measurements", "message"),
    [
        ([Measurement("gsp", 0, 0, Y)], "sensor 'gsp' is none of the filter's: they are gps, other"),
        (
            [Measurement("gps", 0, 4, Y)],
            "sensor 'gps', measurement of step 0, .* step 4: the history goes back 3 steps: give a longer history=",
        ),
        ([Measurement("gps", 0, 2**70, Y)], "sensor 'gps', measurement of step 0.*whole numbers below"),
        ([Measurement("gps", 0, 1, np.array([None]).astype(float))], "sensor 'gps', .*give None for a lost number"),
        (
            [Measurement("other", 1, 1, np.array([np.nan]))],
            "sensor 'other', .* not finite; leave lost measurements out",
        ),
        ([Measurement("gps", 0, 1, np.zeros(2))], r"sensor 'gps', .* y has shape \(2,\), its corrector needs \(1,\)"),
        ([Measurement("gps", 0, 1, np.array(1.0))], r"sensor 'gps', .* y has shape \(\), its corrector needs \(1,\)"),
        ([Measurement("gps", 3, 2, Y)], "sensor 'gps', measurement of step 3.*before it arrives"),
        ([Measurement("gps", -1, 2, Y)], "sensor 'gps', measurement of step -1.*in step 0 or later"),
        ([Measurement("gps", 0.5, 2, Y)], "sensor 'gps', measurement of step 0.5.*whole numbers"),
        ([Measurement("gps", 0, None, Y)], "sensor 'gps', measurement of step 0.*whole numbers"),
        (
            [Measurement("gps", 0, 2, ["one"])],
            "sensor 'gps', .* y is .'one'.; its corrector needs an array of 1 numbers",
        ),
        ([Measurement("gps", 0, 2, [1j])], "sensor 'gps', .* y is .1j.; its corrector needs an array of 1 numbers"),
        (Measurement("gps", 0, 2, Y), "measurements holds 'gps'; give a list of Measurement"),
        ([("gps", 0, 2, Y)], "measurements holds .'gps', .*; give a list of Measurement"),
        ([Measurement(["gps"], 0, 2, Y)], "sensor .'gps'. is none of the filter's: they are gps, other"),
        (None, r"measurements is None; give a list of Measurement\(.*\), \[\] if there are none"),
        (7, "measurements is 7; give a list of Measurement"),
    ],
)
def test_measurements(measurements: list[Measurement], message: str) -> None:
    refused(message, lambda: run(GPS.composed, GPS.x0, GPS.P0, GPS.inputs(6), measurements, backend="reference"))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x0": np.zeros(3)}, r"x0 has shape \(3,\), the filter needs \(2,\)"),
        ({"x0": np.array([0.0, np.nan])}, "x0 .*finite numbers"),
        ({"P0": np.eye(3)}, r"P0 has shape \(3, 3\); needed is \(2, 2\)"),
        ({"P0": NOT_DEFINITE}, "P0 is no covariance: its smallest eigenvalue is -1"),
        ({"P0": [[1.0, 0.5], [0.0, 1.0]]}, "P0 is not symmetric, so it is no covariance"),
        (
            {"P0": np.diag([1e12, -1.0])},
            r"P0 is no covariance: beside variances of -1 to 1e\+12 a state, .* negative one; give each a variance",
        ),
        ({"P0": np.full((2, 2), np.nan)}, "P0 holds a value that is not finite"),
        ({"inputs": np.zeros(6)}, r"inputs has shape \(6,\); needed is \(steps, inputs of the predictor\)"),
        ({"inputs": np.zeros((6, 2))}, "predictor: B has 1 columns, but the input has 2 numbers"),
        ({"inputs": np.full((6, 1), np.inf)}, "inputs holds a value that is not finite"),
        ({"history": -1}, "history=-1 must be a whole number, at least 0"),
        ({"history": 5.5}, "history=5.5 must be a whole number, at least 0"),
        ({"late": "never"}, "late='never' is unknown; give one of recalculate, larsen, carried-gain, dual-rate"),
        ({"late": "larsen", "history": 3}, "history=3 goes with late='recalculate'; late='larsen' goes back no step"),
        ({"too_old": "keep"}, "too_old='keep' is unknown; give one of refuse, drop"),
        (
            {"late": "carried-gain", "too_old": "drop"},
            "too_old='drop': for late='carried-gain' no measurement is too old, leave it",
        ),
        (
            {"late": "larsen", "too_old": "drop"},
            "too_old='drop': for late='larsen' no measurement is too old, leave it",
        ),
        ({"x0": ["here", 1.0]}, "x0 is .'here', 1.0.; needed is an array of real numbers"),
        ({"inputs": 1j * np.ones((6, 1))}, "inputs is array.*; needed is an array of real numbers"),
        ({"measurements": [Measurement("gps", 0, 3, Y + 1j)]}, "sensor 'gps', .*y is array.*; its corrector needs"),
        ({"x0": np.ma.array([0.0, 1.0], mask=[0, 1])}, r"x0 is masked at \[1\]; give a number there"),
        ({"P0": np.ma.array(np.eye(2), mask=np.eye(2))}, r"P0 is masked at \[0, 0\]"),
        ({"inputs": np.ma.masked_all((6, 1))}, r"inputs is masked at \[0, 0\]"),
        ({"inputs": [np.ma.masked_all(1)] * 6}, r"inputs\[0\] is masked at \[0\]"),
        ({"inputs": None}, "predictor: B has 1 columns, but the input has 0 numbers"),
        ({"L": 3}, "L=3 goes with late='dual-rate'; late='recalculate' corrects on arrival"),
        ({"backend": "gpu"}, "backend='gpu' is unknown"),
        ({"backend": ["compiled"]}, "backend=.'compiled'. is unknown"),
        ({"composed": None}, r"composed is None; give a ModularFilter\(predictor, sensors, ...\)"),
        ({"composed": (GPS.composed,)}, "composed is a tuple with the ModularFilter in it; give item 0 of it"),
        ({"composed": (GPS.composed, GPS.x0, GPS.P0)}, "in it; unpack it: composed, x0, P0 = "),
        ({"composed": linear_case}, r"composed is the function linear_case, .*; call it: composed = linear_case\("),
    ],
)
def test_arguments_of_a_run(change: dict[str, Any], message: str) -> None:
    good = {
        "composed": GPS.composed,
        "x0": GPS.x0,
        "P0": GPS.P0,
        "inputs": GPS.inputs(6),
        "measurements": [Measurement("gps", 0, 3, Y)],
        "backend": "reference",
    }
    refused(message, lambda: run(**{**good, **change}))


@pytest.mark.parametrize("name", [3, None, ["gps"], "", "  "])
def test_a_sensor_s_name(name: Any) -> None:
    refused("Sensor: name=.* must be text, and not empty: its measurements are", lambda: Sensor(name, POSITION))


@pytest.mark.parametrize("make", [merwe, maccormack])
@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"alpha": 0}, "alpha=0, .* spread no sigma points for any number of states: alpha.2 times"),
        ({"alpha": np.nan}, "alpha=nan, .* spread no sigma points for any number of states"),
        ({"kappa": np.inf}, "kappa=inf spread no sigma points for any number of states"),
        ({"alpha": "a"}, "alpha='a' must be a number"),
        ({"beta": None}, "beta=None must be a number"),
        ({"kappa": 1j}, "kappa=1j must be a number"),
    ],
)
def test_sigma_points_are_refused_as_they_are_made(
    make: Callable[..., Any], numbers: dict[str, Any], message: str
) -> None:
    refused(f"{make.__name__}: .*{message}", lambda: make(**numbers))


def test_sigma_points_of_no_state_or_beyond_all_numbers() -> None:
    refused("maccormack: .* any number of states: alpha.2 times kappa must be", lambda: maccormack(kappa=0.0))
    refused(
        "merwe: alpha=1e.200, .* for 2 states", lambda: unscented_predictor(cases.pendulum, cases.Q, merwe(alpha=1e200))
    )
    refused("points is <function merwe.*; give merwe", lambda: unscented_predictor(cases.pendulum, cases.Q, merwe))


@pytest.mark.parametrize("numbers", ["2", None, 0, -1, 2.0, True, 10**9])
def test_the_length_of_a_point(numbers: Any) -> None:
    refused("space: numbers=.* must be a whole number from 1 to 100000", lambda: space(numbers))


@pytest.mark.parametrize("function", [None, 3, "f", np.sin])
def test_functions_are_looked_at_when_a_filter_is_composed(function: Any) -> None:
    said = "is a (NoneType|int|str|ufunc); give a plain function, made by def or lambda"
    Q, R = cases.Q, [[1.0]]
    for predictor in (extended_predictor(function, Q), unscented_predictor(function, Q)):
        refused(rf"predictor: f\(x, u, dt, out\) {said}", lambda predictor=predictor: ModularFilter(predictor, []))
    for corrector in (extended_corrector(function, R), unscented_corrector(function, R)):
        refused(rf"sensor 's': h\(x, out\) {said}", lambda corrector=corrector: linear_case(Sensor("s", corrector)))
    if function is not None:
        with_jacobian = extended_corrector(cases.height, R, function)
        refused(rf"sensor 's': jacobian\(x, out\) {said}", lambda: linear_case(Sensor("s", with_jacobian)))


def test_an_attitude_without_length_is_given_one() -> None:
    refused(
        "x0: the attitude at 0 has length 0; give a unit quaternion, 1, 0, 0, 0 if it turns nothing",
        lambda: run(ATTITUDE.composed, np.zeros(7), ATTITUDE.P0, ATTITUDE.inputs(1), [], backend="reference"),
    )


def test_a_quaternion_to_start_from_has_unit_length() -> None:
    x0 = np.array([1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    refused(
        "x0: the attitude at 0 has length 1.414.*divide by it",
        lambda: run(ATTITUDE.composed, x0, ATTITUDE.P0, ATTITUDE.inputs(1), [], backend="reference"),
    )


def test_the_truth_that_is_observed_has_the_state_s_shape() -> None:
    refused(
        r"truth has shape \(5, 3\), the filter's states need \(any, 2\)",
        lambda: observe(GPS.composed, np.zeros((5, 3)), 1),
    )


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"composed": None}, "composed is None; give a ModularFilter"),
        ({"truth": None}, "truth .*; needed is an array of real numbers|truth has shape"),
        ({"seed": None}, "seed=None must be a whole number, at least 0"),
        ({"seed": -1}, "seed=-1 must be a whole number, at least 0"),
        ({"seed": [1, 2]}, "seed=.1, 2. must be a whole number, at least 0"),
    ],
)
def test_what_is_observed(change: dict[str, Any], message: str) -> None:
    good = {"composed": GPS.composed, "truth": np.zeros((5, 2)), "seed": 1}
    refused(message, lambda: observe(**{**good, **change}))
