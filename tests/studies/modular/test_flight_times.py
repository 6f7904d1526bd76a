"""A flight is timed in Python, by NumPy calls and compiled, in one run."""

from __future__ import annotations

import pytest

from studies.measurement.job_times import Protocol
from studies.modular.flight_times import PREDICTORS, WAYS, flight_times


@pytest.mark.exhaust
def test_of_each_predictor_and_way_there_is_a_time_for_each_round() -> None:
    told: list[tuple[int, int]] = []
    found = flight_times(12, Protocol(2, 1), lambda done, total, _what: told.append((done, total)))
    assert found.seconds.keys() == {(kind, "15", way) for kind in PREDICTORS for way in WAYS}
    assert all(len(rounds) == 2 and min(rounds) > 0 for rounds in found.seconds.values())
    assert found.about["protocol"] == {"rounds": 2, "repetitions": 1, "steps": 12, "seed": 0}
    assert told == [(0, 2), (1, 2), (2, 2)]
