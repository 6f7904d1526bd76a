"""What a scenario asks of the processors on average: the sum of mean cost over mean period, and whether a late
correction can catch up."""

from __future__ import annotations

from typing import NamedTuple

from sched_sim.scenario import Scenario, Sensor


class Load(NamedTuple):
    """share: of the time of one processor, `cpu` (from 0), that these jobs take on average; 1 is all of it."""

    name: str
    cpu: int
    share: float


class CatchingUp(NamedTuple):
    """Work in one HR period, in cost units. needed: by a step that passed meanwhile; left: by more urgent jobs."""

    needed: float
    left: float

    @property
    def never(self) -> bool:
        return self.needed >= self.left


def loads(scenario: Scenario) -> list[Load]:
    """Without context switches and catching up; each late measurement with a replay of its own."""
    speed, last = float(scenario.speed), scenario.cpus - 1
    found = [Load("predict", 0, _predict(scenario) / speed)]
    for sensor in scenario.sensors:
        found.append(Load(f"correct {sensor.name}", last, _correct(scenario, sensor) / speed))
        replayed = 0.0 if scenario.late == "larsen" else _rate(sensor) * _mean_delay(sensor)
        if replayed:
            found.append(Load(f"replay for {sensor.name}", last, replayed * _step_again(scenario) / speed))
    return [*found, *(Load(task.name, task.cpu - 1, float(task.cost / task.period) / speed) for task in scenario.tasks)]


def demand(scenario: Scenario) -> list[float]:
    """Of each processor: more than 1 is more than it can do."""
    return [sum(load.share for load in loads(scenario) if load.cpu == cpu) for cpu in range(scenario.cpus)]


def catching_up(scenario: Scenario, sensor: Sensor) -> CatchingUp | None:
    """None if its corrections need not: nothing overtakes them, or they are carried to the step they land in."""
    if not scenario.preempted(sensor) or (scenario.late == "larsen" and sensor.delayed):
        return None
    cpu = scenario.cpus - 1
    ahead = _predict(scenario) if cpu == 0 and scenario.priority <= sensor.priority else 0.0
    ahead += sum(_correct(scenario, one) for one in scenario.sensors if one.priority < sensor.priority)
    tasks = [task for task in scenario.tasks if task.cpu - 1 == cpu and task.priority < sensor.priority]
    ahead += sum(float(task.cost / task.period) for task in tasks)
    return CatchingUp(_step_again(scenario), float(scenario.speed) - ahead)


def _mean(scenario: Scenario, part: str) -> float:
    costs = scenario.costs[part]
    return float(sum(costs)) / len(costs)


def _rate(sensor: Sensor) -> float:
    """Arrivals in a step."""
    return (1 - sensor.dropout) / sensor.every


def _mean_delay(sensor: Sensor) -> float:
    return sum(sensor.delays) / len(sensor.delays)


def _in_flight(scenario: Scenario) -> float:
    """The share of steps in which Larsen's product is kept up for some sensor; of several, as if they took turns."""
    if scenario.late != "larsen":
        return 0.0
    shares = [
        (1 - sensor.dropout) * min(_mean_delay(sensor) / sensor.every, 1) + sensor.dropout
        for sensor in scenario.sensors
        if sensor.delayed
    ]
    return min(sum(shares), 1.0)


def _mixed(scenario: Scenario, part: str, of: str = "") -> float:
    """The mean cost of a part that runs as "..._accumulate" while a measurement is in flight."""
    share = _in_flight(scenario)
    accumulating = share * _mean(scenario, f"{part}_accumulate{of}") if share else 0.0
    return accumulating + (1 - share) * _mean(scenario, f"{part}{of}")


def _predict(scenario: Scenario) -> float:
    """Work in a step."""
    return _mixed(scenario, "predict")


def _correct(scenario: Scenario, sensor: Sensor) -> float:
    """Work in a step, without replay."""
    if scenario.late == "larsen" and sensor.delayed:
        return _rate(sensor) * _mean(scenario, f"correct_late.{sensor.name}")
    return _rate(sensor) * _mixed(scenario, "correct", f".{sensor.name}")


def _step_again(scenario: Scenario) -> float:
    """Work to do a step again, with the corrections in it."""
    return _mean(scenario, "predict") + sum(_correct(scenario, sensor) for sensor in scenario.sensors)
