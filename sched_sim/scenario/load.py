"""What a scenario asks of the processors on average, if each correction lands in the step in which it arrives, and
whether corrections that take longer can catch up."""

from __future__ import annotations

from typing import NamedTuple

from sched_sim.scenario.dual_rate_load import mean_work
from sched_sim.scenario.pattern import going_back, in_flight, numbers_in_flight, share_at_once
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.tasks import Task


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
    """Mean work over time, without context switches and without what corrections do again to catch up."""
    speed = float(scenario.speed)
    tasks = [Load(task.name, task.cpu - 1, _mean_work(task) / speed) for task in scenario.tasks]
    return [*(_of_dual_rate(scenario) if scenario.late == "dual-rate" else _of_filter(scenario)), *tasks]


def _of_dual_rate(scenario: Scenario) -> list[Load]:
    speed, last, work = float(scenario.speed), scenario.cpus - 1, mean_work(scenario)
    mean_loads = [Load("predict", 0, work.predict / speed)]
    for sensor, own in zip(scenario.sensors, work.sensors, strict=True):
        mean_loads.append(Load(f"gain {sensor.name}", last, own.gain / speed))
        mean_loads.append(Load(f"correct {sensor.name}", last, own.correct / speed))
        if own.loss:
            mean_loads.append(Load(f"loss {sensor.name}", last, own.loss / speed))
    return mean_loads


def _of_filter(scenario: Scenario) -> list[Load]:
    speed, last = float(scenario.speed), scenario.cpus - 1
    mean_loads = [Load("predict", 0, _predict(scenario) / speed)]
    for sensor, again in zip(scenario.sensors, _replays(scenario), strict=True):
        mean_loads.append(Load(f"correct {sensor.name}", last, _correct(scenario, sensor) / speed))
        if again:
            mean_loads.append(Load(f"replay for {sensor.name}", last, again / speed, scenario.preempted(sensor)))
    return mean_loads


def demand(scenario: Scenario) -> list[float]:
    """The sum of the `loads` of each processor; more than 1 is more than it can do."""
    shares = [0.0] * scenario.cpus
    for load in loads(scenario):
        shares[load.cpu] += load.share
    return shares


def catching_up(scenario: Scenario) -> dict[str, CatchingUp]:
    """Figures of each sensor whose corrections may have to: something overtakes them, and they are not carried along.

    needed: at the least; of the corrections made in that step, only more urgent ones have been.
    """
    if scenario.late == "dual-rate":
        return {}
    replays = dict(zip(scenario.sensors, _replays(scenario), strict=True))
    predict = _predict(scenario) if scenario.cpus == 1 else 0.0
    figures = {}
    for sensor in scenario.sensors:
        if not scenario.preempted(sensor) or _is_carried(scenario, sensor):
            continue
        urgent = [rival for rival in scenario.sensors if rival.priority < sensor.priority]
        tasks = [task for task in scenario.tasks if task.cpu == scenario.cpus and task.priority <= sensor.priority]
        needed = _mean(scenario, "predict") + sum(_rate(rival) * _correction(scenario, rival) for rival in urgent)
        ahead = (
            predict + sum(_correct(scenario, rival) + replays[rival] for rival in urgent) + sum(map(_mean_work, tasks))
        )
        figures[sensor.name] = CatchingUp(needed, float(scenario.speed) - ahead)
    return figures


def _replays(scenario: Scenario) -> list[float]:
    """Work in a step, of each sensor, that its late corrections do again; those that are carried do nothing again."""
    if scenario.late != "recalculate":
        return [0.0] * len(scenario.sensors)
    corrections = [_correction(scenario, sensor) for sensor in scenario.sensors]
    return going_back(scenario.sensors, _mean(scenario, "predict"), corrections)


def _correct(scenario: Scenario, sensor: Sensor) -> float:
    """Work in a step, without what is done again."""
    if scenario.carries is not None:
        at_once = _share_at_once(sensor)
        return _rate(sensor) * (
            (1 - at_once) * (_mean(scenario, f"{scenario.carries.land}.{sensor.name}") if at_once < 1 else 0.0)
            + at_once * (_with_those_in_flight(scenario, sensor, at_once=True) if at_once else 0.0)
        )
    if _is_carried(scenario, sensor):
        return _rate(sensor) * _correction(scenario, sensor)
    return _rate(sensor) * _mixed(scenario, "correct", sensor)


def _predict(scenario: Scenario) -> float:
    """Work of the predict job, with what it does for measurements in flight."""
    carries = scenario.carries
    if carries is None:
        return _mixed(scenario, "predict")
    work = _mean(scenario, "predict")
    flying = numbers_in_flight(scenario.sensors, predictor=_lands_first_below(scenario))
    for sensor, number in zip(scenario.sensors, flying, strict=True):
        if sensor.delayed:
            late = sensor.dropout + (1 - sensor.dropout) * (1 - _share_at_once(sensor))
            work += number * _mean(scenario, carries.of(sensor.name))
            work += late / sensor.every * _with_those_in_flight(scenario, sensor, at_once=False)
    return float(work)


def _with_those_in_flight(scenario: Scenario, sensor: Sensor, *, at_once: bool) -> float:
    """A correction of the state, or of the covariance alone, and its part with each that is in flight."""
    assert scenario.carries is not None
    first = _lands_first_below(scenario)
    number = sum(numbers_in_flight(scenario.sensors, sensor, at_once=at_once, predictor=first))
    beside = _mean(scenario, f"{scenario.carries.beside}.{sensor.name}")
    return _mean(scenario, f"correct.{sensor.name}") + number * beside


def _lands_first_below(scenario: Scenario) -> int | None:
    """The priority below which corrections land before the predict job of their step begins; None where none do."""
    return scenario.priority if scenario.cpus == 1 else None


def _share_at_once(sensor: Sensor) -> float:
    """Of those that arrive, in their own step."""
    return share_at_once(sensor) if sensor.delayed else 1.0


def _correction(scenario: Scenario, sensor: Sensor) -> float:
    """One, made again."""
    if scenario.carries is not None:
        return _mean(scenario, f"{scenario.carries.land if _is_carried(scenario, sensor) else 'correct'}.{sensor.name}")
    return _mean(scenario, f"{'correct_late' if _is_carried(scenario, sensor) else 'correct'}.{sensor.name}")


def _mixed(scenario: Scenario, part: str, sensor: Sensor | None = None) -> float:
    """The mean cost of a part that runs as "..._accumulate" while a measurement is in flight."""
    name = "" if sensor is None else f".{sensor.name}"
    share = in_flight(scenario.sensors, sensor) if scenario.late == "larsen" else 0.0
    accumulating = share * _mean(scenario, f"{part}_accumulate{name}") if share else 0.0
    return accumulating + (1 - share) * _mean(scenario, f"{part}{name}")


def _is_carried(scenario: Scenario, sensor: Sensor) -> bool:
    """Whether all its measurements are carried to the step in which they land."""
    if scenario.carries is not None:
        return sensor.least_delay > 0
    return scenario.late == "larsen" and sensor.delayed


def _mean(scenario: Scenario, part: str) -> float:
    costs = scenario.costs[part]
    return float(sum(costs)) / len(costs)


def _rate(sensor: Sensor) -> float:
    """Arrivals in a step."""
    return (1 - sensor.dropout) / sensor.every


def _mean_work(task: Task) -> float:
    return float(task.cost / task.period)
