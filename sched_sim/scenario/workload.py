"""A scenario in whole ticks: what its simulation is given, by SimPy or by compiled code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sched_sim.scenario.kinds import correct_kind, gain_kind, loss_kind
from sched_sim.scenario.scenario import Scenario, needed_parts
from sched_sim.schedule.tasks import TaskSource, work_and_times
from sched_sim.ticks import ticks_per_unit, to_ticks


@dataclass(frozen=True)
class Workload:
    """period: the HR period; costs: by part, all that the filter runs; resolution: ticks per cost unit."""

    scenario: Scenario
    resolution: int
    period: int
    context_switch: int
    costs: Mapping[str, Sequence[int]]

    @property
    def horizon(self) -> int:
        return self.scenario.steps * self.period

    @property
    def kinds(self) -> list[str]:
        """Of jobs."""
        return kinds_of_jobs(self.scenario)

    def tasks(self) -> list[TaskSource]:
        return [TaskSource(task, self.scenario.speed, self.resolution) for task in self.scenario.tasks]


def kinds_of_jobs(scenario: Scenario) -> list[str]:
    """The filter's, then the tasks'."""
    dual_rate = scenario.late == "dual-rate"
    of_sensors = []
    for sensor in scenario.sensors:
        if dual_rate:
            of_sensors.append(gain_kind(sensor))
        of_sensors.append(correct_kind(sensor))
        if dual_rate and sensor.dropout:
            of_sensors.append(loss_kind(sensor))
    return ["predict", *of_sensors, *(f"task:{task.name}" for task in scenario.tasks)]


def workload(scenario: Scenario) -> Workload:
    parts = needed_parts(scenario.sensors, scenario.late, scenario.carries)
    speed = scenario.speed
    resolution = ticks_per_unit(
        [
            speed,
            scenario.context_switch,
            *(cost for part in parts for cost in scenario.costs[part]),
            *(value for task in scenario.tasks for value in work_and_times(task, speed)),
        ]
    )
    return Workload(
        scenario,
        resolution,
        to_ticks(speed, resolution),
        to_ticks(scenario.context_switch, resolution),
        {part: [to_ticks(cost, resolution) for cost in scenario.costs[part]] for part in parts},
    )
