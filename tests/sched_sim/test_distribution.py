"""Quantiles of a sample, and Wilson's interval."""

from __future__ import annotations

import pytest

from sched_sim.distribution import Distribution, wilson


def test_quantiles_are_values_of_the_sample() -> None:
    assert Distribution.of([*range(100, 0, -1)]) == Distribution(1, 50.5, 50, 95, 99, 100)
    assert Distribution.of([0.25]) == Distribution(*[0.25] * 6)


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
