"""Measurements with the steps in which they were taken and in which they became available."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.place import IntArray
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.space import Space, plain, plus


class Measurement(NamedTuple):
    """One measurement of the sensor of this name: y (numbers,), taken in one step, available from another on."""

    sensor: str
    taken: int
    arrives: int
    y: FloatArray


class Arrivals(NamedTuple):
    """Measurements as arrays, in the order in which they arrive.

    sensor: its number; taken, arrives: steps; y (count, most numbers of any sensor): filled up with zeros.
    """

    sensor: IntArray
    taken: IntArray
    arrives: IntArray
    y: FloatArray


def observe(composed: ModularFilter, truth: FloatArray, seed: int) -> list[Measurement]:
    """What the sensors of a filter would measure along true states (steps + 1, numbers), in the order of arrival.

    Each with noise N(0, R), its delay, and its dropout. Each sensor has random numbers of its own, which do not depend
    on its dropout: with a higher one the same measurements are left, or fewer.
    """
    found = []
    for number, sensor in enumerate(composed.sensors):
        random = np.random.default_rng([seed, number])
        R = sensor.corrector.R
        for taken in range(0, len(truth), sensor.every):
            noise = random.multivariate_normal(np.zeros(len(R)), R, method="cholesky")
            lost = random.random() < sensor.dropout
            if not lost:
                y = np.empty(sensor.corrector.observed.numbers)
                plus(sensor.corrector.observed, seen(sensor, composed.of, truth[taken]), noise, y)
                found.append(Measurement(sensor.name, taken, taken + sensor.delay, y))
    return sorted(found, key=lambda one: one.arrives)


def seen(sensor: Sensor, of: Space, x: FloatArray) -> FloatArray:
    """The measurement (numbers,) that the sensor's model expects at the state x, without noise."""
    view = sensor.corrector.view(of.errors)
    out = np.empty(sensor.corrector.observed.numbers)
    if sensor.corrector.kind == "linear":
        quantities = np.empty(of.errors)
        plain(of, x, quantities)
        out[:] = view.H @ quantities
    else:
        view.h(x, out)
    return out


def arrivals(composed: ModularFilter, measurements: Iterable[Measurement], steps: int, history: int) -> Arrivals:
    """The measurements as arrays; those that arrive after `steps` are left out.

    history: the steps that a filter can go back.

    Raises:
        ValueError: a measurement is of no sensor of the filter, has a wrong shape or a number that is not finite, was
            taken before step 0 or after it arrived, is older than the history, or is its sensor's second in one step.
    """
    numbers = {sensor.name: number for number, sensor in enumerate(composed.sensors)}
    kept: dict[tuple[int, int], Measurement] = {}
    for one in sorted(measurements, key=lambda each: each.arrives):
        if one.sensor not in numbers:
            raise ValueError(f"sensor {one.sensor!r} is none of the filter's: they are {', '.join(numbers) or 'none'}")
        needed = (composed.sensors[numbers[one.sensor]].corrector.observed.numbers,)
        where = f"sensor {one.sensor!r}, measurement of step {one.taken}"
        if np.shape(one.y) != needed:
            raise ValueError(f"{where}: y has shape {np.shape(one.y)}, its corrector needs {needed}")
        if not np.isfinite(one.y).all():
            raise ValueError(f"{where}: y holds a value that is not finite; leave lost measurements out")
        if not 0 <= one.taken <= one.arrives:
            raise ValueError(
                f"{where}: it arrives in step {one.arrives}; it must be taken in step 0 or later, and before"
            )
        if one.arrives - one.taken > history:
            raise ValueError(
                f"{where}: it arrives in step {one.arrives}, {one.arrives - one.taken} steps late, and the history "
                f"goes back {history}: give history={one.arrives - one.taken} or more, or leave it out"
            )
        if (number_and_step := (numbers[one.sensor], one.taken)) in kept:
            raise ValueError(f"{where}: there are two; a sensor measures once in a step")
        if one.arrives <= steps:
            kept[number_and_step] = one
    found = list(kept.values())
    longest = max((sensor.corrector.observed.numbers for sensor in composed.sensors), default=0)
    y = np.zeros((len(found), longest))
    for row, one in zip(y, found, strict=True):
        row[: len(one.y)] = one.y
    return Arrivals(
        np.array([numbers[one.sensor] for one in found], dtype=np.int64),
        np.array([one.taken for one in found], dtype=np.int64),
        np.array([one.arrives for one in found], dtype=np.int64),
        y,
    )
