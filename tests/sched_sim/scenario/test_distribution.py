"""Quantiles of a sample, and Wilson's interval."""

from __future__ import annotations

from dataclasses import asdict

import pytest

from sched_sim.scenario.distribution import Distribution, below_which_unresolved, finished_or_not, wilson


def test_quantiles_are_values_of_the_sample() -> None:
    assert Distribution.of([*range(100, 0, -1)]) == Distribution(1, 50.5, 50, 95, 99, 100)
    assert Distribution.of([0.25]) == Distribution(*[0.25] * 6)


def test_a_quantile_that_unknown_values_decide_is_unknown() -> None:
    known = {"minimum": 1, "mean": 48.0, "median": 50, "p95": 95, "p99": None, "maximum": 95}
    assert finished_or_not([*range(95, 0, -1)], 5) == known
    assert finished_or_not([25.9], 39) == known | {"mean": 25.9, "median": None, "p95": None} | dict.fromkeys(
        ("minimum", "maximum"), 25.9
    )
    assert finished_or_not([*range(1, 101)], 0) == asdict(Distribution.of([*range(1, 101)]))


@pytest.mark.parametrize(
    ("events", "trials", "least", "most"),
    [
        (1, 10, 0.01787621, 0.40415003),  # prop.test(1, 10, correct = FALSE) of R
        (0, 10, 0.0, 0.2775328),  # z^2 / (n + z^2), n = 10
        (10, 10, 0.7224672, 1.0),
    ],
)
def test_wilsons_interval(events: int, trials: int, least: float, most: float) -> None:
    assert wilson(events, trials) == pytest.approx((least, most), abs=1e-7)


@pytest.mark.parametrize("trials", [10, 1000, 10**9])
def test_what_would_have_been_seen_is_resolved(trials: int) -> None:
    """With 95 %, and not with much more."""
    assert (1 - below_which_unresolved(trials)) ** trials < 0.05 < (1 - 0.8 * below_which_unresolved(trials)) ** trials


def test_a_trial_resolves_nothing() -> None:
    assert below_which_unresolved(1) == 1
