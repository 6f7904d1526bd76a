"""How a scenario's measurements meet: which arrive together, what a late one finds corrected already, how often one is
in flight. On average over one whole pattern of the sensors; of a very long pattern, over its beginning."""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.scenario import Sensor

Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]

MOST_DELAYS = 100_000
"""So many of a sensor's delays are looked at; of more, every second, third, ..."""
MOST_CASES = 200_000
"""So many pairs of a measurement and its delay are looked at, of all sensors."""
RAREST = 1 << 40
"""HR steps between measurements; what is rarer meets nothing."""


class Arrivals:
    """One sensor's. at: the probability that a measurement arrives so many steps late, by lag; before: that it has
    arrived earlier than that."""

    def __init__(self, sensor: Sensor, longest: int) -> None:
        delays = np.asarray(sensor.delays[:: 1 + len(sensor.delays) // MOST_DELAYS])
        self.sensor = sensor
        self.priority = sensor.priority
        self.every = min(sensor.every, RAREST)
        self.offset = sensor.offset % self.every
        self.at: Floats = (1 - sensor.dropout) * np.bincount(delays, minlength=longest + 1) / delays.size
        self.before: Floats = np.cumsum(self.at) - self.at

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
    longest = max((sensor.longest_delay for sensor in sensors), default=0)
    return [Arrivals(sensor, longest) for sensor in sensors]


def going_back(sensors: Sequence[Sensor], predict: float, corrections: Sequence[float]) -> list[float]:
    """The work in an HR step that each sensor's late corrections do again, on average, if every correction lands in the
    step in which it arrives.

    predict, corrections: the work of one, of each sensor. A late one that arrives in step m finds the corrections of
    its own step and of later ones that have arrived before, or arrive in m too and are more urgent. Late ones of its
    own priority that arrive in m go back with it, to the earliest of them.
    """
    arrivals = _arrivals(sensors)
    return [_going_back(number, arrivals, predict, corrections) for number in range(len(arrivals))]


def _going_back(number: int, arrivals: Sequence[Arrivals], predict: float, corrections: Sequence[float]) -> float:
    own = arrivals[number]
    delays = np.flatnonzero(own.at)
    late = delays > 0
    taken = own.steps(arrivals, MOST_CASES // max(delays.size, 1) // len(arrivals))[:, np.newaxis]
    now = taken + delays
    first = np.broadcast_to(own.at[delays], now.shape)  # it arrives then, and no late one before it in the row does
    work = np.broadcast_to(delays * predict, now.shape)
    for index, (rival, correction) in enumerate(zip(arrivals, corrections, strict=True)):
        there = rival.before + rival.at if rival.priority < own.priority else rival.before
        counts = rival.sums(there, now, delays - (index == number))
        if rival.priority == own.priority:
            first = first * np.where(late, rival.products(1 - rival.at, now, delays + (index >= number)), 1)
            if index < number:  # of the same step, and known not to arrive now
                at, before = rival.at[delays], rival.before[delays]
                of_step = (taken - rival.offset) % rival.every == 0
                counts = counts + of_step * before * at / np.where(at < 1, 1 - at, np.inf)
        work = work + correction * counts
    return float((first * late * work).sum()) / taken.size / own.every


def in_flight(sensors: Sequence[Sensor], sensor: Sensor | None = None) -> float:
    """The share of steps at whose start Larsen's method has a measurement in flight; or, of the steps in which `sensor`
    takes its undelayed measurements, that in which one still is when their corrections have landed.

    A lost measurement is waited for until the next late one is taken. At most: one that is lost while another is in
    flight counts too.
    """
    late = [arrivals for arrivals in _arrivals(sensors) if arrivals.sensor.delayed]
    every, offset = (1, 0) if sensor is None else (min(sensor.every, RAREST), sensor.offset)
    steps = _steps(every, offset % every, late, MOST_CASES)
    flying = np.zeros(steps.size)
    lags = [(steps - 1 - arrivals.offset) % arrivals.every for arrivals in late]  # to the step before, since the last
    surely = [lag for arrivals, lag in zip(late, lags, strict=True) if arrivals.sensor.least_delay > 0]
    newest = np.min(surely, axis=0) if surely else np.full(steps.size, RAREST)
    waits = np.ones(steps.size, bool)  # for a lost one: no other is taken in this step, before the correction
    if sensor is not None:
        for arrivals in late:
            waits &= (steps - arrivals.offset) % arrivals.every > 0 if arrivals.sensor.least_delay > 0 else True
    for arrivals, lag in zip(late, lags, strict=True):
        there = 1 - arrivals.sensor.dropout - arrivals.before
        if sensor is not None and arrivals.priority <= sensor.priority:
            there = there - arrivals.at
        there[0] = 0
        flying += arrivals.sums(there, steps, np.full(steps.size, there.size - 1))
        if arrivals.sensor.dropout:
            flying += arrivals.sensor.dropout / (1 - arrivals.at[0]) * (waits & (lag <= newest))
    return float(np.minimum(flying, 1).mean())
