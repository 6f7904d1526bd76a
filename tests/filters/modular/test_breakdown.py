"""A part that leaves no estimate is named, with its step and what to do about it; and that helps."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest

from filters.arrays import FloatArray
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
    run,
    space,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.correctors import Corrector
from filters.modular.late import Late
from filters.modular.predictors import Predictor
from filters.modular.sigma_points import SigmaPoints
from tests.filters.modular import cases

WAYS: tuple[Late, ...] = get_args(Late)
POSITION = linear_corrector([[1.0, 0.0]], [[1.0]])
STILL = linear_predictor(np.eye(2), 0.01 * np.eye(2))


def filtered(
    predictor: Predictor,
    corrector: Corrector,
    *,
    steps: int = 6,
    x0: Any = (0.5, 0.5),
    late: Late = "recalculate",
    every: int = 1,
    P0: float = 1.0,
    **options: Any,
) -> None:
    """With a measurement in the first step and each so many later, and the number of the step as input."""
    of = space(7, attitudes=[0]) if predictor.states == 6 else None
    composed = ModularFilter(predictor, [Sensor("s", corrector)], of=of, **options)
    inputs = np.arange(float(steps))[:, None]
    measurements = [Measurement("s", k, k, np.zeros(corrector.observed.numbers)) for k in range(0, steps, every)]
    run(composed, x0, P0 * np.eye(predictor.states), inputs, measurements, late=late, backend="reference")


def refused(message: str, *parts: Any, **options: Any) -> None:
    with pytest.raises(ValueError, match=message):
        filtered(*parts, **options)


def root_of_what_is_left(_x: FloatArray, u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = np.sqrt(2.0 - u[0])


def swelling(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[0], out[1] = x[0], 1e60 * x[1]


def logarithm(x: FloatArray, out: FloatArray) -> None:
    out[0] = np.log(x[0])


def logarithm_slope(x: FloatArray, out: FloatArray) -> None:
    out[0, 0] = 1.0 / x[0]


def falling(x: FloatArray, u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[0], out[1] = x[0] - 10.0 * u[0], x[1]


def still(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = x


@pytest.mark.parametrize("late", WAYS)
def test_a_function_that_is_not_finite_at_a_later_input(late: Late) -> None:
    refused(
        r"predictor, step 4: f\(x, u, dt, out\) is not finite at x = .*, u = \[3.0\].* no longer finite; give it a",
        extended_predictor(root_of_what_is_left, np.eye(2)),
        POSITION,
        late=late,
    )


@pytest.mark.parametrize("late", WAYS)
@pytest.mark.parametrize(
    "corrector", [extended_corrector(logarithm, [[1.0]]), extended_corrector(logarithm, [[1.0]], logarithm_slope)]
)
def test_a_function_that_is_not_finite_at_a_later_state(corrector: Corrector, late: Late) -> None:
    refused(
        r"sensor 's', step 2: h\(x, out\) is not finite at x = .*; give it a value there, or a start",
        extended_predictor(falling, np.eye(2)),
        corrector,
        x0=(10.0, 0.5),
        late=late,
    )


@pytest.mark.parametrize(
    ("predictor", "corrector", "message"),
    [
        (unscented_predictor(root_of_what_is_left, np.eye(2)), POSITION, r"predictor, step 4: f.*, u = \[3.0\]"),
        (STILL, unscented_corrector(logarithm, [[1.0]]), r"sensor 's', step 0: h\(x, out\) is not finite at x = \[-"),
    ],
)
def test_a_function_that_is_not_finite_at_a_sigma_point(predictor: Predictor, corrector: Any, message: str) -> None:
    refused(message, predictor, corrector, x0=(0.8, 0.5))


def test_a_jacobian_that_is_not_finite() -> None:
    """The logarithm is finite at the state, and not a thousandth of a deviation below."""
    refused(
        "sensor 's', step 0: the Jacobian of h is not finite at x = .0.0005",
        STILL,
        extended_corrector(logarithm, [[1.0]]),
        x0=(0.0005, 0.5),
    )


GROWING = linear_predictor(np.diag([1.0, 1e60]), np.eye(2))


@pytest.mark.parametrize(
    ("predictor", "late"),
    [*((GROWING, late) for late in WAYS), (extended_predictor(swelling, np.eye(2)), "recalculate")],
)
def test_what_grows_without_bound(predictor: Predictor, late: Late) -> None:
    """The second state is not seen; its variance is beyond all numbers after some steps, and that is not let pass."""
    refused(
        "predictor, step 3: the estimate is no longer finite: the model lets it grow",
        predictor,
        POSITION,
        late=late,
    )


@pytest.mark.parametrize("points", [merwe(0.1, -5.0), merwe(beta=-9.0, kappa=-1.0), maccormack(beta=-9.0)])
def test_sigma_points_of_negative_weight_and_that_the_remedy_helps(points: SigmaPoints) -> None:
    def bent(x: FloatArray, out: FloatArray) -> None:
        out[0] = x[0] ** 2

    message = (
        "sensor 's', step 0: the covariance .*, for sigma point 0 counts -.* times .* merwe.. with alpha = 1 and kappa"
    )
    refused(message, STILL, unscented_corrector(bent, [[1e-3]], points), x0=(0.0, 0.0))
    filtered(STILL, unscented_corrector(bent, [[1e-3]], merwe(alpha=1.0, kappa=0.0)))


@pytest.mark.parametrize("late", WAYS)
def test_a_covariance_that_is_lost_to_rounding_and_that_each_remedy_helps(late: Late) -> None:
    """A measurement tells 1e18 times as much as was known: what is left is less than the last digit of what was."""
    moving = linear_predictor([[1.0, 0.01], [0.0, 1.0]], 1e-12 * np.eye(2))
    sharp, blunt = linear_corrector([[1.0, 0.0]], [[1e-8]]), linear_corrector([[1.0, 0.0]], [[1e2]])
    message = "sensor 's', step 0: the covariance is no longer .*: rounding .* of 1e.10 to 1e.10; give update='u-d' "
    refused(message, moving, sharp, P0=1e10, late=late)
    filtered(moving, blunt, P0=1e10, late=late)
    filtered(moving, sharp, P0=1.0, late=late)
    filtered(moving, sharp, P0=1e10, late="recalculate", update="u-d")


def test_with_sigma_points_the_remedy_is_josephs_form() -> None:
    def first(x: FloatArray, out: FloatArray) -> None:
        out[0] = x[0]

    moving, sharp = linear_predictor([[1.0, 0.01], [0.0, 1.0]], 1e-12 * np.eye(2)), unscented_corrector(first, [[1e-8]])
    refused("sensor 's', step 0: .*rounding .*; give update='joseph', more noise", moving, sharp, P0=1e10)
    filtered(moving, sharp, P0=1e10, update="joseph")


def test_an_attitude_without_length() -> None:
    def vanishing(x: FloatArray, u: FloatArray, dt: float, out: FloatArray) -> None:
        cases.gyroscope(x, u * np.ones(3), dt, out)
        if u[0] == 3.0:
            out[:4] = 0.0

    upright = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for make in (extended_predictor, unscented_predictor):
        refused(
            r"predictor, step 4: f\(x, u, dt, out\) has an attitude without length",
            make(vanishing, 1e-3 * np.eye(6)),
            extended_corrector(cases.field, np.eye(3)),
            x0=upright,
        )
    nowhere = extended_corrector(lambda _x, out: out.fill(0.0), np.eye(3), observed=space(4, attitudes=[0]))
    refused(
        r"sensor 's': h\(x, out\) left in out .*no length.*unit",
        extended_predictor(cases.gyroscope, np.eye(6)),
        nowhere,
        x0=upright,
    )


@pytest.mark.parametrize("late", ["recalculate", "larsen"])
@pytest.mark.parametrize("y", [[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0]])
def test_a_measured_attitude_is_a_unit_quaternion(y: list[float], late: Late) -> None:
    stars = extended_corrector(cases.attitude, np.eye(3), observed=space(4, attitudes=[0]))
    case = cases.attitude_case(extended_predictor, Sensor("stars", stars))
    with pytest.raises(ValueError, match=r"sensor 'stars', measurement of step 1, .* no unit quaternion; divide it by"):
        run(case.composed, case.x0, case.P0, case.inputs(3), [Measurement("stars", 1, 1, y)], late=late)


def test_functions_of_sensors_are_tried_although_there_is_no_step() -> None:
    with pytest.raises(ValueError, match=r"sensor 's': h\(x, out\) failed: IndexError"):
        filtered(STILL, extended_corrector(lambda _x, out: out.__setitem__(7, 0.0), [[1.0]]), steps=0)
