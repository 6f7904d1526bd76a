"""The rank autocorrelation of execution times: that of SciPy, also where times are equal."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import spearmanr

from sched_sim.costs.autocorrelation import by_chance, rank_autocorrelation


@given(st.lists(st.integers(1, 12), min_size=3, max_size=40))
def test_it_is_spearmans_of_each_and_the_next(times: list[int]) -> None:
    before, after = times[:-1], times[1:]
    constant = len({*before}) == 1 or len({*after}) == 1
    expected = 0.0 if constant else spearmanr(before, after).statistic
    assert rank_autocorrelation(times) == pytest.approx(expected, abs=1e-12)


def test_ends_of_the_scale() -> None:
    assert rank_autocorrelation(range(1, 100)) == pytest.approx(1)
    assert rank_autocorrelation([1, 2] * 50) == pytest.approx(-1)
    assert rank_autocorrelation([7] * 9) == rank_autocorrelation([1, 2]) == rank_autocorrelation([1]) == 0


def test_one_slow_execution_does_not_decide_it() -> None:
    times = np.random.default_rng(0).permutation(1000) + 1.0
    slow = times.copy()
    slow[500:502] = 1e9
    assert abs(rank_autocorrelation(slow) - rank_autocorrelation(times)) < 0.01


def test_chance_makes_as_much_once_in_20_times() -> None:
    random = np.random.default_rng(0)
    found = [abs(rank_autocorrelation(random.permutation(100))) > by_chance(100) for _ in range(1000)]
    assert sum(found) / len(found) == pytest.approx(0.05, abs=0.02)
