"""A modular filter as a linear model: its matrices are the Jacobians at its start, of every kind of part."""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.modular import (
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    space,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.linearised import linearised_filter

X0, P0, U, DT = np.array([10.0, 5.0, 0.3]), np.diag([9.0, 4.0, 0.04]), np.array([0.1]), 0.01
Q = np.diag([1e-4, 1e-4, 1e-6])


def drive(x: FloatArray, u: FloatArray, dt: float, out: FloatArray) -> None:
    out[0] = x[0] + dt * 8.0 * np.sin(x[2])
    out[1] = x[1] + dt * 8.0 * np.cos(x[2])
    out[2] = x[2] + dt * u[0]


def distance(x: FloatArray, out: FloatArray) -> None:
    out[0] = np.sqrt(x[0] ** 2 + x[1] ** 2)


EXPECTED_F = np.array([[1, 0, DT * 8 * np.cos(0.3)], [0, 1, -DT * 8 * np.sin(0.3)], [0, 0, 1]])
EXPECTED_H = np.array([[10, 5, 0]]) / np.sqrt(125)


@pytest.mark.parametrize("predictor", [extended_predictor(drive, Q), unscented_predictor(drive, Q)])
@pytest.mark.parametrize("corrector", [extended_corrector(distance, [[0.5]]), unscented_corrector(distance, [[0.5]])])
def test_its_matrices_are_the_jacobians_at_the_start(predictor, corrector) -> None:  # type: ignore[no-untyped-def]
    gps = linear_corrector(np.eye(2, 3), np.eye(2))
    composed = ModularFilter(predictor, [Sensor("gps", gps), Sensor("beacon", corrector)], DT)
    found = linearised_filter(composed, X0, P0, U)
    np.testing.assert_allclose(found.Phi, EXPECTED_F, atol=1e-6)
    np.testing.assert_allclose(found.Q, Q)
    assert [*found.sensors] == ["gps", "beacon"]
    np.testing.assert_allclose(found.sensors["gps"][0], np.eye(2, 3))
    np.testing.assert_allclose(found.sensors["beacon"][0], EXPECTED_H, atol=1e-6)
    assert found.sensors["beacon"][1].tolist() == [[0.5]]


def test_a_linear_one_is_itself_and_starts_at_zero() -> None:
    F = np.array([[1.0, 0.1], [0.0, 1.0]])
    composed = ModularFilter(
        linear_predictor(F, np.eye(2), [[0.0], [1.0]]), [Sensor("gps", linear_corrector([[1.0, 0.0]], [[2.0]]))]
    )
    found = linearised_filter(composed)
    assert (found.Phi.tolist(), found.sensors["gps"][0].tolist()) == (F.tolist(), [[1.0, 0.0]])


def test_of_an_attitude_the_error_has_three_numbers() -> None:
    def turn(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        for i in range(4):
            out[i] = x[i]

    def up(x: FloatArray, out: FloatArray) -> None:
        out[0] = 2.0 * (x[1] * x[3] - x[0] * x[2])

    composed = ModularFilter(
        extended_predictor(turn, np.eye(3)),
        [Sensor("level", extended_corrector(up, [[1.0]]))],
        of=space(4, attitudes=[0]),
    )
    found = linearised_filter(composed)
    np.testing.assert_allclose(found.Phi, np.eye(3), atol=1e-9)
    np.testing.assert_allclose(np.abs(found.sensors["level"][0]), [[0, 1, 0]], atol=1e-6)


def test_a_start_that_does_not_fit_is_named() -> None:
    composed = ModularFilter(extended_predictor(drive, Q), [Sensor("gps", linear_corrector(np.eye(2, 3), np.eye(2)))])
    with pytest.raises(ValueError, match="x0 has shape"):
        linearised_filter(composed, [1.0, 2.0])
