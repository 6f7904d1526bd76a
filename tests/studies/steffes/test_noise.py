"""Steffes Sec. III.D: what Q' and Q'' do to P and to the estimate, where Q is small beside P and where not."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from filters.systems.linear import linear_system
from studies.steffes.noise import Approximated, Tried, _approximated, approximations, tried


@cache
def found() -> list[Approximated]:
    return approximations()


def of(system: str, noise: str) -> list[Approximated]:
    return [one for one in found() if (one.system, one.noise) == (system, noise)]


@pytest.mark.parametrize("system", ["turning", "inertial"])
def test_more_noise_is_more_of_p_and_makes_p_more_wrong(system: str) -> None:
    for noise in ("sum", "euler"):
        for less, more in pairwise(of(system, noise)):
            assert less.share < more.share
            assert less.covariance < more.covariance


@pytest.mark.parametrize("system", ["turning", "inertial"])
def test_q_double_prime_is_nearer_than_q_prime(system: str) -> None:
    for summed, euler in zip(of(system, "sum"), of(system, "euler"), strict=True):
        assert euler.covariance < summed.covariance
        assert euler.estimate < summed.estimate


def test_p_is_wrong_about_in_proportion_and_the_estimate_by_a_percent_at_most() -> None:
    for one in found():
        if one.noise == "sum":
            assert 0.4 < one.covariance / one.share < 3
        assert 0 < one.estimate < 0.01


def test_a_model_that_stands_still_has_no_error() -> None:
    """Phi = I: Q' and Q'' are exact."""
    still = Tried(
        linear_system(np.eye(2), np.zeros((2, 1)), np.eye(2), 0.1 * np.eye(2), np.eye(2)), np.eye(2), (1.0,), 3
    )
    for one in _approximated("still", still.system, still.P0, still.cycles):
        assert one.covariance == pytest.approx(0, abs=1e-12)
        assert one.estimate == pytest.approx(0, abs=1e-12)


def test_q_is_tried_small_and_not_small() -> None:
    shares = [one.share for one in found()]
    assert min(shares) < 0.01
    assert max(shares) > 0.5
    assert {len(of.factors) for of in tried().values()} == {5, 6}
