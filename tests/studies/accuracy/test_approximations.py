"""What approximations cost, where it is known otherwise."""

from __future__ import annotations

import pytest

from studies.accuracy.approximations import approximations, noise_by_camera_rate, noise_of_camera
from studies.accuracy.given import given


def test_a_summed_noise_costs_more_the_rarer_the_camera() -> None:
    shares = noise_by_camera_rate()
    assert [*shares] == [50, 20, 10, 5, 4, 2, 1]
    assert [*shares.values()] == sorted(shares.values())
    assert f"{100 * shares[2]:.0f}" == "24"
    assert abs(shares[20]) < 1e-5


def test_of_the_camera() -> None:
    found = approximations(given("camera"))
    assert found.uncompensated.verdict == "unstable"
    assert found.exact_in_flight.verdict == "exact"
    assert found.discarded.verdict == "diverges"
    assert found.fresh.bias == pytest.approx(1.0 * 0.03)
    assert found.px4.worst > 8 * found.exact.worst


def test_what_the_summed_noise_costs_a_camera_at_2_hz_depends_on_where_it_lands() -> None:
    assert noise_of_camera(100, 100) == pytest.approx(0.244, abs=5e-4)
    assert noise_of_camera(100, 6) == pytest.approx(0.333, abs=5e-4)
