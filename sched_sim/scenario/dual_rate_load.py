"""The mean work of the dual-rate filter's jobs, if each correction lands in the step after that in which it arrives.

Over the beginning of a long scenario; of many delays, over some of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.instants import lag
from sched_sim.scenario.scenario import Scenario, Sensor

Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]

MOST_STEPS = 100_000
"""So many of a scenario are looked at."""
MOST_PAIRS = 300_000
"""So many of a measurement and one that its correction goes past, of two sensors."""
MOST_DELAYS = 300
"""So many of a sensor's; of more, every second, third, ..."""


class SensorWork(NamedTuple):
    """Of a sensor's jobs, in a step."""

    gain: float
    correct: float
    loss: float


class Work(NamedTuple):
    """In a step. sensors: by their number."""

    predict: float
    sensors: list[SensorWork]


def mean_work(scenario: Scenario) -> Work:
    """In cost units."""
    steps, sensors = min(scenario.steps, MOST_STEPS), scenario.sensors
    within = [_takes(sensor, steps) for sensor in sensors]
    first = _first_of_their_steps(within)
    restarts = sum(first) / steps
    predict = (1 - restarts) * _mean(scenario, "hr_propagate") + restarts * _mean(scenario, "hr_restart")
    of_sensors = []
    for number, sensor in enumerate(sensors):
        rate = len(within[number]) / steps
        arrive = rate * (1 - sensor.dropout)
        if arrive:
            predict += arrive * (_mean(scenario, "hr_update") + _passes(scenario, number, steps))
        gains = rate * _mean(scenario, f"gain.{sensor.name}") + first[number] / steps * _mean(scenario, "lr_propagate")
        lost = rate * sensor.dropout
        of_sensors.append(
            SensorWork(
                gains,
                arrive * _mean(scenario, f"lr_correct.{sensor.name}"),
                lost * _again(scenario, number, steps) if lost else 0.0,
            )
        )
    return Work(predict, of_sensors)


def _passes(scenario: Scenario, number: int, steps: int) -> float:
    """The work of one landing's way past the measurements taken since, and for those that land with it."""
    sensor = scenario.sensors[number]
    lags = np.sort(_lags(sensor))
    longest, work = int(lags[-1]) + 1, 0.0
    for other, rival in enumerate(scenario.sensors):
        pairs = _since(scenario.sensors, number, other, longest, steps)
        past = 1 - _share(lags, pairs.apart - 1)
        work += float(past.sum()) / pairs.of * _mean(scenario, f"hr_pass.{rival.name}")
        earlier = np.sort((lags[:, np.newaxis] - _lags(rival)).ravel())
        together = (1 - rival.dropout) * (_share(earlier, pairs.apart) - _share(earlier, pairs.apart - 1))
        work += float(together.sum()) / pairs.of * _mean(scenario, f"lr_correct.{rival.name}")
    return work


def _again(scenario: Scenario, number: int, steps: int) -> float:
    """The work after the loss of one."""
    lands = scenario.sensors[number].land_by
    work, others = _mean(scenario, f"gain_again.{scenario.sensors[number].name}"), scenario.sensors
    stepped = _first_of_their_steps([_takes(rival, steps) for rival in others])
    for other, rival in enumerate(others):
        pairs = _since(others, number, other, lands, steps)
        lags = np.sort(_lags(rival))
        landed = (1 - rival.dropout) * _share(lags, lands - 1 - pairs.apart)
        landed += rival.dropout * (pairs.apart + rival.land_by < lands)  # known to be lost too
        again, kept = (_mean(scenario, f"{kind}.{rival.name}") for kind in ("gain_again", "gain_kept"))
        first = stepped[other] / max(len(_takes(rival, steps)), 1)
        carried = float((pairs.apart > 0).sum()) * first * _mean(scenario, "lr_propagate")
        work += (float((landed * kept + (1 - landed) * again).sum()) + carried) / pairs.of
    return work


def _share(values: Ints, most: Ints) -> Floats:
    """Of these, sorted, those that are at most so large."""
    return np.asarray(np.searchsorted(values, most, side="right") / len(values))


class _Pairs(NamedTuple):
    """apart: in steps, of a measurement and one taken behind it; of: so many of the first."""

    apart: Ints
    of: int


def _since(sensors: Sequence[Sensor], number: int, other: int, within: int, steps: int) -> _Pairs:
    """Measurements of a sensor, and those of another taken behind them, less than so many steps later."""
    takes, others = _takes(sensors[number], steps), _takes(sensors[other], steps + within)
    first = np.searchsorted(others, takes, side="left" if other > number else "right")
    behind = np.searchsorted(others, takes + within, side="left") - first
    if (count := int(behind.sum())) > MOST_PAIRS:
        chosen = slice(None, None, count // MOST_PAIRS + 1)
        takes, first, behind = takes[chosen], first[chosen], behind[chosen]
    starts = np.repeat(first - np.cumsum(behind) + behind, behind)
    apart = others[starts + np.arange(len(starts))] - np.repeat(takes, behind)
    return _Pairs(apart, len(takes))


def _takes(sensor: Sensor, steps: int) -> Ints:
    return np.asarray(sensor.takes(steps), dtype=np.int64)


def _first_of_their_steps(takes: Sequence[Ints]) -> list[int]:
    """How many of each sensor's are the first that is taken in their step."""
    found, before = [], np.empty(0, np.int64)
    for own in takes:
        found.append(int((~np.isin(own, before)).sum()))
        before = np.union1d(before, own)
    return found


def _lags(sensor: Sensor) -> Ints:
    """Steps from that in which one is taken to that in which it arrives, as its delays have it."""
    chosen = sensor.delays[:: 1 + len(sensor.delays) // MOST_DELAYS]
    return np.array([lag(sensor.offset, delay) for delay in chosen])


def _mean(scenario: Scenario, part: str) -> float:
    costs = scenario.costs[part]
    return float(sum(costs)) / len(costs)
