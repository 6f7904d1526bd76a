"""What a filter of several sensors starts a simulated scenario with: what it settles to."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import ceil, floor, lcm
from typing import NamedTuple

from filters.accuracy.riccati import posterior
from filters.accuracy.sensors import SensorsModel, settled
from filters.accuracy.visible import visible
from filters.arrays import FloatArray
from sched_sim.scenario.instants import taken
from sched_sim.scenario.scenario import Sensor

MOST_MEASUREMENTS = 2000
"""In the cycle whose settled covariance it is."""


class Start(NamedTuple):
    """P0 (n, n), None where nothing settles; the model, and the rows of its outputs (o, n)."""

    P0: FloatArray | None
    model: SensorsModel
    rows: FloatArray


def settled_start(of: SensorsModel, outputs: FloatArray, sensors: Sequence[Sensor]) -> Start:
    """That of a filter which has long had every measurement without delay, each worth its share that is not lost.

    outputs (o, n): C; what they do not depend on and nobody measures is left out of the model.
    """
    try:
        model, rows = visible(of.stacked, outputs)
    except ValueError:
        return Start(None, of, outputs)
    reduced = _split(of, model.Phi, model.Q, model.H)
    cycle = _cycle(sensors)
    sharing = {
        sensor.name: (H, R / (1 - sensor.dropout))
        for sensor in sensors
        if sensor.dropout < 1
        for H, R in [reduced.sensors[sensor.name]]
    }
    if not sharing:
        return Start(None, reduced, rows)
    takes = {
        sensor.name: sorted({step % cycle for step in taken(sensor.every, sensor.offset % sensor.every, cycle + 1)})
        for sensor in sensors
        if sensor.name in sharing
    }
    try:
        P0 = settled(reduced._replace(sensors=sharing), takes, cycle)
    except ValueError:
        return Start(None, reduced, rows)
    for sensor in sensors:
        if 0 in takes.get(sensor.name, ()) and sensor.offset > 0:  # taken before the simulation, for its first step
            P0 = posterior(P0, *sharing[sensor.name])[1]
    return Start(P0, reduced, rows)


def _split(of: SensorsModel, Phi: FloatArray, Q: FloatArray, H: FloatArray) -> SensorsModel:
    """H: of all sensors, one below the other."""
    sensors, row = {}, 0
    for name, (_, R) in of.sensors.items():
        sensors[name] = (H[row : row + len(R)], R)
        row += len(R)
    return SensorsModel(Phi, 0.5 * (Q + Q.T), sensors)


def _cycle(sensors: Sequence[Sensor]) -> int:
    """Steps after which all sensors measure as before; fewer where that is too long."""
    intervals = [Fraction(sensor.every) for sensor in sensors]
    scale = lcm(*(interval.denominator for interval in intervals))
    steps = Fraction(lcm(*(int(interval * scale) for interval in intervals)), scale).numerator
    rate = sum(1 / interval for interval in intervals)
    return min(steps, max(floor(MOST_MEASUREMENTS / rate), ceil(max(intervals))))
