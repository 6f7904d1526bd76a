"""Root mean squares over runs, and their standard errors."""

from __future__ import annotations

import numpy as np
import pytest

from studies.modular.rms import rms


def test_standard_error_is_that_of_repeated_draws() -> None:
    random = np.random.default_rng(0)
    draws = [rms([[random.normal(size=20) for _ in range(30)]]) for _ in range(1000)]
    assert np.std([draw.rms for draw in draws]) == pytest.approx(np.mean([draw.standard_error for draw in draws]), 0.1)


def test_runs_may_have_different_lengths_and_one_run_has_no_standard_error() -> None:
    found = rms([[np.array([3.0]), np.array([4.0, 5.0, 0.0])]])
    assert found.rms == pytest.approx(np.sqrt(50 / 4))
    assert np.isnan(rms([[np.array([3.0, 4.0])]]).standard_error).all()
