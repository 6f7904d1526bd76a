"""Flights of a simulated rocket with a filter that knows neither its mass nor its thrust."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.modular import Measurement, observe, run
from filters.modular.space import minus
from filters.systems.rocket import Flight, random_rocket, simulate_flight
from filters.systems.rocket_filter import OF, TUNED, PredictorName, ProcessNoise, rocket_filter, start


class Case(NamedTuple):
    """One filter. dropout: of all sensors; without: one that never measures."""

    name: str
    predictor: PredictorName = "unscented"
    dropout: float = 0.0
    without: str = ""
    noise: ProcessNoise = TUNED


class Run(NamedTuple):
    """One flight, and what the filter made of it.

    time_s (steps + 1,): since ignition; the last is apogee. truth, x (steps + 1, 16); P (steps + 1, 15, 15). errors
    (steps + 1, 15): what takes the estimate to the truth.
    """

    time_s: FloatArray
    truth: FloatArray
    x: FloatArray
    P: FloatArray
    errors: FloatArray


def flight(seed: int, backend: BackendName = "compiled") -> Flight:
    """Everything about the flight is drawn from the seed, and so are its sensors' noise and the filter's start."""
    return simulate_flight(random_rocket(seed), seed, backend=backend)


def fly(case: Case, seed: int, *, steps: int | None = None, backend: BackendName = "compiled") -> Run:
    """One flight with its filter. steps: only so many, from a second before ignition on."""
    flown = flight(seed, backend)
    seen = flown.states[: None if steps is None else steps + 1]
    return follow(case, seed, seen, flown.time_s[: len(seen)], measure(case.dropout, seed, seen), backend=backend)


def measure(dropout: float, seed: int, truth: FloatArray) -> list[Measurement]:
    """What the sensors measure on a flight (steps + 1, 16)."""
    return observe(rocket_filter(dropout=dropout), truth, seed)


def follow(
    case: Case,
    seed: int,
    truth: FloatArray,
    time_s: FloatArray,
    measured: Sequence[Measurement],
    *,
    backend: BackendName = "compiled",
) -> Run:
    """The filter of a case on these measurements."""
    composed = rocket_filter(case.predictor, case.dropout, case.noise)
    used = [measurement for measurement in measured if measurement.sensor != case.without]
    x0, P0 = start(truth[0], seed)
    history = run(composed, x0, P0, np.zeros((len(truth) - 1, 0)), used, backend=backend)
    errors = np.empty((len(truth), OF.errors))
    for true, estimate, error in zip(truth, history.x, errors, strict=True):
        minus(OF, true, estimate, error)
    return Run(time_s, truth, history.x, history.P, errors)
