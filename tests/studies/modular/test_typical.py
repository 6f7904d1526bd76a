"""Quantiles with their intervals, against printed ranks and against repeated draws."""

from __future__ import annotations

import numpy as np
import pytest

from studies.modular.typical import quantile


@pytest.mark.parametrize(("runs", "low", "high"), [(6, 1, 6), (10, 2, 9), (20, 6, 15), (100, 40, 61)])
def test_the_interval_of_a_median_is_between_the_ranks_of_the_tables(runs: int, low: int, high: int) -> None:
    """David and Nagaraja, Order statistics, 2003, and any table of the sign test, at 95 %."""
    found = quantile(np.random.default_rng(0).permutation(np.arange(1.0, runs + 1)))
    assert found == ((runs + 1) / 2, low, high)


def test_too_few_values_have_no_limit() -> None:
    assert quantile(np.array([3.0, 1.0, np.nan, 2.0])) == (2.0, -np.inf, np.inf)
    with pytest.raises(ValueError, match="nan"):
        quantile(np.array([np.nan]))


@pytest.mark.parametrize(("share", "true"), [(0.5, 1.0), (0.95, 19.0)])
def test_it_holds_the_true_quantile_as_often_as_it_says_however_heavy_the_tail(share: float, true: float) -> None:
    """Values 1 / (1 - u) - 1, whose mean is infinite."""
    draws = 1 / (1 - np.random.default_rng(0).random((2000, 200))) - 1
    found = [quantile(draw, share) for draw in draws]
    assert 0.94 < np.mean([one.low <= true <= one.high for one in found]) < 0.98
