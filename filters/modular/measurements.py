"""Measurements with the steps in which they were taken and in which they became available."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.check import as_numbers
from filters.modular.composition import ModularFilter, Sensor, check_composed
from filters.modular.space import Space, plain, plus
from filters.seed import check_seed


class Measurement(NamedTuple):
    """One measurement of the sensor of this name: y (numbers,), taken in one step, available from another on.

    y: None in place of a number that is lost, or a masked array of NumPy's; the others are used. None
        alone: all are lost.
    """

    sensor: str
    taken: int
    arrives: int
    y: FloatArray | Sequence[float | None] | None


def observe(composed: ModularFilter, truth: FloatArray, seed: int) -> list[Measurement]:
    """What the sensors of a filter would measure along true states (steps + 1, numbers), in the order of arrival.

    Each with noise N(0, R), its delay, drawn where there are several, and its dropout. Each sensor has random numbers
    of its own, which do not depend on its dropout: with a higher one the same measurements are left, or fewer.

    Raises:
        ValueError: composed is no filter, the seed no whole number, or the truth has a wrong shape or is not finite.
    """
    check_composed(composed)
    check_seed(seed)
    truth = as_numbers("truth", truth)
    if truth.ndim != 2 or truth.shape[1] != composed.of.numbers:
        raise ValueError(f"truth has shape {truth.shape}, the filter's states need (any, {composed.of.numbers})")
    if not np.isfinite(truth).all():
        raise ValueError("truth holds a value that is not finite")
    measurements = []
    for number, sensor in enumerate(composed.sensors):
        random = np.random.default_rng([seed, number])
        R, observed = sensor.corrector.R, sensor.corrector.observed
        steps = sensor.takes(len(truth))
        noise = random.multivariate_normal(np.zeros(len(R)), R, size=len(steps), method="cholesky")
        arrived = random.random(len(steps)) >= sensor.dropout
        drawn = random.integers(len(sensor.delays), size=len(steps))
        expected = expected_by(sensor, composed.of)
        for at in np.flatnonzero(arrived):
            y = np.empty(observed.numbers)
            plus(observed, expected(np.asarray(truth[steps[at]])), noise[at], y)
            measurements.append(Measurement(sensor.name, steps[at], steps[at] + sensor.delays[drawn[at]], y))
    return sorted(measurements, key=lambda measurement: measurement.arrives)


def expected_by(sensor: Sensor, space: Space) -> Callable[[FloatArray], FloatArray]:
    """The measurement (numbers,) that the sensor's model expects at a state x (numbers,), without noise."""
    view = sensor.corrector.view(space.errors)

    def expected(x: FloatArray) -> FloatArray:
        out = np.empty(sensor.corrector.observed.numbers)
        if sensor.corrector.kind == "linear":
            quantities = np.empty(space.errors)
            plain(space, x, quantities)
            out[:] = view.H @ quantities
        else:
            view.h(x, out)
        return out

    return expected
