"""Measurements as arrays, in the order in which they arrive: checked, and read by compiled code."""

from __future__ import annotations

from collections.abc import Iterable
from operator import attrgetter
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import Flags, FloatArray, as_floats, without_mask
from filters.choice import check_choice
from filters.kernels.place import IntArray
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.measurements import Measurement
from filters.modular.space import Space, numbers_of_errors

UNIT = 1e-2
"""How much the length of a quaternion may differ from one."""
WHOLE = (int, np.integer)
LAST = 2**62
"""Steps are kept in 64 bits."""

TooOld: TypeAlias = Literal["refuse", "drop"]


class Arrivals(NamedTuple):
    """Measurements in the order in which they arrive.

    sensor: its number; taken, arrives: steps; y (count, most numbers of any sensor): filled up with zeros;
    lost (count, most errors of any sensor): of what its error has no number.
    """

    sensor: IntArray
    taken: IntArray
    arrives: IntArray
    y: FloatArray
    lost: Flags


def chosen(arrived: Arrivals, rows: IntArray | Flags) -> Arrivals:
    """These of them."""
    sensor, taken, arrives, y, lost = arrived
    return Arrivals(sensor[rows], taken[rows], arrives[rows], y[rows], lost[rows])


def whole(observed: Space) -> Flags:
    """`lost` of a measurement that has lost nothing."""
    return np.zeros(observed.errors, dtype=np.bool_)


def arrivals(
    composed: ModularFilter,
    measurements: Iterable[Measurement],
    steps: int,
    history: int,
    too_old: TooOld = "refuse",
    *,
    awaited: bool = False,
) -> tuple[Arrivals, tuple[Measurement, ...]]:
    """The measurements as arrays, and those that are dropped; those that arrive after `steps`, or are lost, are left
    out.

    Those of one sensor and one step come in the order in which they arrive, and then in that in which they are listed.
    history: the steps that a filter can go back. too_old: what is done with measurements from before that.
    awaited: left out is instead what is taken after `steps`, or is lost and does not come late.

    Raises:
        ValueError: a measurement is of no sensor of the filter, has a wrong shape, a number that is not finite, an
            attitude that is none or a step that is not whole, was taken before step 0 or after it arrived, or is too
            old.
    """
    check_choice("too_old", too_old, ("refuse", "drop"))
    queue = in_order(measurements)
    names = {sensor.name: number for number, sensor in enumerate(composed.sensors)}
    for measurement in queue:
        if not isinstance(measurement.sensor, str) or measurement.sensor not in names:
            raise ValueError(
                f"sensor {measurement.sensor!r} is none of the filter's: they are {', '.join(names) or 'none'}"
            )
    sensor = np.array([names[measurement.sensor] for measurement in queue], dtype=np.int64)
    taken, arrives = (np.array([measurement[which] for measurement in queue], dtype=np.int64) for which in (1, 2))
    spaces = [each.corrector.observed for each in composed.sensors]
    y = np.zeros((len(queue), max((observed.numbers for observed in spaces), default=0)))
    lost = np.zeros((len(queue), max((observed.errors for observed in spaces), default=0)), dtype=np.bool_)
    here = (taken if awaited else arrives) <= steps
    for number, each in enumerate(composed.sensors):
        rows, observed = np.flatnonzero(sensor == number), each.corrector.observed
        y[rows, : observed.numbers], gone = _read([queue[row] for row in rows], each)
        lost[rows, : observed.errors] = gone
        here[rows] &= ~gone.all(axis=1) | (awaited & (taken[rows] < arrives[rows]))
    old = arrives - taken > history
    _refuse(queue, (taken < 0) | (taken > arrives), "it must be taken in step 0 or later, and before it arrives")
    if too_old == "refuse":
        _refuse(queue, old & here, f"the history goes back {history} steps: give a longer history=, or too_old='drop'")
    dropped = tuple(queue[row] for row in np.flatnonzero(old & here))
    return chosen(Arrivals(sensor, taken, arrives, y, lost), here & ~old), dropped


def in_order(measurements: Iterable[Measurement]) -> list[Measurement]:
    """By arrival. Raises ValueError unless they are measurements with whole steps."""
    wanted = "give a list of Measurement(sensor, taken, arrives, y)"
    if not isinstance(measurements, Iterable):
        raise ValueError(f"measurements is {measurements!r:.60}; {wanted}, [] if there are none")
    items = list(measurements)
    for item in items:
        if type(item) is not Measurement:
            raise ValueError(f"measurements holds {item!r:.60}; {wanted}")
        for step in item[1:3]:
            if not (isinstance(step, WHOLE) and -LAST <= step <= LAST):
                raise _unfit(item, f"steps must be whole numbers below {LAST}")
    return sorted(items, key=attrgetter("arrives"))


def _read(measurements: list[Measurement], sensor: Sensor) -> tuple[FloatArray, Flags]:
    """The y (any, numbers) of one sensor's measurements, without gaps, and what their errors have no number of."""
    observed = sensor.corrector.observed
    whole = [None] * observed.numbers
    numbers = [whole if measurement.y is None else without_mask(measurement.y) for measurement in measurements]
    values = _stacked(measurements, numbers, observed.numbers)
    gone = np.zeros(values.shape, dtype=np.bool_)
    for row in np.flatnonzero(~np.isfinite(values).all(axis=1)):
        gone[row] = [value is None for value in numbers[row]]
    values[gone] = 0.0
    wrong = ~np.isfinite(values).all(axis=1)
    _refuse(
        measurements,
        wrong,
        "y holds a value that is not finite; leave lost measurements out, and give None for a lost number",
    )
    for start in observed.attitudes:
        without = gone[:, start : start + 4]
        _refuse(measurements, without.any(axis=1) ^ without.all(axis=1), "an attitude in y is lost whole or not at all")
        values[without[:, 0], start] = 1.0
        lengths: FloatArray = np.linalg.norm(values[:, start : start + 4], axis=1)
        _refuse(
            measurements,
            np.abs(lengths - 1.0) > UNIT,
            "an attitude in y is no unit quaternion; divide it by its length, or leave it out",
        )
    return values, gone[:, numbers_of_errors(observed)]


def _stacked(measurements: list[Measurement], numbers: list[Any], needed: int) -> FloatArray:
    """Their numbers (any, needed), nan for None; raises ValueError, naming the first that has another count."""
    try:
        values = as_floats(numbers)
    except (TypeError, ValueError, OverflowError):
        values = np.empty(0)
    if values.shape != (len(measurements), needed) and measurements:
        raise _misshapen(measurements, numbers, needed)
    return values.reshape(len(measurements), needed)


def _misshapen(measurements: list[Measurement], numbers: list[Any], needed: int) -> ValueError:
    """Names the first of them that is not as many numbers."""
    for measurement, y in zip(measurements, numbers, strict=True):
        try:
            shape = as_floats(y).shape
        except (TypeError, ValueError, OverflowError):
            return _unfit(measurement, f"y is {y!r:.60}; its corrector needs an array of {needed} numbers")
        if shape != (needed,):
            return _unfit(measurement, f"y has shape {shape}, its corrector needs {(needed,)}")
    raise AssertionError("all are as they should be")


def _refuse(measurements: list[Measurement], wrong: ArrayLike, what: str) -> None:
    for row in np.flatnonzero(wrong):
        raise _unfit(measurements[row], what)


def _unfit(measurement: Measurement, what: str) -> ValueError:
    return ValueError(
        f"sensor {measurement.sensor!r}, measurement of step {measurement.taken}, "
        f"which arrives in step {measurement.arrives}: {what}"
    )
