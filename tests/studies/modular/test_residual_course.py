"""Residuals in windows of time are root mean squares of what is there, and settle as the dropout lets them."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as some

from studies.modular.oscillator import USUAL
from studies.modular.oscillator_run import arriving, estimate, oscillation
from studies.modular.residual_course import WINDOWS, position_residuals, windowed

STEPS = USUAL.rate // WINDOWS
RECORD = oscillation(USUAL, 0)


@given(some.lists(some.floats(-10, 10) | some.just(np.nan), min_size=2 * STEPS, max_size=2 * STEPS))
def test_a_window_is_the_root_mean_square_of_what_was_measured_in_it(values: list[float]) -> None:
    found = windowed(np.array([values]), USUAL)[0]
    for at, root in enumerate(found):
        there = [value for value in values[at * STEPS : (at + 1) * STEPS] if not np.isnan(value)]
        expected = np.sqrt(np.mean(np.square(there))) if there else np.nan
        np.testing.assert_allclose(root, expected, atol=1e-12)


def test_errors_are_those_of_the_estimate_and_innovations_are_where_position_was_measured() -> None:
    error, innovation = position_residuals(RECORD, USUAL, 0.8, "reference")
    arrived = arriving(RECORD, 0.8)
    history = estimate(RECORD, USUAL, arrived, "reference")
    np.testing.assert_array_equal(error, (history.x - RECORD.truth)[1:, 0])
    steps = {one.taken for one in arrived if one.sensor == "position"} - {0}
    assert set(np.flatnonzero(~np.isnan(innovation)) + 1) == steps


def test_an_innovation_is_drawn_to_the_estimate_by_a_correction() -> None:
    """What a measurement exceeds the prediction by, the estimate follows in part."""
    _, innovation = position_residuals(RECORD, USUAL, 0.8, "reference")
    arrived = [one for one in arriving(RECORD, 0.8) if one.sensor == "position" and one.taken > 300]
    x = estimate(RECORD, USUAL, arriving(RECORD, 0.8), "reference").x
    after = np.array([one.y[0] - x[one.taken, 0] for one in arrived])  # type: ignore[index]
    before = innovation[[one.taken - 1 for one in arrived]]
    assert np.sqrt(np.mean(after**2)) < 0.8 * np.sqrt(np.mean(before**2))
