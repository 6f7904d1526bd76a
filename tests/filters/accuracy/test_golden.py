"""Golden values, each to its printed digits: of a prototype that is not handed over, of Kalata, of Farrenkopf."""

from __future__ import annotations

from math import radians, sqrt

import numpy as np
import pytest

from filters import accuracy
from filters.accuracy.gains import summed_noise, with_assumed
from filters.accuracy.model import linear_model
from filters.accuracy.periodic import steady
from filters.accuracy.riccati import gain
from filters.accuracy.van_loan import discretised
from tests.filters.accuracy.cases import CV, INS, POSITION, SCALAR


def printed(value: float, text: str) -> bool:
    """Whether the value, rounded to as many decimals as the text has, is the text."""
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return f"{value / 10.0 ** int(exponent or 0):.{decimals}f}" == mantissa


@pytest.mark.parametrize(
    ("L", "worst", "mean"), [(8, "0.440156211872", "0.395156211872"), (10, "0.460156211872", "0.415156211872")]
)
def test_a_scalar_random_walk(L: int, worst: str, mean: str) -> None:
    found = accuracy.lossless(SCALAR, [0], 10, L)
    assert printed(float(steady(SCALAR, np.eye(1), 10, 0).before[0, 0, 0]), "0.370156211872")
    assert printed(found.worst**2, worst)
    assert printed(found.rms**2, mean)


@pytest.mark.parametrize(
    ("L", "worst", "rms"), [(4, "4.3914193770", "3.0568604591"), (8, "5.9356719208", "4.3796113341")]
)
def test_constant_velocity(L: int, worst: str, rms: str) -> None:
    found = accuracy.lossless(CV, [0], 10, L)
    assert printed(found.worst, worst)
    assert printed(found.rms, rms)


def test_constant_velocity_fused_as_fresh() -> None:
    found = accuracy.fused_as_fresh(CV, [0], 10, 4, displacement=[1 * 4])
    assert found.bias == pytest.approx(4, rel=1e-12)
    assert printed(found.worst, "3.0236226199")


def test_constant_velocity_landing_after_the_next_measurement_is_taken() -> None:
    assert printed(accuracy.lossless(CV, [0], 10, 14).worst, "8.5345602732")
    found = accuracy.uncompensated(CV, [0], 10, 14)
    assert found.radius is not None
    assert printed(found.radius, "1.6911191479")
    assert found.verdict == "unstable"


def test_constant_velocity_with_summed_noise() -> None:
    assert printed(accuracy.with_low_rate_noise(CV, [0], 10, 8, "sum").worst, "5.9479485258")
    regime = with_assumed(CV, np.eye(2)[:1], 10, 0, summed_noise)
    assert printed(sqrt(regime.believed_before[0, 0]), "3.6373775270")
    assert printed(sqrt(regime.before[0, 0]), "3.3538444884")


@pytest.mark.parametrize(("L", "worst"), [(44, "0.37293412"), (60, "0.37905887"), (80, "0.38684844")])
def test_inertial_navigation(L: int, worst: str) -> None:
    assert printed(accuracy.lossless(INS, POSITION, 80, L).worst, worst)


@pytest.mark.parametrize(("within", "L"), [(0.374, 46), (0.38, 62)])
def test_the_latest_landing_of_inertial_navigation(within: float, L: int) -> None:
    assert accuracy.latest_landing(INS, POSITION, 80, within, M=44).L == L


def test_kalatas_alpha_beta_filter() -> None:
    """P. R. Kalata, The tracking index: a generalized parameter for alpha-beta and alpha-beta-gamma target trackers,
    IEEE Transactions on Aerospace and Electronic Systems 20, 1984: r = (4 + i - sqrt(8 i + i^2)) / 4, alpha = 1 - r^2,
    beta = 2 (2 - alpha) - 4 sqrt(1 - alpha); 0.36 and 0.08 for i = 0.1."""
    index = 0.1
    Q = index**2 * np.outer([1 / 2, 1], [1 / 2, 1])
    model = linear_model([[1, 1], [0, 1]], Q, [[1, 0]], [[1]])
    K = gain(steady(model, np.eye(2), 1, 0).before[0], model.H, model.R)
    np.testing.assert_allclose(K[:, 0], [0.36, 0.08], rtol=1e-12)


def test_farrenkopfs_attitude_filter() -> None:
    """R. L. Farrenkopf, Analytic steady-state accuracy solutions for two common spacecraft attitude estimators, Journal
    of Guidance and Control 1, 1978."""
    walk, drift, tracker = sqrt(10) * 1e-7, sqrt(10) * 1e-10, radians(0.005)
    Phi, Q = discretised(np.array([[0.0, -1.0], [0.0, 0.0]]), np.diag([walk**2, drift**2]), 0.5)
    regime = steady(linear_model(Phi, Q, [[1, 0]], [[tracker**2]]), np.eye(2)[:1], 1, 0)
    assert printed(sqrt(regime.before[0, 0, 0]), "4.80030506424e-6")
    assert printed(sqrt(regime.after[0, 0, 0]), "4.79305907697e-6")


def test_the_multirate_gain_of_a_tracker() -> None:
    """The ratio of variances of `studies.multirate`: tracker(0.1), n = 5, averaged noise."""
    found = accuracy.with_divided_gain(CV, [0], 5)
    assert printed((found.worst / found.no_delay) ** 2, "2.084129691")
