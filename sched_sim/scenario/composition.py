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
    given = document.get("sensor", [])
    if not isinstance(given, list):
        return dict(document)
    names = [entry.get("name") if isinstance(entry, dict) else None for entry in given]
    own = [entry for name in composition.sensors for entry in _entries(name, names, given)]
    return {
        **document,
        "sensor": own + [e for name, e in zip(names, given, strict=True) if not _known(name, composition)],
    }


def _known(name: Any, composition: Composition) -> bool:
    return isinstance(name, str) and name in composition.sensors


def _entries(name: str, names: Sequence[Any], given: Sequence[Any]) -> list[Any]:
    return [entry for other, entry in zip(names, given, strict=True) if other == name] or [{"name": name}]
