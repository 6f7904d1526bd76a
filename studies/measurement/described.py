"""What the user's own composed filter says of its sensors, for a scenario that names it."""

from __future__ import annotations

from contextlib import chdir
from pathlib import Path

from filters.modular.composition import Sensor
from sched_sim.scenario.composition import ComposedSensor, Composition
from studies.measurement.user_filter import composed_by

EXAMPLE = 'filter = "mymodule:my_filter" for a file mymodule.py in the folder of the scenario'
UNSAID = 1.0
"""dt, in seconds, of a filter for which none was given."""


def describe_filter(name: str, folder: Path = Path()) -> Composition:
    """The sensors of the filter that the function `package.module:function` returns; the folder is searched first.

    For `sched_sim.read_scenario`, whose file names the filter.
    Raises InputError that says what is wrong with the name, the module or what the function returned.
    """
    with chdir(folder):
        composed = composed_by(name, "filter", EXAMPLE).composed
    sensors = {sensor.name: _described(sensor) for sensor in composed.sensors}
    return Composition(sensors, None if composed.dt == UNSAID else composed.dt)


def _described(sensor: Sensor) -> ComposedSensor:
    delays = sensor.delays if isinstance(sensor.delays, range) else tuple(map(int, sensor.delays))
    return ComposedSensor(sensor.every, delays, float(sensor.dropout))
