"""What no measurement ever says is left out where outputs do not depend on it, and refused where they do."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, linear_model, lossless, with_low_rate_noise
from filters.accuracy.van_loan import discretised
from filters.accuracy.visible import visible
from tests.filters.accuracy.cases import INS, POSITION, all_outputs, models


def hovering() -> LinearModel:
    """The inertial model of `cases.INS` standing still: gravity is along the axis of yaw."""
    force = np.array([[0.0, -9.81, 0.0], [9.81, 0.0, 0.0], [0.0, 0.0, 0.0]])
    A = np.zeros((9, 9))
    A[:3, 3:6], A[3:6, 6:] = np.eye(3), -force
    Phi, Q = discretised(A, np.diag([0.0] * 3 + [0.035**2] * 3 + [0.0015**2] * 3), 1 / 400)
    names = [f"{what} {axis}" for what in ("position", "velocity", "tilt") for axis in "xyz"]
    return linear_model(Phi, Q, INS.H, INS.R, names)


def test_hovering_the_position_is_right_although_yaw_is_never_seen() -> None:
    model = hovering()
    kept = [0, 1, 2, 3, 4, 5, 6, 7]
    without = linear_model(*(matrix[np.ix_(kept, kept)] for matrix in model[:2]), model.H[:, kept], model.R)
    for L in (44, 80):
        found, expected = lossless(model, POSITION, 80, L), lossless(without, POSITION, 80, L)
        np.testing.assert_allclose(found[4:8], expected[4:8], rtol=1e-9)
    found, expected = (with_low_rate_noise(each, POSITION, 80, 60, "sum") for each in (model, without))
    np.testing.assert_allclose(found[4:9], expected[4:9], rtol=1e-9)


@pytest.mark.parametrize("outputs", [[8], [0, 8], [6, 7, 8]])
def test_hovering_yaw_is_refused_by_name(outputs: list[int]) -> None:
    with pytest.raises(
        ValueError,
        match=r"no measurement ever says anything of a mode of tilt z that does not decay, and the outputs depend on "
        r"it: their variance grows without bound; measure it, or ask for other outputs",
    ):
        lossless(hovering(), outputs, 80, 44)


def test_states_without_names_are_named_by_their_numbers() -> None:
    with pytest.raises(ValueError, match="a mode of state 1 that does not decay"):
        lossless(linear_model(np.eye(2), np.eye(2), [[1, 0]], [[1]]), [1], 3, 1)


def test_what_is_not_seen_but_decays_is_kept() -> None:
    model = linear_model(np.diag([1, 0.5]), np.eye(2), [[1, 0]], [[1]])
    left, _ = visible(model, all_outputs(model))
    assert left is model
    assert lossless(model, [1], 3, 2).worst ** 2 == pytest.approx(1 / (1 - 0.25))


@given(models(), st.floats(1.0, 1.2), st.integers(0, 2**31 - 1))
def test_a_hidden_mode_that_outputs_do_not_depend_on_changes_nothing(
    model: LinearModel, growth: float, seed: int
) -> None:
    """It may be driven by all else, and mixed with it by any change of states."""
    n, p = model.states, len(model.H)
    random = np.random.default_rng(seed)
    mixed = np.linalg.qr(random.normal(size=(n + 1, n + 1)))[0]
    Phi, Q = np.zeros((n + 1, n + 1)), np.eye(n + 1)
    Phi[:n, :n], Phi[n, :n], Phi[n, n] = model.Phi, random.normal(size=n), growth
    Q[:n, :n] = model.Q
    H = np.hstack([model.H, np.zeros((p, 1))])
    more = linear_model(mixed @ Phi @ mixed.T, mixed @ Q @ mixed.T, H @ mixed.T, model.R)
    found = lossless(more, np.eye(n, n + 1) @ mixed.T, 4, 6)
    np.testing.assert_allclose(found[4:8], lossless(model, np.eye(n), 4, 6)[4:8], rtol=1e-7)


def test_a_mode_that_goes_unseen_at_some_interval_is_refused_there() -> None:
    """A quarter turn in a step: every second step, one of the two is never measured."""
    model = linear_model([[0, -1], [1, 0]], np.eye(2), [[1, 0]], [[1]])
    assert lossless(model, [0, 1], 3, 1).verdict == "exact"
    with pytest.raises(
        ValueError, match=r"with a measurement every N=2 steps a mode of state 1 .* goes unseen.*take another N"
    ):
        lossless(model, [0, 1], 2, 1)
