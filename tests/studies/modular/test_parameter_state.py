"""The filter that has the stiffness as a state moves as a spring does, and finds the stiffness."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from filters.modular import ModularHistory
from filters.systems.spring_mass import Oscillator, motion
from studies.modular.oscillator import USUAL
from studies.modular.oscillator_run import Record, arriving, estimate, oscillation
from studies.modular.parameter_state import NOMINAL, SIGMA, SPREAD, accelerated, swing_on, tracked, truth_of
from studies.modular.uncertain import oscillator_of

LOST = 0.9


@cache
def record() -> Record:
    return oscillation(USUAL, 4, oscillator_of(4, SPREAD))


@cache
def followed() -> ModularHistory:
    return tracked(record(), LOST, "reference")


@given(some.floats(2, 20), some.floats(-2, 2), some.floats(-6, 6), some.floats(0.001, 2))
def test_it_moves_as_the_spring_does(stiffness: float, position: float, velocity: float, dt: float) -> None:
    expected = motion(Oscillator(1.0, stiffness), dt, position, velocity)
    out, felt = np.empty(3), np.empty(1)
    swing_on(np.array([position, velocity, stiffness]), np.empty(0), dt, out)
    accelerated(out, felt)
    np.testing.assert_allclose([*out, *felt], [*expected[:2], stiffness, expected[2]], atol=1e-9)


def test_it_finds_the_stiffness() -> None:
    (*_, last), found = truth_of(record())[-1], followed()
    assert abs(found.x[-1, 2] - last) < 5 * np.sqrt(found.P[-1, 2, 2]) < 0.1 * SIGMA
    assert found.x[0, 2] == pytest.approx(NOMINAL, rel=0.2)


def test_it_bears_a_dropout_that_the_filter_without_a_spring_does_not() -> None:
    without = estimate(record(), USUAL, arriving(record(), LOST), "reference")
    settled = slice(2 * USUAL.rate, None)
    errors = [np.sqrt(np.mean((each.x - record().truth)[settled, 0] ** 2)) for each in (followed(), without)]
    assert errors[0] < 0.3 * errors[1]
