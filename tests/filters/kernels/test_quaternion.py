"""Attitudes as quaternions, against SciPy's rotations."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from filters.arrays import FloatArray
from filters.kernels.quaternion import SMALL, rotate, rotate_back, rotation_between, turn

AT, START = 2, 1
"""Where quaternions and vectors lie in longer arrays; their neighbours must not matter, nor be touched."""

parts = st.floats(-1.0, 1.0)
directions = st.tuples(parts, parts, parts).map(np.array).filter(lambda v: bool(np.linalg.norm(v) > 0.1))
quaternions = (
    st.tuples(parts, parts, parts, parts)
    .map(np.array)
    .filter(lambda q: bool(np.linalg.norm(q) > 0.1))
    .map(lambda q: np.asarray(q / np.linalg.norm(q)))
)
angles = st.one_of(
    st.floats(0.0, np.pi),
    st.floats(-16.0, -2.0).map(lambda power: float(10.0**power)),  # near 0, on both sides of where series end
    st.floats(-12.0, -2.0).map(lambda power: float(np.pi - 10.0**power)),
)


def vector(direction: FloatArray, angle: float) -> FloatArray:
    """The rotation vector of this angle."""
    return np.asarray(direction * (angle / np.linalg.norm(direction)))


def placed(values: FloatArray, at: int) -> FloatArray:
    return np.concatenate([np.full(at, np.nan), values, [np.nan]])


def turned(q: FloatArray, v: FloatArray) -> FloatArray:
    out = np.full(AT + 5, np.nan)
    turn(placed(q, AT), AT, placed(v, START), START, out)
    assert np.isnan(np.delete(out, range(AT, AT + 4))).all()
    return out[AT : AT + 4]


def between(a: FloatArray, b: FloatArray) -> FloatArray:
    out = np.full(START + 4, np.nan)
    rotation_between(placed(a, AT), placed(b, AT), AT, out, START)
    assert np.isnan(np.delete(out, range(START, START + 3))).all()
    return out[START : START + 3]


def scipy_rotation(q: FloatArray) -> Rotation:
    return Rotation.from_quat(q, scalar_first=True)


def same_attitude(a: FloatArray, b: FloatArray) -> bool:
    return min(float(np.abs(a - b).max()), float(np.abs(a + b).max())) < 1e-14


@given(quaternions, directions, st.floats(0.0, 10.0))
def test_turned_by_a_vector_of_the_body_as_scipy_does(q: FloatArray, direction: FloatArray, angle: float) -> None:
    v = vector(direction, angle)
    expected = scipy_rotation(q) * Rotation.from_rotvec(v)
    assert same_attitude(turned(q, v), expected.as_quat(scalar_first=True))


@given(quaternions, quaternions)
def test_the_rotation_between_is_scipys(a: FloatArray, b: FloatArray) -> None:
    expected = (scipy_rotation(b).inv() * scipy_rotation(a)).as_rotvec()
    found = between(a, b)
    if np.linalg.norm(expected) > np.pi - 1e-6 and found @ expected < 0:  # half a turn, the other way round
        expected *= 1.0 - 2.0 * np.pi / np.linalg.norm(expected)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


@given(quaternions, directions, angles)
def test_the_rotation_between_undoes_a_turn(q: FloatArray, direction: FloatArray, angle: float) -> None:
    v = vector(direction, angle)
    np.testing.assert_allclose(between(turned(q, v), q), v, rtol=0, atol=1e-14 if angle < 1 else 1e-12)


@given(quaternions, quaternions)
def test_a_turn_undoes_the_rotation_between(a: FloatArray, b: FloatArray) -> None:
    assert same_attitude(turned(b, between(a, b)), a)
    assert np.linalg.norm(between(a, b)) <= np.pi + 4e-15


@given(quaternions, quaternions)
def test_a_quaternion_and_its_negative_are_one_attitude(a: FloatArray, b: FloatArray) -> None:
    expected = between(a, b)
    if abs(a @ b) > 1e-12:  # less: exactly half a turn, where both ways round are as short
        np.testing.assert_array_equal(between(-a, b), expected)
        np.testing.assert_array_equal(between(a, -b), expected)


@given(directions, st.floats(-12.0, 0.0))
def test_small_turns_are_relatively_exact(direction: FloatArray, power: float) -> None:
    """From no turn at all nothing is rounded away, wherever the series begins."""
    v, none = vector(direction, 10.0**power), np.array([1.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(between(turned(none, v), none), v, rtol=4e-15, atol=1e-300)


@pytest.mark.parametrize("side", [1 - 1e-9, 1 + 1e-9])
def test_the_series_meets_the_function(side: float) -> None:
    angle, none = np.sqrt(SMALL) * side, np.array([1.0, 0.0, 0.0, 0.0])
    q = turned(none, np.array([0.0, angle, 0.0]))
    np.testing.assert_allclose(q, [np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0], rtol=1e-14, atol=1e-18)
    np.testing.assert_allclose(between(q, none), [0.0, angle, 0.0], rtol=1e-14, atol=1e-18)


@given(quaternions, directions, angles, st.floats(0.1, 10.0))
def test_length_is_one_whatever_it_was(q: FloatArray, direction: FloatArray, angle: float, length: float) -> None:
    v = vector(direction, angle)
    found = turned(length * q, v)
    assert np.linalg.norm(found) == pytest.approx(1.0, abs=4e-15)
    np.testing.assert_allclose(found, turned(q, v), rtol=0, atol=4e-15)


def test_rounding_does_not_add_up() -> None:
    """A turn about one axis in a hundred thousand steps, in place, is the whole turn."""
    x, step = np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 1e-4])
    for _ in range(100_000):
        turn(x, 0, step, 0, x)
    assert np.linalg.norm(x) == pytest.approx(1.0, abs=4e-15)
    np.testing.assert_allclose(x, [np.cos(5.0), 0.0, 0.0, np.sin(5.0)], rtol=0, atol=1e-11)


@given(quaternions, directions)
def test_vectors_are_rotated_as_scipy_does_and_back(q: FloatArray, v: FloatArray) -> None:
    out, back = np.empty(3), np.empty(3)
    rotate(placed(q, AT), AT, placed(v, START), START, out)
    np.testing.assert_allclose(out, scipy_rotation(q).apply(v), rtol=0, atol=4e-15)
    rotate_back(placed(q, AT), AT, placed(v, START), START, back)
    np.testing.assert_allclose(back, scipy_rotation(q).inv().apply(v), rtol=0, atol=4e-15)
    rotate_back(q, 0, out, 0, out)
    np.testing.assert_allclose(out, v, rtol=0, atol=8e-15)
