"""The attitude model against printed values, finite differences, one hand-checked robust step, and gimbal lock.

Expected numbers were computed independently of this code, from the textbook formulas of the module's docstring.
"""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.choose import BACKENDS, BackendName
from filters.robust import extended as extended_robust
from filters.robust.blocks import block_sizes
from filters.robust.model import prepared
from filters.robust.uncertain import UncertainSystem, linearised
from filters.systems.attitude import (
    ATTITUDE_ROWS,
    AttitudeRows,
    attitude,
    attitude_scaling,
    attitude_uncertainty,
    wrapped,
    write_rate_matrix,
)

X = np.array([0.1, -0.05, 1.2, 0.01, -0.02, 0.03])
RATES = np.array([0.2, -0.1, 0.3])


def next_state(system: UncertainSystem, x: FloatArray, u: FloatArray) -> FloatArray:
    out = np.full_like(x, np.nan)
    system.f(x, u, system.parameters, out)
    return out


def jacobian(system: UncertainSystem, x: FloatArray, u: FloatArray) -> FloatArray:
    out = np.full((len(x), len(x)), np.nan)
    system.F(x, u, system.parameters, out)
    return out


def noise_matrix(system: UncertainSystem, x: FloatArray, u: FloatArray) -> FloatArray:
    out = np.full((len(x), len(system.Q)), np.nan)
    system.G(x, u, system.parameters, out)
    return out


def test_rate_matrix() -> None:
    T = np.empty((3, 3))
    write_rate_matrix(1.0, X[0], X[1], T)
    expected = [[1, -0.0049958347, -0.0497917083], [0, 0.9950041653, -0.0998334166], [0, 0.0999583385, 0.9962492174]]
    np.testing.assert_allclose(T, expected, rtol=0, atol=5.1e-11)


def test_next_state() -> None:
    expected = [0.1004423898, -0.0502663884, 1.2006524766, 0.009999875, -0.01999975, 0.029999625]
    np.testing.assert_allclose(next_state(attitude(), X, RATES), expected, rtol=0, atol=5.1e-10)


def test_jacobian() -> None:
    F = jacobian(attitude(), X, RATES)
    expected = {
        (0, 0): (1.0000133305, 10),
        (0, 1): (6.5329300e-4, 11),
        (1, 0): (-6.5166113e-4, 11),
        (2, 0): (-2.6672172e-4, 11),
        (2, 1): (-3.2651041e-5, 12),
        (3, 3): (0.99998750008, 11),
    }
    for entry, (value, digits) in expected.items():
        assert F[entry] == pytest.approx(value, rel=0, abs=0.51 * 10.0**-digits), entry


def test_matrices_are_the_derivatives() -> None:
    system, step = attitude(), 1e-6
    x, u = np.array([0.3, -0.4, 2.0, 0.05, -0.1, 0.08]), np.array([0.4, -0.7, 0.9])
    by_state = [next_state(system, x + d, u) - next_state(system, x - d, u) for d in step * np.eye(6)]
    np.testing.assert_allclose(jacobian(system, x, u), np.array(by_state).T / (2 * step), atol=1e-9)
    by_noise = [next_state(system, x, u - d) - next_state(system, x, u + d) for d in step * np.eye(3)]
    np.testing.assert_allclose(noise_matrix(system, x, u)[:, :3], np.array(by_noise).T / (2 * step), atol=1e-9)
    np.testing.assert_array_equal(noise_matrix(system, x, u)[:, 3:], np.eye(6, 3, -3))


@pytest.mark.parametrize(
    "backend", [pytest.param(name, marks=pytest.mark.exhaust if name == "compiled" else ()) for name in BACKENDS]
)
def test_one_robust_step(backend: BackendName) -> None:
    """In the limit of an infinite mu, with one uncertain row on the biases."""
    uncertainty = attitude_uncertainty("bias")
    uncertainty.E_F[0] = [0, 0, 0, 2e-6, 2e-6, 2e-6]
    uncertainty.E_G[0] = [0, 0, 0, 15, 15, 15]
    history = extended_robust.run(
        attitude(),
        attitude_scaling(),
        uncertainty,
        1,
        X,
        np.diag([1.0, 1.0, 1.0, 0.25, 0.25, 0.25]),
        RATES[np.newaxis],
        np.array([[0.102, -0.047, 1.21]]),
        backend=backend,
    )
    expected = [10.204397911, -4.786743094, 120.165197157, 0.999973871, -1.999988630, 2.999948871]
    np.testing.assert_allclose(history.scaled_x[1], expected, rtol=0, atol=5.1e-10)
    np.testing.assert_allclose(history.x[1], 0.01 * np.array(expected), rtol=0, atol=5.1e-12)
    assert np.trace(history.P[1]) == pytest.approx(2.049996692, rel=0, abs=5.1e-10)


def test_uncertain_rows() -> None:
    gyro, bias, everything = (attitude_uncertainty(rows) for rows in ("gyro", "bias", "all"))
    np.testing.assert_allclose(gyro.E_F, [[0, 0, 0, *3 * [-0.02 / 400 / 3]]], atol=1e-15)
    np.testing.assert_allclose(gyro.E_G, [[*3 * [-0.02 / 400 / 3 / 0.01], 0, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(bias.E_F, [[0, 0, 0, *3 * [0.5 / 400 / 200 / 3]]], atol=1e-15)
    np.testing.assert_allclose(bias.E_G, [[0, 0, 0, *3 * [0.5 / 3 / 0.01]]], atol=1e-15)
    assert not bias.E_H.any()
    np.testing.assert_allclose(everything.E_H, [[0, 0, 1e-3, 0, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(everything.E_D, [[0, 0, 0.5]], atol=1e-15)
    assert attitude_uncertainty("none").E_F.shape == (0, 6)


@pytest.mark.parametrize(("rows", "unknowns"), [("none", 45), ("gyro", 46), ("bias", 46), ("all", 47)])
def test_size_of_the_block_system(rows: AttitudeRows, unknowns: int) -> None:
    model = linearised(attitude(), attitude_scaling(), attitude_uncertainty(rows), X, RATES)
    assert sum(block_sizes(prepared(model))) == unknowns


def test_angles_are_wrapped() -> None:
    assert wrapped(3.5) == pytest.approx(3.5 - 2 * np.pi)
    assert wrapped(-7.0) == pytest.approx(2 * np.pi - 7.0)
    assert wrapped(np.pi) == wrapped(-np.pi) == np.pi
    residual = np.empty(3)
    attitude().residual(np.array([0.0, 0.0, -3.1]), np.array([0.0, 0.0, 3.1 + 2 * np.pi, 0.0, 0.0, 0.0]), residual)
    assert residual[2] == pytest.approx(2 * np.pi - 6.2)


@pytest.mark.parametrize(
    "backend", [pytest.param(name, marks=pytest.mark.exhaust if name == "compiled" else ()) for name in BACKENDS]
)
def test_gimbal_lock_is_named(backend: BackendName) -> None:
    start = np.array([0.0, np.radians(89.0), 0.0, 0.0, 0.0, 0.0])
    pitching_up, seen = np.tile([0.0, 1.0, 0.0], (20, 1)), np.tile(start[:3], (20, 1))
    with pytest.raises(ValueError, match=r"pitch is within .* of 90 degrees.*choose body axes"):
        extended_robust.run(
            attitude(), attitude_scaling(), attitude_uncertainty("none"), 20, start, np.eye(6), pitching_up, seen,
            backend=backend,
        )  # fmt: skip


def test_bad_input_is_named() -> None:
    with pytest.raises(ValueError, match=r"gyro_sigma=0.*must all be positive"):
        attitude(gyro_sigma=0.0)
    with pytest.raises(ValueError, match="rows='gyros' is unknown"):
        attitude_uncertainty("gyros")
    assert ATTITUDE_ROWS == ("none", "gyro", "bias", "all")
    with pytest.raises(ValueError, match="3 steps need 3 rows of measurements and availability; there are 2 and 3"):
        extended_robust.run(
            attitude(), attitude_scaling(), attitude_uncertainty("none"), 1, X, np.eye(6), np.zeros((3, 3)),
            np.zeros((2, 3)),
        )  # fmt: skip
