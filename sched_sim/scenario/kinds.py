"""What the jobs of a sensor are filed under."""

from __future__ import annotations

from sched_sim.scenario.scenario import Sensor


def correct_kind(sensor: Sensor) -> str:
    """Of its corrections."""
    return f"correct {sensor.name}"


def gain_kind(sensor: Sensor) -> str:
    """Of its gains, where the filter is of dual rate."""
    return f"gain {sensor.name}"


def loss_kind(sensor: Sensor) -> str:
    """Of the jobs after a loss there."""
    return f"loss {sensor.name}"
