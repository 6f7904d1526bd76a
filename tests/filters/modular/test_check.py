"""A singular covariance to start from: states that are known exactly, or go together."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.delayed import dual_rate, larsen, standard
from filters.modular import ModularFilter, run, unscented_corrector, unscented_predictor
from filters.modular.updates import UPDATES, UpdateName
from tests.filters.modular import cases
from tests.filters.modular.cases import CASES, ONE_SENSOR, Case, measured, measured_rows, with_timing

STEPS = 13
SINGULAR: list[Any] = [
    [[0.0, 0.0], [0.0, 0.0]],
    [[1.0, 0.0], [0.0, 0.0]],
    [[0.0, 0.0], [0.0, 1.0]],
    [[1.0, -0.5], [-0.5, 0.25]],
]
each_start = pytest.mark.parametrize("P0", SINGULAR)


def moved(x: FloatArray, u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = cases.F @ x + cases.B @ u


def position(x: FloatArray, out: FloatArray) -> None:
    out[:] = cases.H_POSITION @ x


def still(case: Case) -> Case:
    """Without process noise, so that what is known stays so."""
    composed = case.composed
    motion = composed.predictor.motion
    predictor = composed.predictor._replace(motion=motion._replace(Q=0.0 * motion.Q))
    return case._replace(composed=replace(composed, predictor=predictor))


@each_start
@pytest.mark.parametrize("name", ONE_SENSOR)
@pytest.mark.parametrize("update", UPDATES)
@pytest.mark.parametrize("noise", [True, False])
def test_it_is_the_standard_filter(P0: Any, name: str, update: UpdateName, noise: bool) -> None:
    case, system = with_timing(ONE_SENSOR[name], 1, 0)
    measurements = measured(case, STEPS)
    case = case if noise else still(case)
    system = system if noise else system._replace(Q=lambda _j, _p: np.zeros((2, 2)))
    composed = replace(case.composed, update=update)
    found = run(composed, case.x0, P0, case.inputs(STEPS), measurements)
    expected = standard.run(system, 1, 0, 0, case.x0, P0, case.inputs(STEPS), measured_rows(measurements))
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-12)
    assert (np.linalg.eigvalsh(found.P) > -1e-12).all()


@each_start
def test_sigma_points_of_a_linear_model_are_the_linear_filter(P0: Any) -> None:
    case, _ = with_timing(ONE_SENSOR["linear"], 1, 0)
    (sensor,) = case.composed.sensors
    seen = replace(sensor, corrector=unscented_corrector(position, cases.R_POSITION))
    points = ModularFilter(unscented_predictor(moved, cases.Q), [seen])
    measurements = measured(case, STEPS)
    found, expected = (
        run(composed, case.x0, P0, case.inputs(STEPS), measurements) for composed in (points, case.composed)
    )
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.P, expected.P, rtol=0, atol=1e-12)


@each_start
@pytest.mark.parametrize("name", ONE_SENSOR)
def test_late_measurements(P0: Any, name: str) -> None:
    case, system = with_timing(ONE_SENSOR[name], 4, 2)
    measurements = measured(case, STEPS)
    given: Any = (case.x0, P0, case.inputs(STEPS))
    for late, fixed, L in (("larsen", larsen, 2), ("dual-rate", dual_rate, 3)):
        options: Any = {"late": late} | ({"L": L} if late == "dual-rate" else {})
        found = run(case.composed, *given, measurements, **options)
        expected = fixed.run(system, 4, 2, L, *given, measured_rows(measurements))
        np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-10)


def test_an_attitude_that_is_known() -> None:
    case = CASES["attitude"]
    known = np.diag([0.0] * 3 + [1e-3] * 3)
    found = run(case.composed, case.x0, known, case.inputs(STEPS), measured(case, STEPS))
    assert np.isfinite(found.x).all()
    assert (np.linalg.eigvalsh(found.P) > -1e-12).all()
