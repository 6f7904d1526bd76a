"""Rounded probabilities never say more than the figures do."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.scenario.distribution import wilson
from sched_sim.shares import interval, percent, probability


@pytest.mark.parametrize(
    ("events", "trials", "shown", "between"),
    [
        (1197, 1198, "0.999165", "0.9952 to 0.99986"),
        (7997, 8000, "0.999625", "0.9988 to 0.99988"),
        (1198, 1198, "1", "0.9968 to 1"),
        (0, 1198, "0", "0 to 0.0032"),
        (1, 8000, "0.000125", "2.2e-05 to 0.00071"),
        (2, 3, "0.667", "0.2 to 0.939"),
        (1, 2, "0.5", "0.094 to 0.906"),
    ],
)
def test_by_hand(events: int, trials: int, shown: str, between: str) -> None:
    assert probability(events / trials) == shown
    assert interval(*wilson(events, trials)) == between


@given(st.integers(1, 20_000_000), st.data())
def test_an_interval_holds_its_estimate_and_certainty_is_certain(trials: int, data: st.DataObject) -> None:
    events = data.draw(st.integers(0, trials))
    estimate, (least, most) = events / trials, wilson(events, trials)
    shown = float(probability(estimate))
    low, high = map(float, interval(least, most).split(" to "))
    assert low <= least <= most <= high
    assert low <= shown <= high
    for exact, rounded in ((estimate, shown), (least, low), (most, high)):
        assert (rounded == 0) == (exact == 0)
        assert (rounded == 1) == (exact == 1)


@pytest.mark.parametrize(
    ("share", "shown"),
    [(0, "0.0%"), (1, "100.0%"), (0.3, "30.0%"), (0.12345, "12.3%"), (7999 / 8000, "99.99%"), (1 / 3000, "0.03%")],
)
def test_percent(share: float, shown: str) -> None:
    assert percent(share) == shown
