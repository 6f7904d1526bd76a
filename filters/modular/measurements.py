"""Measurements with the steps in which they were taken and in which they became available."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.place import IntArray
from filters.modular.check import as_numbers
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.space import Space, plain, plus

UNIT = 1e-2
"""How much the length of a quaternion may differ from one."""
LAST = 2**62
"""Steps are kept in 64 bits."""


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

    Raises:
        ValueError: the truth has a wrong shape or is not finite.
    """
    truth = as_numbers("truth", truth)
    if truth.ndim != 2 or truth.shape[1] != composed.of.numbers:
        raise ValueError(f"truth has shape {truth.shape}, the filter's states need (any, {composed.of.numbers})")
    if not np.isfinite(truth).all():
        raise ValueError("truth holds a value that is not finite")
    found = []
    for number, sensor in enumerate(composed.sensors):
        random = np.random.default_rng([seed, number])
        R, observed = sensor.corrector.R, sensor.corrector.observed
        steps = range(0, len(truth), sensor.every)
        noise = random.multivariate_normal(np.zeros(len(R)), R, size=len(steps), method="cholesky")
        arrived = random.random(len(steps)) >= sensor.dropout
        expected = expected_by(sensor, composed.of)
        for at in np.flatnonzero(arrived):
            y = np.empty(observed.numbers)
            plus(observed, expected(np.asarray(truth[steps[at]])), noise[at], y)
            found.append(Measurement(sensor.name, steps[at], steps[at] + sensor.delay, y))
    return sorted(found, key=lambda one: one.arrives)


def expected_by(sensor: Sensor, of: Space) -> Callable[[FloatArray], FloatArray]:
    """The measurement (numbers,) that the sensor's model expects at a state x (numbers,), without noise."""
    view = sensor.corrector.view(of.errors)

    def expected(x: FloatArray) -> FloatArray:
        out = np.empty(sensor.corrector.observed.numbers)
        if sensor.corrector.kind == "linear":
            quantities = np.empty(of.errors)
            plain(of, x, quantities)
            out[:] = view.H @ quantities
        else:
            view.h(x, out)
        return out

    return expected


def arrivals(composed: ModularFilter, measurements: Iterable[Measurement], steps: int, history: int) -> Arrivals:
    """The measurements as arrays; those that arrive after `steps` are left out.

    history: the steps that a filter can go back.

    Raises:
        ValueError: a measurement is of no sensor of the filter, has a wrong shape, a number that is not finite or a
            step that is not whole, was taken before step 0 or after it arrived, is older than the history, or is its
            sensor's second in one step.
    """
    numbers = {sensor.name: number for number, sensor in enumerate(composed.sensors)}
    found = list(measurements)
    for kind in set(map(type, found)) - {Measurement}:
        other = next(one for one in found if type(one) is kind)
        raise ValueError(f"measurements holds {other!r:.60}; give a list of Measurement(sensor, taken, arrives, y)")
    for kind in {*map(type, map(attrgetter("taken"), found)), *map(type, map(attrgetter("arrives"), found))}:
        if not issubclass(kind, int | np.integer):
            raise _unfit(next(one for one in found if kind in map(type, one[1:3])), "steps must be whole numbers")
    for one in found:
        if max(abs(one.taken), abs(one.arrives)) > LAST:
            raise _unfit(one, f"steps must lie below {LAST}")
    found.sort(key=attrgetter("arrives"))
    names, taken_in, arrives_in, _ = zip(*found, strict=True) if found else ((),) * 4
    for name in set(names) - set(numbers):
        raise ValueError(f"sensor {name!r} is none of the filter's: they are {', '.join(numbers) or 'none'}")
    number = np.array([numbers[name] for name in names], dtype=np.int64)
    taken, arrives = np.array(taken_in, dtype=np.int64), np.array(arrives_in, dtype=np.int64)
    _, firsts = np.unique(taken * len(numbers) + number, return_index=True)
    longest = max((sensor.corrector.observed.numbers for sensor in composed.sensors), default=0)
    y, turned = np.zeros((len(found), longest)), np.ones(len(found), dtype=np.bool_)
    for each, sensor in enumerate(composed.sensors):
        rows, observed = np.flatnonzero(number == each), sensor.corrector.observed
        y[rows, : observed.numbers] = _stacked([found[row] for row in rows], sensor)
        for start in observed.attitudes:
            turned[rows] &= np.abs(np.linalg.norm(y[rows, start : start + 4], axis=1) - 1.0) < UNIT
    refused = (
        (~np.isfinite(y).all(axis=1), "y holds a value that is not finite; leave lost measurements out"),
        (~turned, "an attitude in y is no unit quaternion; divide it by its length, or leave it out"),
        ((taken < 0) | (taken > arrives), "it must be taken in step 0 or later, and before it arrives"),
        (arrives - taken > history, f"the history goes back {history} steps: give a longer history=, or leave it out"),
        (~np.isin(np.arange(len(found)), firsts), "there are two; a sensor measures once in a step"),
    )
    for wrong, what in refused:
        for row in np.flatnonzero(wrong):
            raise _unfit(found[row], what)
    here = arrives <= steps
    return Arrivals(number[here], taken[here], arrives[here], y[here])


def _stacked(measurements: list[Measurement], sensor: Sensor) -> FloatArray:
    """Their y (any, numbers), all of one sensor; raises ValueError, naming the first that is not as many numbers."""
    needed = sensor.corrector.observed.numbers
    try:
        values = np.array([one.y for one in measurements], dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != (len(measurements), needed) and measurements:
        raise _misshapen(measurements, needed)
    return values.reshape(len(measurements), needed)


def _misshapen(measurements: list[Measurement], needed: int) -> ValueError:
    """Names the first of them whose y is not as many numbers."""
    for one in measurements:
        try:
            shape = np.array(one.y, dtype=np.float64).shape
        except (TypeError, ValueError):
            return _unfit(one, f"y is {one.y!r:.60}; its corrector needs an array of {needed} numbers")
        if shape != (needed,):
            return _unfit(one, f"y has shape {shape}, its corrector needs {(needed,)}")
    raise AssertionError("all are as they should be")


def _unfit(one: Measurement, what: str) -> ValueError:
    return ValueError(
        f"sensor {one.sensor!r}, measurement of step {one.taken}, which arrives in step {one.arrives}: {what}"
    )
