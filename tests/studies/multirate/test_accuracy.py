"""Laws of the multirate gain's accuracy: never better than the optimum, equal for n = 1, worse with a faster gain."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from filters import multirate_gain
from studies.multirate.accuracy import (
    READINGS,
    SPEEDS,
    Accuracy,
    Scenario,
    accuracies,
    gains_used,
    largest_good,
    optimal_gains,
    random_walk,
    receiver,
    scalar_ratio,
    scenarios,
    tracker,
    worst_after_start,
)

PERIODS = (1, 2, 5, 10, 20)
FAST_ENOUGH = [random_walk(speed) for speed in SPEEDS if speed >= 0.01] + [tracker(0.1), receiver(0.05), receiver(1.0)]


@pytest.fixture(scope="module")
def found() -> dict[str, list[Accuracy]]:
    return {scenario.name: accuracies(scenario, PERIODS) for scenario in FAST_ENOUGH}


def rows(all_of: list[Accuracy], reading: str, late: bool = False) -> list[Accuracy]:
    return [row for row in all_of if row.reading == reading and (row.L > 0) == late]


def steady(all_of: list[Accuracy], reading: str, n: int) -> float:
    return next(row.steady_mean for row in rows(all_of, reading) if row.n == n)


@pytest.mark.exhaust
def test_no_gain_is_better_than_the_optimal_one(found: dict[str, list[Accuracy]]) -> None:
    for row in (row for of_one in found.values() for row in of_one):
        assert 1 - 1e-9 <= row.steady_mean <= row.steady_worst + 1e-12 <= row.worst + 2e-12


@pytest.mark.exhaust
def test_a_gain_in_every_step_is_the_optimal_one(found: dict[str, list[Accuracy]]) -> None:
    for of_one in found.values():
        for reading in READINGS:
            (row,) = [row for row in rows(of_one, reading) if row.n == 1]
            assert row.worst == pytest.approx(1, abs=1e-9)
            assert row.settled_step == 0
        late = next(row for row in rows(of_one, "averaged", late=True) if row.n == 1)
        assert late.steady_mean == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("reading", READINGS)
def test_the_loss_grows_with_n(found: dict[str, list[Accuracy]], reading: str) -> None:
    for of_one in found.values():
        ratios = [row.steady_mean for row in rows(of_one, reading)]
        assert ratios == sorted(ratios)


@pytest.mark.parametrize("noise", ["averaged", "sampled"])
def test_the_loss_of_the_scalar_filter_grows_with_its_speed_as_the_closed_form_says(
    found: dict[str, list[Accuracy]], noise: str
) -> None:
    for n in PERIODS:
        expected = [scalar_ratio(speed, n, noise) for speed in SPEEDS if speed >= 0.01]
        measured = [steady(found[f"random walk {speed:g}"], noise, n) for speed in SPEEDS if speed >= 0.01]
        np.testing.assert_allclose(measured, expected, rtol=1e-4)
        assert expected == sorted(expected)


@pytest.mark.parametrize("n", [2, 5, 20])
def test_limits_of_the_scalar_filter(n: int) -> None:
    """Slow: averaged 1 + ((n - 1) K)^2 / 8, sampled (sqrt(n) + 1 / sqrt(n)) / 2. Fast: linear in q, gain 1 / n."""
    for speed in (1e-6, 1e-8):
        K = sqrt(speed)
        assert (scalar_ratio(speed, n, "averaged") - 1) / (((n - 1) * K) ** 2 / 8) == pytest.approx(1, abs=30 * K)
        assert scalar_ratio(speed, n, "sampled") == pytest.approx((sqrt(n) + 1 / sqrt(n)) / 2, rel=30 * K)
    kept = (1 - 1 / n) ** 2
    assert scalar_ratio(1e6, n, "averaged") / 1e6 == pytest.approx(kept / (1 - kept), rel=1e-4)


def test_averaged_is_the_better_reading(found: dict[str, list[Accuracy]]) -> None:
    for of_one in found.values():
        for n in PERIODS[1:]:
            assert steady(of_one, "averaged", n) < steady(of_one, "sampled", n)


def test_lateness_matters_only_while_the_gain_changes(found: dict[str, list[Accuracy]]) -> None:
    for of_one in found.values():
        for row, late in zip(rows(of_one, "averaged"), rows(of_one, "averaged", late=True), strict=True):
            assert late.steady_mean == pytest.approx(row.steady_mean, rel=2e-3)
            assert late.worst > row.worst * (1 - 1e-6) or row.n == 1


def test_the_start_is_the_worst(found: dict[str, list[Accuracy]]) -> None:
    """The first gain, near one, is divided among n measurements, of which the first alone should have had it."""
    of_receiver = rows(found["gps 0.05"], "averaged")
    assert [round(row.worst) for row in of_receiver] == [1, 57, 144, 416, 3062]
    assert [row.worst_step for row in of_receiver] == [0, 0, 0, 16, 32]


def test_the_patents_example(found: dict[str, list[Accuracy]]) -> None:
    """n = 5: right for a vehicle that hardly manoeuvres; for the aircraft, for which it is meant, it is not."""
    assert steady(found["gps 0.05"], "averaged", 5) == pytest.approx(1.053, abs=0.001)
    assert steady(found["gps 0.05"], "sampled", 5) == pytest.approx(1.619, abs=0.001)
    assert steady(found["gps 1"], "averaged", 5) == pytest.approx(3.590, abs=0.001)
    assert steady(found["gps 1"], "sampled", 5) == pytest.approx(5.137, abs=0.001)
    assert steady(found["gps 1"], "skipped", 5) == pytest.approx(5.125, abs=0.001)


def test_the_largest_good_n(found: dict[str, list[Accuracy]]) -> None:
    of_receiver = rows(found["gps 0.05"], "averaged")
    assert largest_good(of_receiver) == 2
    assert largest_good(of_receiver, limit=1.06) == 5
    assert largest_good(of_receiver, limit=0.5) == 0


def test_a_start_at_full_rate_removes_the_transient() -> None:
    worst = [worst_after_start(receiver(0.05), 5, full_rate_steps=steps) for steps in (0, 10, 20, 30, 60)]
    np.testing.assert_allclose(worst, [144.1, 1.438, 1.136, 1.087, 1.075], rtol=1e-3)
    assert worst_after_start(random_walk(0.01), 1, full_rate_steps=20) == pytest.approx(1, abs=1e-9)


def test_gains_are_those_that_a_run_uses() -> None:
    scenario = receiver(0.3)
    record = np.zeros(8), scenario.P0, np.zeros((scenario.steps, 0)), np.zeros((scenario.steps + 1, 4))
    coarse = scenario.coarse(7, "sampled")
    expected = multirate_gain.run(scenario.system, 7, *record, coarse=coarse, L=3, backend="numpy").gains
    np.testing.assert_array_equal(gains_used(scenario, "sampled", 7, 3), expected)


def test_skipped_measurements_have_no_gain() -> None:
    scenario = random_walk(0.1)
    gains = gains_used(scenario, "skipped", 3, 0)
    assert np.all((gains[:, 0, 0] > 0) == (np.arange(len(gains)) % 3 == 0))
    np.testing.assert_allclose(gains_used(scenario, "skipped", 1, 0), optimal_gains(scenario))


@pytest.mark.slow
@pytest.mark.parametrize("scenario", scenarios(), ids=lambda scenario: scenario.name)
@pytest.mark.exhaust
def test_all_scenarios_settle_within_their_steps(scenario: Scenario) -> None:
    for row in accuracies(scenario, (1, 5, 20)):
        assert row.steady_mean >= 1 - 1e-9
        assert row.steady_worst - row.steady_mean < 0.01 * row.steady_mean or row.reading == "skipped"
        if scenario.name.startswith("random walk") and row.reading != "skipped":
            speed = float(scenario.name.split()[-1])
            assert row.steady_mean == pytest.approx(scalar_ratio(speed, row.n, row.reading), rel=1e-3)
