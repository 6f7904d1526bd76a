"""How a scenario's measurements meet: which arrive together, what a late one finds corrected already, how often one is
in flight. On average over one whole pattern of the sensors; of a very long pattern, over its beginning."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import ceil, isqrt, lcm
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.fields import ends
from sched_sim.scenario.instants import Steps
from sched_sim.scenario.instants import lag as steps_late
from sched_sim.scenario.scenario import Sensor

Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]

MOST_DELAYS = 100_000
"""So many of a sensor's delays are looked at; of more, every second, third, ..."""
MOST_CASES = 200_000
"""So many pairs of a measurement and its delay are looked at, of all sensors."""
RAREST = 1 << 40
"""HR steps between measurements; what is rarer meets nothing."""
MOST_PARTS = 256
"""So many parts of sensors are looked at, and the fewer the later they may arrive: an `every` of more is rounded."""
MOST_LAGS = 10**9
"""So many lags of all pairs of parts."""


class Arrivals:
    """Those of a sensor's measurements that recur every so many whole steps: of an `every` of 40/3 each third, whose
    every is 40.

    owner: the number of the sensor. at: the probability that a measurement arrives so many steps late, by lag; before:
    that it has arrived earlier than that; late: whether each that arrives does so in a later step.
    """

    def __init__(self, owner: int, sensor: Sensor, every: int, instant: Steps, lags: Ints, longest: int) -> None:
        self.owner = owner
        self.sensor = sensor
        self.priority = sensor.priority
        self.every = every
        self.offset = ceil(instant) % every
        self.at: Floats = (1 - sensor.dropout) * np.bincount(lags, minlength=longest + 1) / lags.size
        self.before: Floats = np.cumsum(self.at) - self.at
        self.late = bool(lags.min() > 0)

    def steps(self, others: Sequence[Arrivals], most: int) -> Ints:
        """In which measurements are taken, until the pattern of all sensors repeats."""
        return _steps(self.every, self.offset, others, most)

    def sums(self, values: Floats, steps: Ints, last: Ints) -> Floats:
        """Sums of values by lag, over its measurements that are at most `last` older than each of the steps."""
        lag = last - (last - (steps - self.offset)) % self.every
        sums = _rows(values, self.every).cumsum(axis=0).ravel()
        return np.where(lag >= 0, sums.take(lag, mode="clip"), 0.0)

    def products(self, values: Floats, steps: Ints, first: Ints) -> Floats:
        """The same as a product, over those that are at least `first` older."""
        lag = first + ((steps - self.offset) - first) % self.every
        products = _rows(values, self.every)[::-1].cumprod(axis=0)[::-1].ravel()
        return np.where(lag < values.size, products.take(lag, mode="clip"), 1.0)


def _rows(values: Floats, width: int) -> Floats:
    """Values `width` lags apart below one another. Behind the last are ones, which products do not notice; sums are of
    lags before that."""
    width = min(width, values.size)
    return np.append(values, np.ones(-values.size % width)).reshape(-1, width)


def _steps(every: int, offset: int, others: Sequence[Arrivals], most: int) -> Ints:
    pattern = lcm(every, *(arrivals.every for arrivals in others)) // every
    return offset + every * np.arange(max(min(pattern, most), 1))


def _arrivals(sensors: Sequence[Sensor]) -> list[Arrivals]:
    longest = max((ceil(ends(sensor.delays)[1]) for sensor in sensors), default=0)
    most = min(MOST_PARTS, isqrt(MOST_LAGS // (longest + 1))) // max(len(sensors), 1)
    return [
        Arrivals(owner, sensor, every, instant, _lags(sensor, instant, parts), longest)
        for owner, sensor in enumerate(sensors)
        for every, parts in [_recurrence(sensor.every, max(most, 1))]
        for instant in [sensor.offset + number * Fraction(every, parts) for number in range(parts)]
    ]


def _recurrence(every: Steps, most: int) -> tuple[int, int]:
    """The whole steps after which a sensor's measurements recur, and how many they are: at most so many."""
    near = Fraction(min(every, RAREST)).limit_denominator(most)
    return near.numerator, near.denominator


def _lags(sensor: Sensor, instant: Steps, parts: int) -> Ints:
    """Of a measurement of this instant, by its delay."""
    delays = sensor.delays[:: 1 + len(sensor.delays) * parts // MOST_DELAYS]
    return np.asarray(delays if isinstance(delays, range) else [steps_late(instant, delay) for delay in delays])


def going_back(sensors: Sequence[Sensor], predict: float, corrections: Sequence[float]) -> list[float]:
    """The work in an HR step that each sensor's late corrections do again, on average, if every correction lands in the
    step in which it arrives.

    predict, corrections: the work of one, of each sensor. A late one that arrives in step m finds the corrections of
    its own step and of later ones that have arrived before, or arrive in m too and are more urgent. Late ones of its
    own priority that arrive in m go back with it, to the earliest of them.
    """
    arrivals = _arrivals(sensors)
    works = [0.0] * len(sensors)
    for number, own in enumerate(arrivals):
        works[own.owner] += _going_back(number, arrivals, predict, corrections)
    return works


def _going_back(number: int, arrivals: Sequence[Arrivals], predict: float, corrections: Sequence[float]) -> float:
    own = arrivals[number]
    delays = np.flatnonzero(own.at)
    late = delays > 0
    taken = own.steps(arrivals, MOST_CASES // max(delays.size, 1) // len(arrivals))[:, np.newaxis]
    now = taken + delays
    first = np.broadcast_to(own.at[delays], now.shape)  # it arrives then, and no late one before it in the row does
    work = np.broadcast_to(delays * predict, now.shape)
    for index, rival in enumerate(arrivals):
        there = rival.before + rival.at if rival.priority < own.priority else rival.before
        counts = rival.sums(there, now, delays - (index == number))
        if rival.priority == own.priority:
            first = first * np.where(late, rival.products(1 - rival.at, now, delays + (index >= number)), 1)
            if index < number:  # of the same step, and known not to arrive now
                at, before = rival.at[delays], rival.before[delays]
                of_step = (taken - rival.offset) % rival.every == 0
                counts = counts + of_step * before * at / np.where(at < 1, 1 - at, np.inf)
        work = work + corrections[rival.owner] * counts
    return float((first * late * work).sum()) / taken.size / own.every


def share_at_once(sensor: Sensor) -> float:
    """Of its measurements that arrive, those that do so in the step in which they are taken."""
    if sensor.dropout == 1:
        return 0.0
    parts = _arrivals([sensor])
    return float(np.mean([part.at[0] for part in parts])) / (1 - sensor.dropout)


def numbers_in_flight(
    sensors: Sequence[Sensor],
    sensor: Sensor | None = None,
    *,
    at_once: bool = False,
    predictor: int | None = None,
) -> list[float]:
    """How many late measurements of each sensor are in flight at the start of a step, on average, if every correction
    lands in the step in which it arrives; a lost one is as long as its sensor's longest delay.

    sensor: of the steps in which it takes a measurement, where those count that the sensors before it take in the step.
    at_once: when its correction of such a step is made; then those of all sensors do, and none that has landed before.
    predictor: its priority, where corrections that are more urgent land before its job begins; else None.
    """
    parts = _arrivals(sensors)
    late = [arrivals for arrivals in parts if arrivals.sensor.delayed]
    if sensor is None:
        steps = _steps(1, 0, late, MOST_CASES)
    else:
        own = [arrivals for arrivals in parts if arrivals.sensor is sensor]
        steps = np.concatenate([part.steps(late, MOST_CASES // len(own)) for part in own])
    numbers = [0.0] * len(sensors)
    for arrivals in late:
        lags, longest = np.arange(arrivals.at.size), arrivals.sensor.longest_delay
        lost = arrivals.sensor.dropout * (lags < longest if at_once else lags <= longest)
        there = 1 - arrivals.sensor.dropout - arrivals.before + lost
        if sensor is not None and at_once and arrivals.priority <= sensor.priority:
            there -= arrivals.at
        if not at_once and predictor is not None and arrivals.priority < predictor:
            there -= arrivals.at
        taken_now = sensor is not None and (at_once or arrivals.owner < sensors.index(sensor))
        taken_now = taken_now and arrivals.sensor is not sensor
        there[0] = 1 - arrivals.at[0] if taken_now else 0
        numbers[arrivals.owner] += float(arrivals.sums(there, steps, np.full(steps.size, there.size - 1)).mean())
    return numbers


def in_flight(sensors: Sequence[Sensor], sensor: Sensor | None = None) -> float:
    """The share of steps at whose start Larsen's method has a measurement in flight; or, of the steps in which `sensor`
    takes its undelayed measurements, that in which one still is when their corrections have landed.

    A lost measurement is waited for until the next late one is taken. At most: one that is lost while another is in
    flight counts too.
    """
    late = [arrivals for arrivals in _arrivals(sensors) if arrivals.sensor.delayed]
    if sensor is None:
        steps = _steps(1, 0, late, MOST_CASES)
    else:
        parts = _arrivals([sensor])
        steps = np.concatenate([part.steps(late, MOST_CASES // len(parts)) for part in parts])
    flying = np.zeros(steps.size)
    lags = [(steps - 1 - arrivals.offset) % arrivals.every for arrivals in late]
    surely = [lag for arrivals, lag in zip(late, lags, strict=True) if arrivals.late]
    newest = np.min(surely, axis=0) if surely else np.full(steps.size, RAREST)
    waits = np.ones(steps.size, bool)  # for a lost one: no other is taken in this step, before the correction
    if sensor is not None:
        for arrivals in late:
            waits &= (steps - arrivals.offset) % arrivals.every > 0 if arrivals.late else True
    last: dict[int, Ints] = {}  # to the step before, since the last of all of a sensor's
    for arrivals, lag in zip(late, lags, strict=True):
        last[arrivals.owner] = np.minimum(lag, last.get(arrivals.owner, lag))
    for arrivals, lag in zip(late, lags, strict=True):
        there = 1 - arrivals.sensor.dropout - arrivals.before
        if sensor is not None and arrivals.priority <= sensor.priority:
            there = there - arrivals.at
        there[0] = 0
        flying += arrivals.sums(there, steps, np.full(steps.size, there.size - 1))
        if arrivals.sensor.dropout:
            flying += (
                arrivals.sensor.dropout
                / (1 - arrivals.at[0])
                * (waits & (lag <= newest) & (lag == last[arrivals.owner]))
            )
    return float(np.minimum(flying, 1).mean())
