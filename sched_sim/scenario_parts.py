"""Mean costs of a scenario's parts, and what its late measurements make the filter do again."""

from __future__ import annotations

from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_pattern import GoingBack, going_back


def mean(scenario: Scenario, part: str) -> float:
    costs = scenario.costs[part]
    return float(sum(costs)) / len(costs)


def rate(sensor: Sensor) -> float:
    """Arrivals in a step."""
    return (1 - sensor.dropout) / sensor.every


def is_larsens(scenario: Scenario, sensor: Sensor) -> bool:
    """Whether its late measurements are carried to the step in which they land."""
    return scenario.late == "larsen" and sensor.delayed


def correction(scenario: Scenario, sensor: Sensor) -> float:
    """One, made again."""
    return mean(scenario, f"{'correct_late' if is_larsens(scenario, sensor) else 'correct'}.{sensor.name}")


def replays(scenario: Scenario) -> dict[str, GoingBack]:
    """Of each sensor, what its corrections do again; those that Larsen's method carries do nothing again."""
    sensors = scenario.sensors
    if scenario.late == "larsen":
        found = [GoingBack(rate(sensor), 0.0, 0.0) for sensor in sensors]
    else:
        corrections = [correction(scenario, sensor) for sensor in sensors]
        found = going_back(sensors, mean(scenario, "predict"), corrections)
    return {sensor.name: again for sensor, again in zip(sensors, found, strict=True)}
