"""What biases of its sensors do to the rocket's filter, which knows of none.

A bias is constant in a flight, and normal with a deviation that is so many times the noise of one measurement, for each
number that the sensor measures; the camera's is a rotation. Flights, noise and the filter's start are those of the
study of the rocket.

Biases as large as the noise leave position below 15 % of the distance from a second after ignition on in all flights,
if barely; three times as large, in half of them. Orientation, as a share of all that was turned, does not bear them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.modular import Measurement, Sensor
from filters.modular.space import plus
from filters.systems.rocket_filter import SENSORS, sensors
from studies.modular.rocket import BASE, SEEDS, ErrorRow, ResidualRow, Summary, error_row, residual_rows, summary
from studies.modular.rocket_flights import flight, follow, measure

Progress: TypeAlias = Callable[[int, int, str], None]

DRAW = 30
"""The stream of random numbers that biases are drawn from."""
LARGE = 3.0


class Biases(NamedTuple):
    """Of these sensors, with a standard deviation of so many times their noise."""

    sensors: tuple[str, ...]
    size: float


NONE = Biases((), 0.0)
CASES = (
    NONE,
    *(Biases((name,), 1.0) for name in SENSORS),
    Biases(SENSORS, 1.0),
    Biases(SENSORS, LARGE),
)


class Row(NamedTuple):
    """One case: errors as in the study of the rocket, and a row for each reading of its claim."""

    biases: Biases
    errors: ErrorRow
    residuals: tuple[ResidualRow, ...]


def bias_study(
    seeds: Sequence[int] = SEEDS,
    cases: Sequence[Biases] = CASES,
    progress: Progress = lambda _done, _total, _what: None,
) -> tuple[Row, ...]:
    """All cases fly the same flights with the same noise."""
    kept: dict[Biases, list[Summary]] = {case: [] for case in cases}
    for done, seed in enumerate(seeds):
        progress(done, len(seeds), "flights with biases")
        flown = flight(seed)
        measured = measure(BASE.dropout, seed, flown.states)
        for case in cases:
            seen = biased(measured, drawn(case, seed))
            kept[case].append(summary(follow(BASE, seed, flown.states, flown.time_s, seen)))
    progress(len(seeds), len(seeds), "flights with biases")
    return tuple(Row(case, error_row(BASE, runs), residual_rows(BASE, runs)) for case, runs in kept.items())


def drawn(case: Biases, seed: int) -> dict[str, FloatArray]:
    """The biases of a flight by sensor: the same draw for each size, and whichever sensors have one."""
    random = np.random.default_rng([seed, DRAW])
    noise = {each.name: np.sqrt(np.diagonal(each.corrector.R)) for each in sensors()}
    every = {name: sigmas * random.normal(size=len(sigmas)) for name, sigmas in noise.items()}
    return {name: case.size * every[name] for name in case.sensors}


def biased(measured: Sequence[Measurement], biases: Mapping[str, FloatArray]) -> list[Measurement]:
    """The same measurements, each with the bias of its sensor if it has one."""
    of = {sensor.name: sensor for sensor in sensors()}
    return [_moved(of[each.sensor], each, biases[each.sensor]) if each.sensor in biases else each for each in measured]


def _moved(sensor: Sensor, measured: Measurement, bias: FloatArray) -> Measurement:
    y = np.array(measured.y, dtype=np.float64)
    moved = np.empty_like(y)
    plus(sensor.corrector.observed, y, bias, moved)
    return measured._replace(y=moved)
