"""The likelihood of measurements is that of their joint distribution, and is greatest near the true covariances."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some
from scipy.stats import multivariate_normal

from filters.arrays import FloatArray
from filters.systems.spring_mass import transition, white_jerk
from studies.modular import found_covariances as study
from studies.modular.oscillator import USUAL
from studies.modular.oscillator_run import ACCELERATION_SIGMA, POSITION_SIGMA_M, start, step_s

STEPS = 5
SCALES = some.lists(some.floats(0.2, 5), min_size=3, max_size=3).map(np.array)


def joint(scales: FloatArray) -> FloatArray:
    """Covariance of all measurements of `STEPS` steps, from the model itself."""
    F, Q = transition(step_s(USUAL)), white_jerk(step_s(USUAL), scales[2] * study._jerk_noise())
    states = np.zeros((STEPS, STEPS, 3, 3))
    P = start()[1]
    for first in range(STEPS):
        states[first, first] = P
        for later in range(first + 1, STEPS):
            states[later, first] = F @ states[later - 1, first]
            states[first, later] = states[later, first].T
        P = F @ P @ F.T + Q
    seen = states[:, :, [0, 2]][:, :, :, [0, 2]].transpose(0, 2, 1, 3).reshape(2 * STEPS, 2 * STEPS)
    R = (scales[:2] * [POSITION_SIGMA_M, ACCELERATION_SIGMA]) ** 2
    covariance: FloatArray = seen + np.diag(np.tile(R, STEPS))
    return covariance


@settings(max_examples=30)
@given(SCALES, some.lists(some.floats(-1, 1), min_size=4 * STEPS, max_size=4 * STEPS))
def test_the_likelihood_is_that_of_all_measurements_at_once(scales: FloatArray, values: list[float]) -> None:
    """Of two runs."""
    measured = np.array(values).reshape(STEPS, 2, 2)
    density = multivariate_normal(cov=joint(scales))
    expected = sum(density.logpdf(measured[..., run].ravel()) for run in range(2)) + 2 * STEPS * np.log(2 * np.pi)
    assert study.log_likelihood(scales, measured) == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_it_is_greatest_near_the_true_covariances() -> None:
    records = [study.record_of("the filter's own model", seed) for seed in range(2)]
    measured = np.stack([study._measured(record.measurements) for record in records], axis=-1)
    best = study.log_likelihood(np.ones(3), measured)
    for wrong in ([2, 1, 1], [0.5, 1, 1], [1, 4, 1], [1, 1, 2], [1, 1, 0.5]):
        assert study.log_likelihood(np.array(wrong), measured) < best - 5


@pytest.mark.exhaust
def test_known_covariances_are_found() -> None:
    position, _, jerk = study.found([study.record_of("the filter's own model", seed) for seed in range(3)])
    assert position == pytest.approx(1.0, abs=0.1)
    assert jerk == pytest.approx(1.0, abs=0.15)


@pytest.mark.exhaust
def test_what_is_found_does_not_show_where_the_search_began() -> None:
    """On these runs the simplex method stops at 0.3 times the accelerometer's noise, from the start of a third."""
    records = [study.record_of("the filter's own model", seed) for seed in range(11, 21)]
    np.testing.assert_allclose(study.found(records), study.found(records, (1 / 3, 3.0, 3.0)), rtol=0.01)


def test_with_the_usual_covariances_a_run_is_as_usual() -> None:
    times, own, usual = study.compared(np.ones(3), study.record_of("the filter's own model", 0), "reference")
    assert (times, own) == (1.0, usual)
    assert 1 < usual < 6
