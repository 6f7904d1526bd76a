"""The normalised estimation error squared keeps to its bounds when, and only when, P is the errors' covariance."""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from studies.modular.nees import bounds, consistency, nees

P = np.array([[4.0, 1.0, 0.0], [1.0, 2.0, -0.5], [0.0, -0.5, 1.0]])
RUNS, STEPS = 50, 400


def errors(scale: float = 1.0) -> FloatArray:
    return scale * np.random.default_rng(1).multivariate_normal(np.zeros(3), P, size=(RUNS, STEPS))


def covariances() -> FloatArray:
    return np.broadcast_to(P, (RUNS, STEPS, 3, 3))


def test_nees_is_the_squared_length_in_standard_deviations() -> None:
    deviations = np.array([1.0, -2.0, 3.0])
    assert nees(deviations, np.eye(3)) == pytest.approx(14.0)
    assert nees(np.linalg.cholesky(P) @ deviations, P) == pytest.approx(14.0)


def test_bounds_are_those_of_printed_tables() -> None:
    """NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4: with 100 degrees of freedom, 74.222 and 129.561 are
    exceeded with 97.5 % and 2.5 %; with 2, 5.991 with 5 %."""
    assert bounds(50, 2) == pytest.approx((74.222 / 50, 129.561 / 50), abs=1e-4)
    assert bounds(1, 2, confidence=0.9).high == pytest.approx(5.991, abs=1e-3)


def test_bounds_close_on_n_with_more_runs() -> None:
    widths = [bounds(runs, 3).high - bounds(runs, 3).low for runs in (1, 10, 100, 1000)]
    assert (np.diff(widths) < 0).all()
    assert bounds(100_000, 3) == pytest.approx((3.0, 3.0), abs=0.02)


def test_95_percent_of_steps_are_inside_if_P_is_right() -> None:
    found = consistency(errors(), covariances())
    assert found.inside == pytest.approx(0.95, abs=0.03)
    assert found.below == pytest.approx(found.above, abs=0.04)
    assert found.overall == pytest.approx(3.0, rel=0.02)
    assert found.mean.shape == (STEPS,)
    assert (found.runs, found.n) == (RUNS, 3)


def test_a_filter_that_is_too_sure_is_above_and_one_that_is_not_sure_enough_below() -> None:
    assert consistency(errors(1.5), covariances()).above > 0.95
    assert consistency(errors(0.6), covariances()).below > 0.95


def test_shapes_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match=r"needed are \(\.\.\., n\) and \(\.\.\., n, n\)"):
        nees(np.zeros((5, 3)), P)
