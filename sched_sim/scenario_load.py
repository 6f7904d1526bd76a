"""What a scenario asks of the processors on average: the sum of mean cost over mean period, and whether a late
correction can catch up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_landing import landings, tasks_ahead
from sched_sim.scenario_parts import correction, is_larsens, mean, rate, replays
from sched_sim.scenario_pattern import in_flight


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
    """Without context switches; each correction starts as it arrives. What preempted ones do because they take longer
    than their step is the most that it can be, with delays and costs that are certain."""
    speed, last = float(scenario.speed), scenario.cpus - 1
    found = [Load("predict", 0, _predict(scenario) / speed)]
    again = replays(scenario)
    for sensor in scenario.sensors:
        found.append(Load(f"correct {sensor.name}", last, _correct(scenario, sensor) / speed))
        if work := again[sensor.name].work:
            found.append(Load(f"replay for {sensor.name}", last, work / speed, scenario.preempted(sensor)))
    found += [Load(task.name, task.cpu - 1, float(task.cost / task.period) / speed) for task in scenario.tasks]
    return [*found, *_catching_up_loads(scenario)]


def demand(scenario: Scenario) -> list[float]:
    """Of each processor: more than 1 is more than it can do at once."""
    return [sum(load.share for load in loads(scenario) if load.cpu == cpu) for cpu in range(scenario.cpus)]


def switching(scenario: Scenario) -> list[float]:
    """The share of each processor's time that context switches take beside `demand`, at the most.

    A job that is released preempts one other at most, so there are two dispatches for each. What preempted corrections
    do again because they take longer is not in it.
    """
    jobs = [0.0] * scenario.cpus
    jobs[0] += 1
    jobs[-1] += sum(rate(sensor) for sensor in scenario.sensors)
    for task in scenario.tasks:
        jobs[task.cpu - 1] += float(1 / task.period)
    return [2 * each * float(scenario.context_switch / scenario.speed) for each in jobs]


def catching_up(scenario: Scenario, sensor: Sensor) -> CatchingUp | None:
    """None if its corrections need not: nothing overtakes them, or they are carried to the step they land in.

    needed: at the least; of the corrections made in that step, only more urgent ones have been.
    """
    if not scenario.preempted(sensor) or is_larsens(scenario, sensor):
        return None
    urgent = [one for one in scenario.sensors if one.priority < sensor.priority]
    again = replays(scenario)
    needed = mean(scenario, "predict") + sum(rate(one) * correction(scenario, one) for one in urgent)
    ahead = _predict(scenario) if scenario.cpus == 1 else 0.0
    ahead += sum(_correct(scenario, one) + again[one.name].work for one in urgent)
    ahead += sum(float(task.cost / task.period) for task in tasks_ahead(scenario, sensor.priority))
    return CatchingUp(needed, float(scenario.speed) - ahead)


def _catching_up_loads(scenario: Scenario) -> Iterator[Load]:
    """Of the corrections of each priority that are preempted: at most all the time that is left to them."""
    again = replays(scenario)
    for priority, landing in landings(scenario).items():
        sensors = [one for one in scenario.sensors if one.priority == priority and not is_larsens(scenario, one)]
        found = catching_up(scenario, sensors[0]) if sensors else None
        if found is None:
            continue
        work = found.left - sum(_correct(scenario, sensor) + again[sensor.name].work for sensor in sensors)
        if landing is not None:
            work = min(work, landing.again * sum(again[sensor.name].jobs for sensor in sensors))
        if work > 0:
            name = f"catching up for {', '.join(sensor.name for sensor in sensors)}"
            yield Load(name, scenario.cpus - 1, work / float(scenario.speed), gives_way=True)


def _predict(scenario: Scenario) -> float:
    """Work in a step."""
    return _mixed(scenario, "predict")


def _correct(scenario: Scenario, sensor: Sensor) -> float:
    """Work in a step, without what is done again."""
    if is_larsens(scenario, sensor):
        return rate(sensor) * correction(scenario, sensor)
    return rate(sensor) * _mixed(scenario, "correct", sensor)


def _mixed(scenario: Scenario, part: str, of: Sensor | None = None) -> float:
    """The mean cost of a part that runs as "..._accumulate" while a measurement is in flight."""
    name = "" if of is None else f".{of.name}"
    share = _in_flight(scenario, of)
    accumulating = share * mean(scenario, f"{part}_accumulate{name}") if share else 0.0
    return accumulating + (1 - share) * mean(scenario, f"{part}{name}")


def _in_flight(scenario: Scenario, of: Sensor | None) -> float:
    if scenario.late == "recalculate":
        return 0.0
    until_landed = landings(scenario)
    longer = {}
    for sensor in scenario.sensors:
        if sensor.delayed:
            landing = until_landed[sensor.priority]
            if landing is None:
                return 1.0
            longer[sensor.name] = landing.passed
    return in_flight(scenario.sensors, longer, of)
