"""The position model against printed values, finite differences, a step without a fix, and the poles.

Expected numbers were computed independently of this code, from the textbook formulas of the module's docstring.
"""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.robust import extended as extended_robust
from filters.robust.blocks import block_sizes
from filters.robust.model import prepared, without_measurement
from filters.robust.uncertain import UncertainSystem, linearised
from filters.systems.position import (
    curvature_radii,
    gravity,
    position,
    position_scaling,
    position_uncertainty,
    write_body_to_ned,
)

LATITUDE, LONGITUDE, HEIGHT = np.radians(-22.0075), np.radians(-47.8909), 850.0
X = np.array([LATITUDE, LONGITUDE, HEIGHT, 8, -5, 0.3, 0.04, -0.03, 0.05])
U = np.array([0.5, -0.2, -9.7, 0.02, -0.03, 0.6])


def model() -> UncertainSystem:
    return position(LATITUDE, HEIGHT)


def next_state(x: FloatArray, u: FloatArray) -> FloatArray:
    out = np.full_like(x, np.nan)
    model().f(x, u, model().parameters, out)
    return out


def jacobian(x: FloatArray, u: FloatArray) -> FloatArray:
    out = np.full((9, 9), np.nan)
    model().F(x, u, model().parameters, out)
    return out


def test_earth() -> None:
    meridian, transverse = curvature_radii(LATITUDE)
    assert meridian == pytest.approx(6344383.107595, rel=0, abs=5.1e-7)
    assert transverse == pytest.approx(6381136.941057, rel=0, abs=5.1e-7)
    assert gravity(LATITUDE, HEIGHT) == pytest.approx(9.7849567717, rel=0, abs=5.1e-11)


def test_next_state() -> None:
    expected = [
        -0.38410333198068, -0.835853888855923, 849.99925, 8.00151691495617, -4.99888643226586, 0.30012923171685,
        0.0399996666680556, -0.0299997500010417, 0.0499995833350694,
    ]  # fmt: skip
    np.testing.assert_allclose(next_state(X, U), expected, rtol=1e-14, atol=0)


def test_jacobian() -> None:
    F = jacobian(X, U)
    expected = {
        (0, 3): 3.939965573538e-10,
        (1, 4): 4.225141030788e-10,
        (1, 0): 8.489382343754e-10,
        (3, 6): -2.062410604343e-3,
        (3, 7): 1.412561606872e-3,
    }
    for entry, value in expected.items():
        assert F[entry] == pytest.approx(value, rel=5e-13), entry


def test_matrices_are_the_derivatives() -> None:
    """In scaled units. The change of gravity with height, 3.1e-6 per second squared, is not in F."""
    unit = position_scaling(LATITUDE, LONGITUDE, HEIGHT).unit
    steps = np.array([1e3, 1e3, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    by_state = [
        (next_state(X + d * unit * e, U) - next_state(X - d * unit * e, U)) / (2 * d)
        for d, e in zip(steps, np.eye(9), strict=True)
    ]
    found = jacobian(X, U) * unit
    np.testing.assert_allclose(found / unit[:, np.newaxis], (np.array(by_state) / unit).T, rtol=0, atol=1e-8)

    G = np.full((9, 6), np.nan)
    model().G(X, U, model().parameters, G)
    by_noise = [
        next_state(X, U - np.append(d, [0, 0, 0])) - next_state(X, U + np.append(d, [0, 0, 0])) for d in np.eye(3)
    ]
    np.testing.assert_allclose(G[:, :3], np.array(by_noise).T / 2, atol=1e-12)
    np.testing.assert_array_equal(G[:, 3:], np.eye(9, 3, -6))


def test_coriolis_of_the_map_is_in_the_jacobian() -> None:
    """Rows 0 and 1 by differences with steps of 10 km, relatively."""
    d = np.zeros(9)
    d[0] = 1.6e-3
    change = (next_state(X + d, U) - next_state(X - d, U)) / (2 * d[0])
    assert jacobian(X, U)[0, 0] - 1 == pytest.approx(change[0] - 1, rel=1e-3)
    assert jacobian(X, U)[1, 0] == pytest.approx(change[1], rel=1e-5)


def test_body_axes() -> None:
    C = np.empty((3, 3))
    write_body_to_ned(1.0, 0.02, -0.03, 0.6, C)
    np.testing.assert_allclose(C @ C.T, np.eye(3), atol=4e-15)
    write_body_to_ned(1.0, 0.0, 0.1, np.pi / 2, C)
    np.testing.assert_allclose(C[:, 0], [0, np.cos(0.1), -np.sin(0.1)], atol=4e-15)  # forward: east and up
    many = np.empty((3, 3, 2))
    write_body_to_ned(1.0, np.array([0.3, 0.0]), np.array([0.2, 0.1]), np.array([-2.0, np.pi / 2]), many)
    np.testing.assert_array_equal(many[..., 1], C)


def test_uncertain_rows_and_size_of_the_block_system() -> None:
    """At a fix N = 67, between fixes 49."""
    scaling = position_scaling(LATITUDE, LONGITUDE, HEIGHT)
    for rows in ("accelerometer", "bias"):
        at_fix = prepared(linearised(model(), scaling, position_uncertainty(rows), X, U))
        assert sum(block_sizes(at_fix)) == 67
        assert sum(block_sizes(prepared(without_measurement(at_fix)))) == 49
    bias = position_uncertainty("bias")
    np.testing.assert_allclose(bias.E_F[0, 6:], 0.5 / 400 / 300 / 3)
    np.testing.assert_allclose(bias.E_G[0, 3:], 0.5 / 3 / 0.1)


@pytest.mark.parametrize("backend", ["reference", "numpy", pytest.param("compiled", marks=pytest.mark.exhaust)])
def test_without_a_fix_the_state_follows_the_model(backend: BackendName) -> None:
    scaling = position_scaling(LATITUDE, LONGITUDE, HEIGHT)
    found = extended_robust.run(
        model(), scaling, position_uncertainty("none"), 40, X, np.eye(9), np.tile(U, (3, 1)), np.zeros((1, 6)),
        np.array([False]), backend=backend,
    )  # fmt: skip
    expected = next_state(next_state(next_state(X, U), U), U)
    np.testing.assert_allclose((found.x[3] - expected) / scaling.unit, 0, atol=1e-8)


def test_poles_are_named() -> None:
    near = np.pi / 2 - 1e-5
    for call in (
        lambda: position(near, 0.0),
        lambda: position_scaling(-near, 0.0, 0.0),
        lambda: next_state(np.array([near, *X[1:]]), U),
    ):
        with pytest.raises(ValueError, match=r"within .* of a pole.*work in a local frame"):
            call()


def test_bad_input_is_named() -> None:
    with pytest.raises(ValueError, match="must all be positive"):
        position(LATITUDE, HEIGHT, velocity_sigma=-1.0)
    with pytest.raises(ValueError, match="rows='all' is unknown"):
        position_uncertainty("all")
