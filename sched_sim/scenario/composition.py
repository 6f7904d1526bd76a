"""What a composed filter says of its sensors, for the scenario that simulates it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from sched_sim.scenario.instants import Steps


class ComposedSensor(NamedTuple):
    """One; every and delays in HR steps, as in `scenario.Sensor`."""

    every: Steps
    delays: Sequence[Steps]
    dropout: float


class Composition(NamedTuple):
    """sensors: by name, in the order in which a step uses them; dt: of a step, in seconds, None if it is not said."""

    sensors: Mapping[str, ComposedSensor]
    dt: float | None


Describe: TypeAlias = Callable[[str, Path], Composition]
"""Of the filter that the user's function `package.module:function` returns, its module in this folder or installed;
raises InputError."""


def with_its_sensors(document: Mapping[str, Any], composition: Composition) -> dict[str, Any]:
    """A scenario file with a [[sensor]] for each of the filter's, in the filter's order; what it says of them stays."""
    given, names = document.get("sensor", []), [*composition.sensors]
    if not isinstance(given, list):
        return dict(document)
    there = [*map(_name, given)]
    all_of_them = [*given, *({"name": name} for name in names if name not in there)]
    return {**document, "sensor": sorted(all_of_them, key=lambda entry: [*names, _name(entry)].index(_name(entry)))}


def _name(entry: Any) -> Any:
    return entry.get("name") if isinstance(entry, Mapping) else None
