"""What many measurements tend to: Eqs. (4) to (6), and what Eq. (1) makes of them."""

from __future__ import annotations

import numpy as np
import pytest

from filters.systems.gps import motion
from studies.multirate.accuracy import ACCELERATION_NOISES, GOOD, accuracies, receiver
from studies.multirate.limit import RANGE_SIGMA_M, Tending, continuous_gain, tending


@pytest.mark.parametrize("noise", ACCELERATION_NOISES)
def test_the_discrete_gain_per_second_tends_to_the_continuous_one_in_proportion_to_the_period(noise: float) -> None:
    """Eq. (4)."""
    short = [1 - tending(noise, period, 1).optimal for period in (0.04, 0.02, 0.01)]
    assert short[2] < 0.01
    assert [short[0] / short[1], short[1] / short[2]] == pytest.approx([2, 2], rel=0.03)


def test_the_continuous_gain_solves_its_equation() -> None:
    """P H^T R^-1 H P = A P + P A^T + W, as seen by H: the position's part of it is K R K^T."""
    A, W = motion(0.3)
    K = continuous_gain(0.3)
    driven = K @ K.T * RANGE_SIGMA_M**2 - W
    assert np.linalg.matrix_rank(A @ A) == 0
    # velocity's share: K R K^T is W where A P + P A^T has nothing, in velocities and clock drift
    np.testing.assert_allclose(driven[3:6, 3:6], 0, atol=1e-9)
    assert driven[7, 7] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("noise", ACCELERATION_NOISES)
def test_eq_1_becomes_exact_with_a_shorter_interval_between_gains(noise: float) -> None:
    rows = [tending(noise, 1 / hz, 5) for hz in (1, 2, 5, 10, 100)]
    losses = [row.averaged_ratio - 1 for row in rows]
    assert losses == sorted(losses, reverse=True)
    assert losses[-1] < 1e-3
    assert rows[-1].averaged == pytest.approx(rows[-1].optimal, rel=0.04)


@pytest.mark.parametrize("noise", ACCELERATION_NOISES)
def test_more_measurements_for_each_gain_do_not_make_it_exact(noise: float) -> None:
    rows = [tending(noise, 5 / n, n) for n in (1, 2, 5, 10, 100)]
    assert [row.averaged for row in rows] == pytest.approx([rows[0].averaged] * len(rows))
    assert [row.optimal for row in rows] == sorted(row.optimal for row in rows)
    assert [row.averaged_ratio for row in rows] == sorted(row.averaged_ratio for row in rows)
    assert rows[-1].averaged_ratio > 1.05


@pytest.mark.parametrize("noise", ACCELERATION_NOISES)
def test_with_R_it_tends_to_less_whatever_is_done(noise: float) -> None:
    at_100_hz = tending(noise, 0.01, 5)
    assert at_100_hz.sampled < 0.7
    assert at_100_hz.sampled_ratio > 1.3


def test_one_measurement_for_each_gain_is_the_optimal_filter() -> None:
    row = tending(0.3, 1.0, 1)
    assert row == Tending(1, 1.0, row.optimal, row.optimal, row.optimal, 1.0, 1.0)


@pytest.mark.exhaust
def test_at_one_second_it_is_what_the_study_with_moving_satellites_finds() -> None:
    for noise in ACCELERATION_NOISES:
        row = next(row for row in accuracies(receiver(noise), (5,)) if row.reading == "averaged" and row.L == 0)
        assert tending(noise, 1.0, 5).averaged_ratio == pytest.approx(row.steady_mean, rel=0.01)
        assert (tending(noise, 1.0, 5).averaged_ratio <= GOOD) == (row.steady_mean <= GOOD)
