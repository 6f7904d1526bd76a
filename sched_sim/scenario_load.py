"""What a scenario asks of the processors on average: the sum of mean cost over mean period, and whether a late
correction can catch up."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from math import ceil
from typing import NamedTuple

from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_pattern import GoingBack, going_back, in_flight

ROUNDING = 1e-9
"""Relative; of sums of means."""


class Load(NamedTuple):
    """share: of the time of one processor, `cpu` (from 0), that these jobs take on average; 1 is all of it.

    gives_way: it is less where there is no time: corrections that wait for one another go back together.
    """

    name: str
    cpu: int
    share: float
    gives_way: bool = False


class CatchingUp(NamedTuple):
    """Work in one HR period, in cost units. needed: by a step that passed meanwhile; left: by more urgent jobs."""

    needed: float
    left: float

    @property
    def never(self) -> bool:
        return self.needed >= self.left


def loads(scenario: Scenario) -> list[Load]:
    """Each correction starting as it arrives, and a preempted one catching up as if all steps left it the same time;
    without context switches."""
    speed, last = float(scenario.speed), scenario.cpus - 1
    found = [Load("predict", 0, _predict(scenario) / speed)]
    replays = _replays(scenario)
    for sensor in scenario.sensors:
        found.append(Load(f"correct {sensor.name}", last, _correct(scenario, sensor) / speed))
        if replay := replays.get(sensor.name):
            found.append(Load(f"replay for {sensor.name}", last, replay / speed, scenario.preempted(sensor)))
    found += [Load(task.name, task.cpu - 1, float(task.cost / task.period) / speed) for task in scenario.tasks]
    return [*found, *_catching_up_loads(scenario)]


def demand(scenario: Scenario) -> list[float]:
    """Of each processor: more than 1 is more than it can do at once."""
    return [sum(load.share for load in loads(scenario) if load.cpu == cpu) for cpu in range(scenario.cpus)]


def catching_up(scenario: Scenario, sensor: Sensor) -> CatchingUp | None:
    """None if its corrections need not: nothing overtakes them, or they are carried to the step they land in.

    needed: at the least; of the corrections made in that step, only more urgent ones have been.
    """
    if not scenario.preempted(sensor) or _is_larsens(scenario, sensor):
        return None
    cpu = scenario.cpus - 1
    urgent = [one for one in scenario.sensors if one.priority < sensor.priority]
    needed = _mean(scenario, "predict")
    needed += sum(_rate(one) * _mean(scenario, f"{_part(scenario, one)}.{one.name}") for one in urgent)
    replays = _replays(scenario)
    ahead = _predict(scenario) if cpu == 0 and scenario.priority <= sensor.priority else 0.0
    ahead += sum(_correct(scenario, one) + replays.get(one.name, 0) for one in urgent)
    tasks = [task for task in scenario.tasks if task.cpu - 1 == cpu and task.priority < sensor.priority]
    ahead += sum(float(task.cost / task.period) for task in tasks)
    return CatchingUp(needed, float(scenario.speed) - ahead)


def _catching_up_loads(scenario: Scenario) -> Iterator[Load]:
    """Of the corrections of each priority that are preempted. Work of more than a step goes on until the steps that
    pass meanwhile are done again too: at most it takes all the time there is until the next arrives."""
    replays, jobs_of = _replays(scenario), {name: again.jobs for name, again in _going_back(scenario).items()}
    replayed = [sensor for sensor in scenario.sensors if not _is_larsens(scenario, sensor)]
    for _, of_priority in groupby(sorted(replayed, key=_priority), _priority):
        sensors = list(of_priority)
        found, jobs = catching_up(scenario, sensors[0]), sum(jobs_of[sensor.name] for sensor in sensors)
        if found is None or not jobs:
            continue
        work = sum(_correct(scenario, sensor) + replays.get(sensor.name, 0) for sensor in sensors) / jobs
        again = max(found.left / jobs - work, 0.0)
        if not found.never:
            passed = ceil((work - found.left) / (found.left - found.needed) - ROUNDING)
            again = min(again, max(passed, 0) * found.needed)
        if again and work > found.left * (1 + ROUNDING):
            name, share = ", ".join(sensor.name for sensor in sensors), again * jobs / float(scenario.speed)
            yield Load(f"catching up for {name}", scenario.cpus - 1, share, gives_way=True)


def _priority(sensor: Sensor) -> int:
    return sensor.priority


def _is_larsens(scenario: Scenario, sensor: Sensor) -> bool:
    """Whether its late measurements are carried to the step in which they land."""
    return scenario.late == "larsen" and sensor.delayed


def _part(scenario: Scenario, sensor: Sensor) -> str:
    return "correct_late" if _is_larsens(scenario, sensor) else "correct"


def _mean(scenario: Scenario, part: str) -> float:
    costs = scenario.costs[part]
    return float(sum(costs)) / len(costs)


def _rate(sensor: Sensor) -> float:
    """Arrivals in a step."""
    return (1 - sensor.dropout) / sensor.every


def _replays(scenario: Scenario) -> dict[str, float]:
    """Work in a step to do again what late measurements come too late for, by the sensor that does it."""
    if scenario.late == "larsen":
        return {}
    corrections = [_mean(scenario, f"correct.{sensor.name}") for sensor in scenario.sensors]
    predict = _mean(scenario, "predict")
    return {
        name: again.steps * predict
        + sum(count * work for count, work in zip(again.corrections, corrections, strict=True))
        for name, again in _going_back(scenario).items()
    }


def _going_back(scenario: Scenario) -> dict[str, GoingBack]:
    names = (sensor.name for sensor in scenario.sensors)
    return dict(zip(names, going_back(scenario.sensors), strict=True))


def _mixed(scenario: Scenario, part: str, of: Sensor | None = None) -> float:
    """The mean cost of a part that runs as "..._accumulate" while a measurement is in flight."""
    name = "" if of is None else f".{of.name}"
    share = in_flight(scenario.sensors, of) if scenario.late == "larsen" else 0.0
    accumulating = share * _mean(scenario, f"{part}_accumulate{name}") if share else 0.0
    return accumulating + (1 - share) * _mean(scenario, f"{part}{name}")


def _predict(scenario: Scenario) -> float:
    """Work in a step."""
    return _mixed(scenario, "predict")


def _correct(scenario: Scenario, sensor: Sensor) -> float:
    """Work in a step, without replay."""
    if _is_larsens(scenario, sensor):
        return _rate(sensor) * _mean(scenario, f"correct_late.{sensor.name}")
    return _rate(sensor) * _mixed(scenario, "correct", sensor)
