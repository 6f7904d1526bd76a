"""How accurate is a filter whose gain is computed every n-th step? "Optimal covariance filtering", a patent, Eq. (1).

The true covariance of its position error, by an exact recursion with the gains that it used, over that of the optimal
filter, which computes a gain in every step. A ratio of 1.05 is 2.5 % in standard deviation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import sqrt
from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.delayed import standard
from filters.error_covariance import true_covariance
from filters.multirate_gain import cycle_in_use
from filters.system import System
from filters.systems.coarse import CoarseNoise, over
from filters.systems.gps import POSITION, gps, gps_coarse, gps_start
from filters.systems.linear import linear_system

GOOD = 1.05
"""A ratio up to which the loss is called small."""

Reading: TypeAlias = Literal[CoarseNoise, "skipped"]
READINGS: tuple[Reading, ...] = (*get_args(CoarseNoise), "skipped")
"""K(n dT) with R / n or with R, divided by n; and, with as many gains to compute, K(n dT) with R for each n-th
measurement and none for the others: the conventional filter at the low rate."""

SPEEDS = (1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2)
"""q dT / R of the scalar random walk: process noise of one step over measurement noise."""

TRACKING_INDICES = (0.01, 0.1, 1.0)
"""sqrt(q dT^3 / R) of the tracker."""

ACCELERATION_NOISES = (0.05, 0.3, 1.0)
"""The receiver's, m/s^2/sqrt(Hz): almost no manoeuvres, a road vehicle, an aircraft that turns."""


class Scenario(NamedTuple):
    """coarse(n, noise): the system over n steps. steps: after so many, all filters have settled.

    P0 (states, states): at step 0. position: the states whose error counts.
    """

    name: str
    system: System
    coarse: Callable[[int, CoarseNoise], System]
    P0: FloatArray
    position: slice
    steps: int


class Accuracy(NamedTuple):
    """The ratio of one filter.

    steady_mean, steady_worst: in the last whole blocks of n steps of a run, the mean and the worst step.
    worst, worst_step: in the whole run, the transient after the start included.
    settled_step: from there on within 5 % of steady_worst.
    """

    scenario: str
    reading: Reading
    n: int
    L: int
    steady_mean: float
    steady_worst: float
    worst: float
    worst_step: int
    settled_step: int


def random_walk(speed: float) -> Scenario:
    """The scalar random walk with R = 1, from a standard deviation of ten measurements' noise."""
    system = linear_system([[1.0]], [[0.0]], [[1.0]], [[speed]], [[1.0]])
    steps = 200 + int(28 / sqrt(speed))
    return Scenario(f"random walk {speed:g}", system, _over(system), np.array([[100.0]]), slice(0, 1), steps)


def tracker(index: float) -> Scenario:
    """Constant velocity with white acceleration, dT = 1, R = 1; at the start 10 in position, 1 in velocity."""
    q = index**2
    Q = q * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
    system = linear_system([[1.0, 1.0], [0.0, 1.0]], [[0.0], [0.0]], [[1.0, 0.0]], Q, [[1.0]])
    steps = 200 + int(80 / sqrt(index))
    return Scenario(f"tracker {index:g}", system, _over(system), np.diag([100.0, 1.0]), slice(0, 1), steps)


def receiver(acceleration_noise: float) -> Scenario:
    """The patent's example, `filters.systems.gps`, at one second."""
    steps = 400
    system = gps(steps=steps, acceleration_noise=acceleration_noise)

    def coarse(n: int, noise: CoarseNoise) -> System:
        return gps_coarse(n, steps=steps, acceleration_noise=acceleration_noise, noise=noise)

    return Scenario(f"gps {acceleration_noise:g}", system, coarse, gps_start(), POSITION, steps)


def scenarios() -> list[Scenario]:
    """All that are looked at."""
    return [
        *(random_walk(speed) for speed in SPEEDS),
        *(tracker(index) for index in TRACKING_INDICES),
        *(receiver(noise) for noise in ACCELERATION_NOISES),
    ]


def accuracies(scenario: Scenario, periods: Sequence[int] = range(1, 21)) -> list[Accuracy]:
    """For each n of `periods`: all readings, the gain in use at once (L = 0) and, where it is divided, at L = n."""
    noises = get_args(CoarseNoise)
    computed = {(noise, n): computed_gains(scenario, noise, n) for noise in noises for n in periods}
    keys = list(_filters(periods))
    gains = [_used(computed[_noise(reading), n], reading, n, L, scenario.steps) for reading, n, L in keys]
    ratios = position_ratio(scenario, np.array(gains), optimal_gains(scenario))
    return [_accuracy(scenario.name, *key, ratio) for key, ratio in zip(keys, ratios, strict=True)]


def position_ratio(scenario: Scenario, gains: FloatArray, optimal: FloatArray) -> FloatArray:
    """The true variance of the position error in every step (..., steps + 1), over that with the optimal gains.

    gains (..., steps + 1, states, measurements): filters side by side. optimal: without leading axes.
    """
    return _position_variance(scenario, gains) / _position_variance(scenario, optimal)


def optimal_gains(scenario: Scenario) -> FloatArray:
    """K_j (steps + 1, states, measurements) of the standard filter."""
    return standard.run(scenario.system, 1, 0, 0, *_no_data(scenario), backend="numpy").gains


def computed_gains(scenario: Scenario, noise: CoarseNoise, n: int) -> FloatArray:
    """K(t, n dT) / n (cycles, states, measurements) of k = 0, n, 2n, ..."""
    coarse = scenario.coarse(n, noise)
    return multirate_gain.run(scenario.system, n, *_no_data(scenario), coarse=coarse, backend="numpy").gains[::n]


def gains_used(scenario: Scenario, reading: Reading, n: int, L: int) -> FloatArray:
    """K_j (steps + 1, states, measurements) of each step."""
    return _used(computed_gains(scenario, _noise(reading), n), reading, n, L, scenario.steps)


def _noise(reading: Reading) -> CoarseNoise:
    return "sampled" if reading == "skipped" else reading


def _used(computed: FloatArray, reading: Reading, n: int, L: int, steps: int) -> FloatArray:
    cycles = [cycle_in_use(j, n, L) for j in range(steps + 1)]
    gains: FloatArray = computed[cycles]
    if reading == "skipped":
        gains *= n
        gains[np.arange(len(gains)) % n != 0] = 0.0
    return gains


def worst_after_start(scenario: Scenario, n: int, full_rate_steps: int, noise: CoarseNoise = "averaged") -> float:
    """The worst ratio of a whole run if the first steps have a gain each, and only then one comes every n-th step.

    The gain every n-th step starts from the optimal filter's covariance. It takes H from `full_rate_steps` before,
    which matters little for satellites.
    """
    optimal = standard.run(scenario.system, 1, 0, 0, *_no_data(scenario), backend="numpy")
    later = scenario._replace(P0=optimal.P_reference[full_rate_steps], steps=scenario.steps - full_rate_steps)
    gains = np.concatenate([optimal.gains[:full_rate_steps], gains_used(later, noise, n, 0)])
    return float(position_ratio(scenario, gains, optimal.gains).max())


def scalar_ratio(speed: float, n: int, noise: CoarseNoise) -> float:
    """The steady ratio of the scalar random walk in closed form."""
    gain = _steady_gain(n * speed, 1 / n if noise == "averaged" else 1.0) / n
    return _steady_variance(speed, gain) / _steady_variance(speed, _steady_gain(speed, 1.0))


def _steady_gain(q: float, r: float) -> float:
    """P^- is the positive root of P^2 = q P + q r."""
    P = (q + sqrt(q * q + 4 * q * r)) / 2
    return P / (P + r)


def _steady_variance(q: float, gain: float) -> float:
    """P = (1 - K)^2 (P + q) + K^2, solved for P."""
    kept = (1 - gain) ** 2
    return (kept * q + gain**2) / (1 - kept)


def largest_good(rows: Sequence[Accuracy], limit: float = GOOD) -> int:
    """The largest n up to which all steady means are within the limit. rows: of one scenario, reading and L."""
    bad = [row.n for row in rows if row.steady_mean > limit]
    return max((row.n for row in rows if not bad or row.n < min(bad)), default=0)


def _filters(periods: Sequence[int]) -> Iterator[tuple[Reading, int, int]]:
    for reading in READINGS:
        for n in periods:
            yield reading, n, 0
            if reading != "skipped":
                yield reading, n, n


def _accuracy(name: str, reading: Reading, n: int, L: int, ratio: FloatArray) -> Accuracy:
    blocks = max(len(ratio) // (10 * n), 1)
    steady = ratio[len(ratio) - blocks * n :]
    worst, limit = int(np.argmax(ratio)), 1.05 * steady.max()
    settled = int(np.max(np.flatnonzero(ratio > limit), initial=-1)) + 1
    return Accuracy(name, reading, n, L, steady.mean(), steady.max(), ratio[worst], worst, settled)


def _position_variance(scenario: Scenario, gains: FloatArray) -> FloatArray:
    P = true_covariance(scenario.system, scenario.P0, gains).after[..., scenario.position, scenario.position]
    variance: FloatArray = np.trace(P, axis1=-2, axis2=-1)
    return variance


def _no_data(scenario: Scenario) -> tuple[FloatArray, ...]:
    """x0, P0, inputs and measurements: the gains of a linear system do not depend on its data."""
    system, steps = scenario.system, scenario.steps
    x0, inputs = np.zeros(system.states), np.zeros((steps, system.inputs))
    return x0, scenario.P0, inputs, np.zeros((steps + 1, system.measurements))


def _over(system: System) -> Callable[[int, CoarseNoise], System]:
    return lambda n, noise: over(system, n, noise)
