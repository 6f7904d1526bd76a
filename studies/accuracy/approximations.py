"""What filters that are not exact give away: approximate noise, smoothed outputs, measurements taken for new ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from filters.accuracy import (
    Accuracy,
    discarded,
    fused_as_fresh,
    lossless,
    px4_predictor,
    uncompensated,
    with_low_rate_noise,
)
from studies.accuracy.given import Given, given

TAU_S = 0.25
"""Of PX4's output predictor, its default (EKF2_TAU_VEL and EKF2_TAU_POS)."""
CAMERA_HZ = (50, 20, 10, 5, 4, 2, 1)


class Approximations(NamedTuple):
    """One model. exact_late: exact, L = N. summed, halved: dual rate, L = N, with Q' and Q'' (Steffes 2014, Eqs. 23,
    24). px4, fresh, discarded: at M. uncompensated: landing at N + M, so that the next is taken before, without taking
    out what is under way; exact_in_flight: with that."""

    given: Given
    exact: Accuracy
    exact_late: Accuracy
    summed: Accuracy
    halved: Accuracy
    px4: Accuracy
    fresh: Accuracy
    discarded: Accuracy
    uncompensated: Accuracy
    exact_in_flight: Accuracy


def approximations(of: Given) -> Approximations:
    model, states, N, M = of.model, of.states, of.N, of.M
    return Approximations(
        of,
        lossless(model, states, N, M),
        lossless(model, states, N, N),
        with_low_rate_noise(model, states, N, N, "sum"),
        with_low_rate_noise(model, states, N, N, "euler"),
        px4_predictor(model, states, N, M, 1.0 / (of.hr_hz * TAU_S)),
        fused_as_fresh(model, states, N, M, of.displacement),
        discarded(model, states, N),
        uncompensated(model, states, N, N + M),
        lossless(model, states, N, N + M),
    )


def noise_by_camera_rate() -> Mapping[int, float]:
    """By the rate of the camera in Hz: by how much Q' raises the worst, landing at L = N; 0.1 is 10 %."""
    rate = given("camera").hr_hz
    return {hz: noise_of_camera(round(rate / hz), round(rate / hz)) for hz in CAMERA_HZ}


def noise_of_camera(N: int, L: int) -> float:
    """By how much Q' raises the worst of the camera; 0.1 is 10 %."""
    of = given("camera")
    summed = with_low_rate_noise(of.model, of.states, N, L, "sum")
    return summed.worst / lossless(of.model, of.states, N, L).worst - 1.0
