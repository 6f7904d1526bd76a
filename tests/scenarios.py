"""Scenarios, made in a line each."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import ceil, floor
from pathlib import Path
from typing import Any

from sched_sim.scenario.instants import Steps
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.outcome import Slice

HR, LR = 10, 20
ROCKET = Path(__file__).parent / "rocket.toml"

Costs = dict[str, tuple[Fraction, ...]]


def costs(entries: dict[str, Any]) -> Costs:
    """A number stands for one sample."""
    return {
        part: tuple(Fraction(str(value)) for value in (values if isinstance(values, list) else [values]))
        for part, values in entries.items()
    }


def sensor(name: str, every: Steps, delay: Steps | Sequence[Steps] = 0, **settings: Any) -> Sensor:
    delays = delay if isinstance(delay, Sequence) else (delay,)
    return Sensor(name, every, delays, **({"land_by": ceil(max(delays)) + floor(every) - 1} | settings))


def scenario(speed: object, entries: dict[str, Any], *sensors: Sensor, steps: int = 400, **settings: Any) -> Scenario:
    return Scenario("test", sensors=sensors, speed=Fraction(str(speed)), costs=costs(entries), steps=steps, **settings)


def slices_of(of: Scenario, kind: str) -> list[tuple[int, int]]:
    """(start, end) of all that ran of one kind."""
    found: list[Slice] = []
    run_scenario(of, on_slice=found.append)
    return [(piece.start, piece.end) for piece in found if piece.kind == kind and piece.start < piece.end]


BY_HAND = {"predict": 4, "correct.gps": 2, "correct.imu": 1}
"""In a period of 10."""
