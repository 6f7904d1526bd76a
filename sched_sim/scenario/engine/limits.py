"""Whether the whole numbers of compiled code, of 64 bits, hold a scenario's times."""

from __future__ import annotations

from sched_sim.scenario.workload import Workload
from sched_sim.schedule.engine import MOST_TICKS


def holds(work: Workload) -> bool:
    return max(_longest_job(work), *_latest_instants(work)) < MOST_TICKS


def _longest_job(work: Workload) -> int:
    """At most: all predictions and corrections, twice; where several are in flight, each beside each; and a context
    switch before each job."""
    scenario = work.scenario
    measurements = sum(len(sensor.takes(scenario.steps)) for sensor in scenario.sensors)
    tasks = sum(int(scenario.steps / task.period) + 2 for task in scenario.tasks)
    beside = measurements**2 if scenario.carries is not None else 0
    executions = scenario.steps + 4 * measurements + beside
    switches = scenario.steps + 3 * measurements + tasks
    return executions * max(max(times) for times in work.costs.values()) + switches * work.context_switch


def _latest_instants(work: Workload) -> list[int]:
    """Up to which it reckons: deadlines, and the releases of tasks."""
    scenario = work.scenario
    latest_due = max(scenario.due(sensor) for sensor in scenario.sensors)
    tasks = [source.nominal + source.cost + 2 * source.period for source in work.tasks()]
    return [(scenario.steps + latest_due) * work.period, *(work.horizon + time for time in tasks)]
