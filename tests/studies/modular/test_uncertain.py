"""Uncertain parameters are drawn about the nominal ones, once for all spreads; without a spread nothing is changed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from filters.systems.rocket import random_rocket
from studies.modular.oscillator import USUAL
from studies.modular.oscillator_run import OSCILLATOR, oscillation, residuals
from studies.modular.uncertain import factors, oscillator_of, rocket_of, swung

SEEDS = some.integers(0, 10_000)


@given(SEEDS, some.floats(0.0, 0.3))
def test_a_run_is_the_same_draw_at_any_spread(seed: int, spread: float) -> None:
    np.testing.assert_allclose(factors(seed, spread) - 1.0, spread * (factors(seed, 1.0) - 1.0), atol=1e-12)


def test_parameters_are_gaussian_and_independent() -> None:
    drawn = np.array([factors(seed, 0.1) for seed in range(2000)])
    np.testing.assert_allclose(drawn.mean(axis=0), 1.0, atol=0.01)
    np.testing.assert_allclose(np.cov(drawn.T), 0.01 * np.eye(2), atol=0.001)


@given(SEEDS)
def test_without_a_spread_all_is_nominal(seed: int) -> None:
    assert oscillator_of(seed, 0.0) == OSCILLATOR
    assert rocket_of(seed, 0.0) == random_rocket(seed)


def test_with_nominal_parameters_the_error_is_that_of_the_study_of_dropout() -> None:
    error = residuals(oscillation(USUAL, 3), USUAL, 0.8, "reference").error[:, 0]
    assert swung(3, 0.0, 0.8, "reference")[0] == pytest.approx(np.sqrt(np.mean(error**2)))


def test_the_motion_is_that_of_the_drawn_oscillator() -> None:
    """Its acceleration over its position, of a light damping, is the drawn stiffness over the drawn mass."""
    drawn = oscillator_of(5, 0.2)
    position, _, acceleration = oscillation(USUAL, 5, drawn).truth.T
    assert -acceleration @ position / (position @ position) == pytest.approx(drawn.spring_n_m / drawn.mass_kg, rel=0.01)
    assert drawn.spring_n_m != OSCILLATOR.spring_n_m
