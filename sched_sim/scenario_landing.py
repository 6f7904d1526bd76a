"""How many steps may pass before preempted corrections of a scenario have landed, and what they do again for it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from math import ceil, gcd
from typing import NamedTuple

from sched_sim.scenario import Scenario, Sensor, needed_parts
from sched_sim.scenario_parts import is_larsens, mean, replays
from sched_sim.tasks import Task

ROUNDING = 1e-9
"""Relative; of sums of means."""
LONGEST = 10_000
"""HR steps; a correction that needs more of them to land counts as one that the next may overtake."""


class Landing(NamedTuple):
    """passed: steps from that of the arrival; again: work that one correction has to do again because of them."""

    passed: int
    again: float


def tasks_ahead(scenario: Scenario, priority: int) -> list[Task]:
    """Those that corrections of this priority wait for."""
    return [task for task in scenario.tasks if task.cpu == scenario.cpus and task.priority <= priority]


def landings(scenario: Scenario) -> dict[int, Landing | None]:
    """Of corrections that are preempted or carried, by priority: the most that can be, with delays and costs that are
    certain; None if one may not have landed when the next arrives."""
    found: dict[int, Landing | None] = {}
    asked = [one for one in scenario.sensors if scenario.preempted(one) or is_larsens(scenario, one)]
    for priority in sorted({sensor.priority for sensor in asked}):
        found[priority] = _landing(scenario, [one for one in scenario.sensors if one.priority == priority], found)
    return found


def _landing(scenario: Scenario, sensors: Sequence[Sensor], before: Mapping[int, Landing | None]) -> Landing | None:
    """All that is more urgent comes when the correction does, and then as often as it can: the critical instant of Liu
    and Layland (1973), Theorem 1. before: of the more urgent."""
    priority, replay = sensors[0].priority, replays(scenario)
    urgent = [sensor for sensor in scenario.sensors if sensor.priority < priority]
    if any(landing is None for landing in before.values()):
        return None
    step = mean(scenario, "predict")
    loop = 0.0 if scenario.cpus == 2 else _longest(scenario, "predict")
    own = {one.name: _longest(scenario, "correct", one.name) for one in sensors}
    first = max(
        replay[one.name].most + sum(own[other.name] for other in sensors if _meet(one, other)) for one in sensors
    )
    most = [(one, replay[one.name].most + _again(before, one)) for one in urgent]
    work = {one.name: _longest(scenario, "correct", one.name) + again for one, again in most}
    tasks = [(float(task.period), float(task.cost)) for task in tasks_ahead(scenario, priority)]
    replayed = [one for one in sensors if not is_larsens(scenario, one)]
    jobs = sum(not one.delayed for one in replayed) + any(one.delayed for one in replayed)
    back = sum(own.values()) if any(one.delayed for one in urgent) else 0.0

    def again(passed: int) -> float:
        """Each step, and each correction that lands meanwhile, with the way back to its own step."""
        landed = sum(_arrivals(one, passed + 1) * (work[one.name] + back) for one in urgent)
        landed += sum(_arrivals(one, passed + 1) * own[one.name] for one in sensors if one not in replayed)
        return passed * step + landed if passed and replayed else 0.0

    def ahead(steps: int) -> float:
        arrive = sum(_arrivals(one, steps) * work[one.name] for one in urgent)
        return steps * loop + arrive + sum(ceil(steps / period) * cost for period, cost in tasks)

    passed, limit = 0, min(_least_apart(sensors), LONGEST)
    while passed < limit:
        needed = first + jobs * again(passed) + ahead(passed + 1)
        steps = ceil(needed / float(scenario.speed) * (1 - ROUNDING))
        if steps <= passed + 1:
            return Landing(passed, again(passed))
        passed = steps - 1
    return None


def _longest(scenario: Scenario, kind: str, of: str = "") -> float:
    """The mean cost of the part, or of the kind of it for Larsen's method, that takes longest."""
    parts = [part.partition(".") for part in needed_parts(scenario.sensors, scenario.late)]
    return max(
        mean(scenario, f"{name}{dot}{sensor}") for name, dot, sensor in parts if name.startswith(kind) and sensor == of
    )


def _again(before: Mapping[int, Landing | None], sensor: Sensor) -> float:
    landing = before.get(sensor.priority)
    return landing.again if landing else 0.0


def _arrivals(sensor: Sensor, steps: int) -> int:
    """At most, in so many steps."""
    return -(-(steps + _jitter(sensor)) // sensor.every)


def _meet(one: Sensor, other: Sensor) -> bool:
    """Whether they may arrive in the same step."""
    return one is other or _apart(one, other) == 0


def _apart(one: Sensor, other: Sensor) -> int:
    """The least number of steps from an arrival of one to one of the other, in whatever order."""
    pattern = gcd(one.every, other.every)
    between = (other.offset + other.least_delay - one.offset - one.least_delay) % pattern
    return max(min(between, pattern - between) - _jitter(one) - _jitter(other), 0)


def _jitter(sensor: Sensor) -> int:
    return sensor.longest_delay - sensor.least_delay


def _least_apart(sensors: Sequence[Sensor]) -> int:
    """The least number of steps, above none, between arrivals."""
    alone = [sensor.every - _jitter(sensor) for sensor in sensors]
    pairs = [_apart(one, other) or gcd(one.every, other.every) for one, other in combinations(sensors, 2)]
    return max(1, min([*alone, *pairs]))
