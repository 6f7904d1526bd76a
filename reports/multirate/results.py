"""What the report on the multirate gain asks of the studies: accuracies, transients and starts. No graphics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from studies.multirate.accuracy import (
    ACCELERATION_NOISES,
    Accuracy,
    Reading,
    Scenario,
    accuracies,
    gains_used,
    optimal_gains,
    position_ratio,
    receiver,
    scenarios,
    worst_after_start,
)
from studies.multirate.constancy import changes

N = 5
"""The patent's n."""

RECEIVER = f"gps {ACCELERATION_NOISES[0]:g}"
"""Whose start is looked at."""

PERIODS = range(1, 21)
SHOWN = (2, 5, 10, 20)
"""The n of the tables and of the figure of the start."""

FULL_RATE_STEPS = (0, 1, 2, 3, 5, 7, 10, 15, 20, 30, 40, 50, 60)

Progress = Callable[[int, int, str], None]


class Course(NamedTuple):
    """The share of an innovation that a filter believes in every step: with a gain in each, and with the divided gain
    of every N-th."""

    optimal: FloatArray
    divided: FloatArray


class Results(NamedTuple):
    """accuracies: by scenario. shares: by scenario, the largest eigenvalue of H K once the optimal filter has settled:
    the share of an innovation that it believes; K itself if there is one state.

    courses: of RECEIVER by n, the ratio in every step (L = 0). starts: of RECEIVER by n, the worst ratio after so many
    steps with a gain each. changes: by scenario, by how much of itself the optimal gain changes in the N steps from
    each on. gains: of the receivers.
    """

    accuracies: Mapping[str, Sequence[Accuracy]]
    shares: Mapping[str, float]
    courses: Mapping[int, FloatArray]
    starts: Mapping[int, Mapping[int, float]]
    changes: Mapping[str, FloatArray]
    gains: Mapping[str, Course]

    def of(self, scenario: str, reading: Reading, *, late: bool = False) -> list[Accuracy]:
        """In the order of n. late: L = n instead of L = 0."""
        return [row for row in self.accuracies[scenario] if row.reading == reading and (row.L > 0) == late]

    def at(self, scenario: str, reading: Reading, n: int, *, late: bool = False) -> Accuracy:
        return next(row for row in self.of(scenario, reading, late=late) if row.n == n)


def results(progress: Progress = lambda _done, _total, _what: None) -> Results:
    """Runs the studies: about 15 seconds."""
    asked, total = scenarios(), len(scenarios()) + len(SHOWN)
    by_scenario, shares, changed = {}, {}, {}
    for done, scenario in enumerate(asked):
        progress(done, total, scenario.name)
        by_scenario[scenario.name] = accuracies(scenario, PERIODS)
        optimal = optimal_gains(scenario)
        shares[scenario.name] = _shares(scenario, optimal)[-1]
        changed[scenario.name] = changes(optimal, N)
    gains = {f"gps {noise:g}": _gains(receiver(noise)) for noise in ACCELERATION_NOISES}
    started = receiver(ACCELERATION_NOISES[0])
    courses, starts = {}, {}
    for done, n in enumerate(SHOWN, start=len(asked)):
        progress(done, total, f"start, n = {n}")
        courses[n] = _course(started, n)
        starts[n] = {steps: worst_after_start(started, n, steps) for steps in FULL_RATE_STEPS}
    progress(total, total, "done")
    return Results(by_scenario, shares, courses, starts, changed, gains)


def _gains(scenario: Scenario) -> Course:
    divided = gains_used(scenario, "averaged", N, 0)
    return Course(_shares(scenario, optimal_gains(scenario)), _shares(scenario, divided))


def _shares(scenario: Scenario, gains: FloatArray) -> FloatArray:
    """The largest eigenvalue of H K in every step."""
    system = scenario.system
    H = [system.H(k, np.zeros(system.states), system.parameters) for k in range(scenario.steps + 1)]
    shares: FloatArray = np.abs(np.linalg.eigvals(np.array(H) @ gains)).max(axis=-1)
    return shares


def _course(scenario: Scenario, n: int) -> FloatArray:
    return position_ratio(scenario, gains_used(scenario, "averaged", n, 0), optimal_gains(scenario))
