"""The measurements of a scenario as arrays: when each is taken, and when it arrives."""

from __future__ import annotations

from fractions import Fraction
from math import lcm
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.draws import lost_and_drawn
from sched_sim.scenario.engine.memory import NEVER
from sched_sim.scenario.fields import ends
from sched_sim.scenario.scenario import Scenario, Sensor

Ints: TypeAlias = npt.NDArray[np.int64]


class Measured(NamedTuple):
    """In the order in which they are taken, of one step in the sensors' order.

    step: in which it is taken; sensor: its number; arrives: in which step, NEVER if it does not.
    """

    step: Ints
    sensor: Ints
    arrives: Ints


def measured(scenario: Scenario, seed: int) -> Measured:
    """The same as the sensors' `measurements`."""
    found = [_of_sensor(sensor, scenario.steps, seed) for sensor in scenario.sensors]
    step = np.concatenate([taken for taken, _ in found])
    arrives = np.concatenate([arriving for _, arriving in found])
    sensor = np.repeat(np.arange(len(found)), [taken.size for taken, _ in found])
    order = np.lexsort((sensor, step))
    return Measured(step[order], sensor[order], arrives[order])


def _of_sensor(sensor: Sensor, steps: int, seed: int) -> tuple[Ints, Ints]:
    """In which steps its measurements are taken, and arrive."""
    takes = sensor.takes(steps)
    parts = _parts(sensor, steps)
    if parts is None:
        found = [*sensor.measurements(steps, seed)]
        arriving = [NEVER if late is None else step + late for step, late in found]
        return np.array([step for step, _ in found], np.int64), np.array(arriving, np.int64)
    taken = np.arange(takes.start, takes.stop, takes.step) if isinstance(takes, range) else np.array(takes, np.int64)
    lost, drawn = lost_and_drawn(len(sensor.delays), sensor.dropout, taken.size, seed, sensor.name)
    instants = int(sensor.offset * parts) + int(sensor.every * parts) * np.arange(taken.size)
    if isinstance(sensor.delays, range):
        delays = parts * (sensor.delays.start + sensor.delays.step * drawn)
    else:
        delays = np.array([int(delay * parts) for delay in sensor.delays], np.int64)[drawn]
    return taken, np.where(lost, NEVER, -(-(instants + delays) // parts))


def _parts(sensor: Sensor, steps: int) -> int | None:
    """So many to a step make all its times whole; None if they have more than 64 bits."""
    delays = () if isinstance(sensor.delays, range) else sensor.delays
    parts = lcm(*(Fraction(time).denominator for time in (sensor.every, sensor.offset, *delays)))
    longest = steps + sensor.every + sensor.offset + ends(sensor.delays)[1]
    return parts if parts * longest < 1 << 62 else None
