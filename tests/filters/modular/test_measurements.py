"""What sensors would measure: when, how often not, and with what noise."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.modular import Measurement, Sensor, linear_corrector, observe, run
from tests.filters.modular import cases
from tests.filters.modular.cases import ATTITUDE, Case, linear_case


def case_with(**timing: Any) -> Case:
    return linear_case(
        Sensor("first", linear_corrector(cases.H_BOTH, cases.R_BOTH), **timing),
        Sensor("second", linear_corrector(cases.H_POSITION, cases.R_POSITION)),
    )


@given(every=st.integers(1, 7), delay=st.integers(0, 7), steps=st.integers(0, 30))
def test_rate_and_delay(every: int, delay: int, steps: int) -> None:
    found = observe(case_with(every=every, delay=delay).composed, np.zeros((steps + 1, 2)), seed=1)
    first = [(one.taken, one.arrives) for one in found if one.sensor == "first"]
    assert first == [(k, k + delay) for k in range(0, steps + 1, every)]
    assert [one.arrives for one in found] == sorted(one.arrives for one in found)


@given(every=st.fractions(1, 7, max_denominator=9), steps=st.integers(0, 30))
def test_a_rate_between_steps(every: Fraction, steps: int) -> None:
    found = observe(case_with(every=every).composed, np.zeros((steps + 1, 2)), seed=1)
    instants = [number * every for number in range(steps + 1)]
    expected = [next(k for k in range(8 * steps + 8) if k >= instant) for instant in instants]
    assert [one.taken for one in found if one.sensor == "first"] == [k for k in expected if k <= steps]


def test_one_of_several_delays_is_drawn_for_each() -> None:
    """Within five standard errors of equally often; the noise and the dropout are those of one delay."""
    path, count = np.zeros((4000, 2)), 4000
    one_delay = {(one.taken, *one.y) for one in observe(case_with(delay=5, dropout=0.3).composed, path, seed=2)}
    for delays in (range(3, 7), [6, 3, 5, 4], np.array([3, 4, 5, 6])):
        found = observe(case_with(delay=delays).composed, path, seed=2)
        late = Counter(one.arrives - one.taken for one in found if one.sensor == "first")
        assert late.keys() == {3, 4, 5, 6}
        assert all(abs(each - count / 4) <= 5 * np.sqrt(count * 3 / 16) for each in late.values())
        assert [one.arrives for one in found] == sorted(one.arrives for one in found)
        lossy = observe(case_with(delay=delays, dropout=0.3).composed, path, seed=2)
        assert {(one.taken, *one.y) for one in lossy} == one_delay


def test_by_default_the_history_goes_as_far_as_the_longest_delay() -> None:
    case = case_with(delay=[1, 6, 3])
    late = [Measurement("first", 1, 1 + delay, np.zeros(2)) for delay in (6, 7)]
    run(case.composed, case.x0, case.P0, case.inputs(9), late[:1])
    with pytest.raises(ValueError, match="the history goes back 6 steps"):
        run(case.composed, case.x0, case.P0, case.inputs(9), late)


def test_those_that_drop_out_are_gone_at_every_higher_probability_and_the_rest_are_the_same() -> None:
    path = np.zeros((2000, 2))
    kept = []
    for dropout in (0.0, 0.1, 0.5, 0.9, 1.0):
        found = observe(case_with(dropout=dropout).composed, path, seed=3)
        kept.append({(one.sensor, one.taken, *one.y) for one in found if one.sensor == "first"})
        expected = 2000 * (1 - dropout)
        assert abs(len(kept[-1]) - expected) <= 4 * np.sqrt(expected * dropout)
        assert sum(one.sensor == "second" for one in found) == 2000
    assert all(more > fewer for more, fewer in pairwise(kept))


def test_the_seed_decides() -> None:
    composed, path = case_with(dropout=0.5).composed, np.zeros((20, 2))
    one, again, other = ([(*m[:3], *m.y) for m in observe(composed, path, seed)] for seed in (5, 5, 6))
    assert one == again
    assert one != other


def test_noise_has_the_covariance_R() -> None:
    """Within five standard errors of it: (R_ii R_jj + R_ij^2) / count is the variance of a sample covariance."""
    path = np.tile([3.0, -2.0], (4000, 1))
    y = np.array([one.y for one in observe(case_with().composed, path, seed=7) if one.sensor == "first"])
    R = cases.R_BOTH
    deviations = np.sqrt((np.outer(np.diag(R), np.diag(R)) + R**2) / len(y))
    assert (np.abs(np.cov(y.T) - R) <= 5 * deviations).all()
    assert (np.abs(y.mean(axis=0) - cases.H_BOTH @ path[0]) <= 5 * np.sqrt(np.diag(R) / len(y))).all()


def test_the_noise_of_an_observed_attitude_is_a_rotation() -> None:
    path = np.tile(ATTITUDE.x0, (3000, 1))
    stars = [one.y for one in observe(ATTITUDE.composed, path, seed=2) if one.sensor == "stars"]
    np.testing.assert_allclose(np.linalg.norm(stars, axis=1), 1.0, rtol=1e-14)
    found = np.column_stack([stars, np.zeros((len(stars), 3))])
    expected = np.column_stack([path[: len(stars), :4], np.zeros((len(stars), 3))])
    errors = cases.errors_between(ATTITUDE, found, expected)[:, :3]
    R = ATTITUDE.composed.sensors[1].corrector.R
    assert (np.abs(np.cov(errors.T) - R) <= 5 * 1e-4 * np.sqrt((1 + np.eye(3)) / len(stars))).all()
