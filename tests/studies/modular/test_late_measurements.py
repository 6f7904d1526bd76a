"""What is done with a late measurement: the ways agree where they must, and their work is what their steps are."""

from __future__ import annotations

import numpy as np
import pytest

from filters.modular import observe
from studies.modular.late_measurements import (
    DELAYS,
    EVERY,
    SENSORS,
    SETTING,
    WAYS,
    errors,
    estimate,
    filter_of,
    is_possible,
    late_study,
    work,
)
from studies.modular.oscillator_run import SETTLED_PERIODS, oscillation

TRUTH = oscillation(SETTING, 1).truth[: SETTLED_PERIODS * SETTING.rate + 121]


def test_without_delay_all_ways_but_the_dual_rate_filter_are_one() -> None:
    for sensors in SENSORS:
        found = [errors(sensors, way, 0, TRUTH, 1, "reference") for way in ("recalculate", "larsen", "fuse-as-fresh")]
        np.testing.assert_allclose(found[1], found[0], atol=1e-9)
        np.testing.assert_allclose(found[2], found[0], atol=1e-9)


def test_the_dual_rate_filter_is_as_late_as_can_be() -> None:
    late = errors("position", "recalculate", EVERY, TRUTH, 1, "reference")
    for delay in (0, 8):
        np.testing.assert_allclose(errors("position", "dual-rate", delay, TRUTH, 1), late, atol=1e-9)


def test_larsen_is_recalculating_where_there_is_one_sensor() -> None:
    one, other = (errors("position", way, 6, TRUTH, 1, "reference") for way in ("recalculate", "larsen"))
    np.testing.assert_allclose(one, other, atol=1e-9)


def test_as_new_uses_what_is_old() -> None:
    """A position that is ten steps late is that of then."""
    composed = filter_of("position and acceleration", 10)
    still = np.zeros((101, 3))
    moved = still.copy()
    moved[50:, 0] = 1.0
    found = estimate(composed, "fuse-as-fresh", observe(composed, moved, 0), 100, "reference")
    assert abs(found.x[59, 0]) < 0.3
    assert found.x[100, 0] == pytest.approx(1, abs=0.3)


def test_work() -> None:
    """Recalculating does one more step again for each step of delay; Larsen's longest step does not grow."""
    longest = [work("position and acceleration", "recalculate", delay).longest for delay in (2, 4, 6)]
    ordinary = work("position", "fuse-as-fresh", 0)
    assert longest[2] - longest[1] == longest[1] - longest[0] > 0
    assert len({work("position and acceleration", "larsen", delay).longest for delay in (2, 10)}) == 1
    assert work("position", "recalculate", 0) == work("position", "larsen", 0) == ordinary
    assert work("position", "dual-rate", 2).longest < work("position", "larsen", 2).longest
    assert ordinary.mean < ordinary.longest


def test_the_study_has_a_row_for_all_that_is_possible(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.modular.late_measurements.errors", lambda *_: np.ones((5, 3)))
    delays = (*DELAYS[:2], *DELAYS[-1:])
    told: list[tuple[int, int]] = []
    found = late_study([0, 1], delays, progress=lambda done, total, _what: told.append((done, total)))
    asked = [(s, w, d) for s in SENSORS for w in WAYS for d in delays if is_possible(s, w, d)]
    assert [(row.sensors, row.way, row.delay) for row in found] == asked
    assert told == [(done, len(asked)) for done in range(len(asked) + 1)]
    assert ("position and acceleration", "dual-rate", 0) not in asked
    assert all(row.runs == 2 and row.error.rms[0] == 1 for row in found)
