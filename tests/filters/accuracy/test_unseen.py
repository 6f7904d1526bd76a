"""What goes unseen at the rhythm of the measurements is refused, and nothing else is said to."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from filters.accuracy import (
    LinearModel,
    fused_as_fresh,
    linear_model,
    lossless,
    lossless_designs,
    px4_predictor,
    with_low_rate_noise,
)
from tests.filters.accuracy.cases import CV, INS, POSITION

UNSEEN = r"every N={} steps a mode of state 1 that does not decay goes unseen.*take another N"


def turning(angle: float) -> LinearModel:
    c, s = np.cos(angle), np.sin(angle)
    return linear_model([[c, -s], [s, c]], 1e-4 * np.eye(2), [[1, 0]], [[0.04]])


@pytest.mark.parametrize("N", [10, 20, 40, 80, 10_000])
def test_half_turns_between_measurements_hide_a_mode(N: int) -> None:
    with pytest.raises(ValueError, match=UNSEEN.format(N)):
        lossless(turning(2 * np.pi / 20), [0], N, 4)


def test_so_is_it_among_many_intervals_and_with_other_methods() -> None:
    model = turning(2 * np.pi / 20)
    with pytest.raises(ValueError, match=UNSEEN.format(10)):
        lossless_designs(model, [0], [9, 10, 11], 4)
    with pytest.raises(ValueError, match=UNSEEN.format(10)):
        with_low_rate_noise(model, [0], 10, 4, "sum")
    with pytest.raises(ValueError, match=UNSEEN.format(20)):
        px4_predictor(model, [0], 20, 4, 0.1)
    with pytest.raises(ValueError, match=UNSEEN.format(20)):
        fused_as_fresh(model, [0], 20, 4, [1.0])


def test_a_pattern_of_intervals_may_hide_one_too() -> None:
    """Three states in turn, measured in two steps of three."""
    model = linear_model(np.roll(np.eye(3), 1, axis=0), np.eye(3), [[1, 0, 0]], [[1]])
    with pytest.raises(ValueError, match="goes unseen"):
        lossless(model, [0], Fraction(3, 2), 1)
    assert lossless(model, [0], Fraction(4, 3), 1).verdict == "exact"


@pytest.mark.parametrize("N", [9, 11, Fraction(21, 2), 10 + Fraction(1, 10)])
def test_a_step_away_all_is_seen(N: int | Fraction) -> None:
    assert lossless(turning(2 * np.pi / 20), [0], N, 4).worst < 0.2


def test_turns_that_are_no_half_turns_are_seen_however_little() -> None:
    assert 1 < lossless(turning(2 * np.pi / 20 * (1 + 1e-6)), [0], 10, 4).worst < 100


def test_outputs_that_do_not_depend_on_it_are_right() -> None:
    turn, walk = turning(2 * np.pi / 20), np.eye(1)
    Phi, Q = np.zeros((3, 3)), np.zeros((3, 3))
    Phi[:2, :2], Phi[2:, 2:], Q[:2, :2], Q[2:, 2:] = turn.Phi, walk, turn.Q, walk
    model = linear_model(Phi, Q, [[1, 0, 0], [0, 0, 1]], np.diag([0.04, 1.0]))
    alone = linear_model([[1]], [[1]], [[1]], [[1]])
    assert lossless(model, [2], 10, 4).worst == pytest.approx(lossless(alone, [0], 10, 4).worst)


def test_a_cosine_of_a_right_angle_sees_nothing() -> None:
    pendulum = linear_model([[1, 0.01], [0, 1]], 1e-4 * np.eye(2), [[np.cos(np.pi / 2), 0]], [[0.01]])
    with pytest.raises(ValueError, match="no measurement ever says anything of a mode of state"):
        lossless(pendulum, [0], 10, 4)


@pytest.mark.parametrize("units", [1e-12, 1e-6, 1e6])
def test_small_units_are_seen(units: float) -> None:
    model = linear_model(CV.Phi, CV.Q * units**2, CV.H / units * 1e-9, CV.R * 1e-18)
    assert lossless(model, [0], 10, 4).worst == pytest.approx(lossless(CV, [0], 10, 4).worst * units, rel=1e-6)


def test_all_intervals_of_the_inertial_model_are_seen() -> None:
    lossless_designs(INS, POSITION, np.arange(1, 200), 44)


@pytest.mark.parametrize("N", [18, 20, 30])
def test_what_is_lost_in_rounding_is_not_said_to_go_unseen(N: int) -> None:
    model = linear_model([[3, 0.01], [0, 2]], np.eye(2), [[1, 0]], [[1]])
    with pytest.raises(ValueError, match=r"is lost in rounding: .* grows by a factor of .*; take a smaller N"):
        lossless(model, [0], N, 1)


def test_before_that_it_is_right() -> None:
    model = linear_model([[3, 0.01], [0, 2]], np.eye(2), [[1, 0]], [[1]])
    assert lossless(model, [0], 10, 1).worst == pytest.approx(64134230.89619931, rel=1e-8)  # in 150 digits


def test_a_mode_that_grows_and_that_no_noise_stirs_is_not_known_for_ever() -> None:
    with pytest.raises(ValueError, match=r"does not settle with a measurement every N=3 steps: .* no noise stirs it"):
        lossless(linear_model([[1.1]], [[0]], [[1]], [[1]]), [0], 3, 1)


def test_without_noise_the_gain_goes_to_zero_and_so_do_the_variances() -> None:
    constant = linear_model([[1]], [[0]], [[1]], [[1]])
    assert lossless(constant, [0], 3, 1).worst == 0.0
    predicted = px4_predictor(constant, [0], 3, 1, 0.1)
    assert (predicted.worst, predicted.verdict) == (0.0, "approximate")
    for ask in (
        lambda: with_low_rate_noise(constant, [0], 3, 1, "sum"),
        lambda: with_low_rate_noise(constant, [0], Fraction(7, 2), 1, "sum"),
        lambda: fused_as_fresh(constant, [0], 3, 1, [1.0]),
    ):
        with pytest.raises(ValueError, match=r"its gain goes to zero .*give it a noise"):
            ask()


@pytest.mark.parametrize("N", [80, Fraction(161, 2)])
def test_a_predictor_of_any_pull_has_an_answer(N: int | Fraction) -> None:
    found = px4_predictor(INS, POSITION, N, 44, 2500.0)
    assert (found.verdict, found.worst) == ("unstable", np.inf)
