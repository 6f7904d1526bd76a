"""Random scenarios of all that there is: any way of late measurements, sensors, priorities, processors and tasks; most
of them short, half of them too slow for their processor."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import get_args

from sched_sim.scenario.instants import Steps
from sched_sim.scenario.scenario import Late, Scenario, Sensor, carried, needed_parts
from sched_sim.schedule.tasks import Task

EVERY: list[Steps] = [1, 2, 3, 5, 8, Fraction(40, 3), Fraction(5, 2), Fraction(7, 3)]
DELAYS: list[list[Steps] | range] = [
    [0],
    [1],
    [2],
    [3],
    [4],
    [0, 1],
    [0, 2, 5],
    range(6),
    range(2, 9),
    [Fraction(1, 2), Fraction(7, 3)],
    [7, 9],
]
HR = 10
OF_TASKS = [5, 9, HR, 15, 20, 25]
OF_SENSORS = [9, HR, HR, 11, 20, 20, 20, 30]
LOW_RATE = [11, 20]


def random_scenario(seed: int, lengths: Sequence[int] = (1, 2, 3, 20, 60)) -> Scenario:
    random = Random(seed)
    late: Late = random.choice(get_args(Late))
    steps, cpus = random.choice(lengths), random.choice([1, 1, 2])
    low_rate = [random.choice(LOW_RATE)] if late == "dual-rate" else OF_SENSORS
    sensors = [_sensor(random, f"s{number}", late, low_rate) for number in range(random.choice([1, 1, 2, 2, 3, 4]))]
    parts = needed_parts(sensors, late, carried(sensors, late, steps, seed))
    lighter = random.choice([1, 1, 2, 4])
    return Scenario(
        "random",
        steps,
        Fraction(random.choice([5, 10, 20, 40, 100])),
        sensors,
        {part: [Fraction(random.randint(1, 11), 2 * lighter) for _ in range(random.choice([1, 1, 2, 3, 5]))]
         for part in parts},
        seed=seed,
        late=late,
        priority=HR,
        tasks=[_task(random, f"t{number}", cpus) for number in range(random.choice([0, 0, 1, 2]))],
        context_switch=Fraction(random.choice([0, 0, 0, 1, 2]), 4),
        cpus=cpus,
    )  # fmt: skip


def _sensor(random: Random, name: str, late: Late, priorities: list[int]) -> Sensor:
    every, delays = random.choice(EVERY), random.choice(DELAYS)
    offset, dropout = random.choice([0, 0, 1, Fraction(1, 3)]), random.choice([0, 0, 0.2, 0.6])
    least = Sensor(name, every, delays, land_by=100, offset=offset).least_delay + (late == "dual-rate")
    land_by = least + random.choice([0, 0, 1, 2, 6])
    return Sensor(name, every, delays, land_by, offset, dropout, random.choice(priorities))


def _task(random: Random, name: str, cpus: int) -> Task:
    period = Fraction(random.choice([1, 2, 3, 7]), random.choice([1, 2, 3]))
    return Task(
        name,
        period,
        Fraction(random.randint(1, 8), 2),
        random.choice(OF_TASKS),
        offset=random.choice([Fraction(0), Fraction(1, 3), Fraction(2), "any"]),
        cpu=random.randint(1, cpus),
        jitter=random.choice([Fraction(0), period / 5]),
        deadline=random.choice([None, period / 2]),
        preemptive=random.random() < 0.7,
    )
