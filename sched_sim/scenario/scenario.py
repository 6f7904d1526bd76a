"""A scenario: a filter composed of one predictor and several sensors' correctors, on one simulated processor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Literal

from sched_sim.bounds import MOST_STEPS, short
from sched_sim.errors import InputError
from sched_sim.files.toml_writer import toml_key
from sched_sim.scenario.draws import fates
from sched_sim.scenario.in_flight import Flight, first_overlap
from sched_sim.schedule.jobs import HR, LR
from sched_sim.schedule.tasks import Task

Late = Literal["recalculate", "larsen"]
"""What a late measurement does: the filter rolls back to it and replays, or Larsen's method carries it forward."""

Samples = Mapping[str, Sequence[Fraction]]
"""Execution times by part of the filter, as in `sample_file.SampledCosts`."""

LARSENS = ("predict_accumulate", "correct_accumulate", "correct_late")
"""Parts of a filter that run for Larsen's method only."""


@dataclass(frozen=True)
class Sensor:
    """One sensor; all times in HR steps.

    A measurement is taken in steps offset, offset + every, ...; it never arrives with the probability `dropout`, else
    at the start of the step k + delay, the delay drawn from `delays` with equal probability.
    priority: of its corrections; smaller is more urgent. land_by: the correction must finish during step k + land_by,
    or before; its deadline is the end of that step, met exactly if the achieved l is k + land_by or less.
    Raises InputError that names the sensor and lists all that is wrong with it.
    """

    name: str
    every: int
    delays: Sequence[int]
    land_by: int
    offset: int = 0
    dropout: float = 0.0
    priority: int = LR

    def __post_init__(self) -> None:
        wrong = []
        if not self.name.strip():
            wrong.append("the name is empty: give one, it is how its costs and results are found")
        if self.every < 1:
            wrong.append(f"every {self.every} must be at least 1: it is the number of steps between measurements")
        if self.offset < 0:
            wrong.append(f"offset {self.offset} must be 0 or more: it is the step of the first measurement")
        if not 0 <= self.dropout <= 1:
            wrong.append(f"dropout {self.dropout:g} must be from 0 to 1: it is a probability, 10 % is 0.1")
        if not self.delays:
            wrong.append(
                "delay has nothing to draw from: give a number of steps, a list, or { least = ..., most = ... }"
            )
        elif self.least_delay < 0:
            wrong.append(f"delay {self.least_delay} must be 0 or more: no measurement arrives before it is taken")
        elif self.longest_delay > MOST_STEPS:
            wrong.append(f"delay {short(self.longest_delay)} is above {MOST_STEPS:,} HR steps: give fewer")
        elif self.land_by < self.least_delay:
            wrong.append(
                f"land_by {self.land_by} must not be less than the least delay {self.least_delay}: the correction "
                f"may land in the step so many after the measurement's, and none lands before its measurement arrives; "
                f"give {self.least_delay} or more"
            )
        if wrong:
            raise InputError(f"sensor {self.name!r}: {'; '.join(wrong)}")

    @property
    def delayed(self) -> bool:
        """Whether any of its measurements is late."""
        return self.longest_delay > 0

    @property
    def least_delay(self) -> int:
        return ends(self.delays)[0]

    @property
    def longest_delay(self) -> int:
        return ends(self.delays)[1]

    def fates(self, steps: int, seed: int) -> list[int | None]:
        """The drawn delay of each measurement of a simulation of so many steps; None: it never arrives."""
        return fates(self.delays, self.dropout, len(self._takes(steps)), seed, self.name)

    def flights(self, steps: int, seed: int) -> list[Flight]:
        """Those of its measurements that arrive in a later step."""
        drawn = zip(self._takes(steps), self.fates(steps, seed), strict=True)
        return [Flight(self.name, step, step + delay) for step, delay in drawn if delay]

    def _takes(self, steps: int) -> range:
        return range(self.offset, steps, self.every)


def ends(delays: Sequence[int]) -> tuple[int, int]:
    """The least and the greatest, at once of a long range too."""
    candidates = (delays[0], delays[-1]) if isinstance(delays, range) else delays
    return min(candidates), max(candidates)


@dataclass(frozen=True)
class Scenario:
    """What is simulated, for so many HR `steps`.

    speed: cost units that the processor does per HR period; hr_hz: the HR rate where the unit is a second, else None.
    costs: from `sample_file`, all parts that `needed_parts` names. priority: of the predict jobs.
    cpus: with 2, corrections run on the second. context_switch: in cost units, as in `options.Options`.
    files: those that its own file names, from which costs were read.
    harness: whether any of the costs are samples of `measure --filter`, from which no probability of a miss follows.
    Raises InputError that lists all that is wrong.
    """

    name: str
    steps: int
    speed: Fraction
    sensors: Sequence[Sensor]
    costs: Samples
    hr_hz: Fraction | None = None
    seed: int = 0
    late: Late = "recalculate"
    priority: int = HR
    tasks: Sequence[Task] = ()
    context_switch: Fraction = Fraction(0)
    cpus: Literal[1, 2] = 1
    files: Sequence[Path] = ()
    harness: bool = False

    def __post_init__(self) -> None:
        wrong = []
        if not self.name.strip():
            wrong.append("the name is empty: give one, tables and charts show it")
        if self.steps < 1:
            wrong.append(f"steps {self.steps} must be at least 1: it is how many HR steps are simulated")
        if self.steps > MOST_STEPS:
            wrong.append(f"steps {short(self.steps)} is above {MOST_STEPS:,}: simulate fewer HR steps")
        if self.speed <= 0:
            wrong.append(f"speed {float(self.speed):g} must be greater than 0 cost units per HR period")
        if self.seed < 0:
            wrong.append(f"seed {self.seed} must be a whole number, 0 or more")
        if self.context_switch < 0:
            wrong.append(f"context_switch {float(self.context_switch):g} must be 0 or more cost units")
        names = [sensor.name for sensor in self.sensors]
        wrong += [
            f"sensor {name!r} is there {names.count(name)} times: give each its own name"
            for name in dict.fromkeys(names)
            if names.count(name) > 1
        ]
        wrong += [
            f"task {task.name!r}: cpu {task.cpu} is not there; give cpus = {task.cpu}, or cpu = 1"
            for task in self.tasks
            if task.cpu > self.cpus
        ]
        wrong += _lacking(self)
        if not wrong and self.late == "larsen":
            wrong = self._in_flight_at_once()
        if wrong:
            raise InputError(f"scenario {self.name!r}: {'; '.join(wrong)}")

    def _in_flight_at_once(self) -> list[str]:
        """What to say of late measurements that Larsen's method cannot wait for."""
        delayed = [sensor for sensor in self.sensors if sensor.delayed]
        if len(delayed) == 1 and delayed[0].longest_delay <= delayed[0].every:
            return []
        overlap = first_overlap(flight for sensor in delayed for flight in sensor.flights(self.steps, self.seed))
        if overlap is None:
            return []
        first, second = overlap
        offsets = (
            ""
            if first.sensor == second.sensor
            else "; or give offsets with which the second is taken when the first has arrived"
        )
        return [
            f'{first} and {second}: late = "larsen" can wait for one measurement at a time; choose late = '
            f'"recalculate", which takes any number{offsets}'
        ]

    def preempted(self, sensor: Sensor) -> bool:
        """Whether predict jobs go on while a correction of `sensor` is under way."""
        return self.cpus == 2 or sensor.priority > self.priority


def needed_parts(sensors: Sequence[Sensor], late: Late) -> list[str]:
    """The parts of the filter that run in such a scenario."""
    if late == "recalculate" or not any(sensor.delayed for sensor in sensors):
        return ["predict", *(f"correct.{sensor.name}" for sensor in sensors)]
    kinds = {True: ("correct_late",), False: ("correct", "correct_accumulate")}
    of_sensors = [f"{kind}.{sensor.name}" for sensor in sensors for kind in kinds[sensor.delayed]]
    return ["predict", "predict_accumulate", *of_sensors]


def _lacking(scenario: Scenario) -> list[str]:
    """What to say of the costs that are not there."""
    parts = [part for part in needed_parts(scenario.sensors, scenario.late) if not scenario.costs.get(part)]
    said = []
    if "predict" in parts:
        said.append("no costs of predict: give [predictor] a cost, or the scenario a costs file with it")
    for part in parts:
        kind, _, sensor = part.partition(".")
        if kind == "correct":
            said.append(f"no costs of {part}: give sensor {sensor!r} a cost, or the scenario a costs file with it")
    larsens = [part for part in parts if part.startswith(LARSENS)]
    if larsens:
        said.append(
            f'no costs of {", ".join(larsens)}: late = "larsen" takes them from a costs file, not from `cost`: write '
            f'there {_entries(larsens)}, beside its name and unit, and costs = "FILE.toml" in the scenario; '
            f"`sched-sim measure --filter` writes them for a filter of linear and extended parts, not of unscented "
            f'ones; or choose late = "recalculate"'
        )
    return said


def _entries(parts: Sequence[str]) -> str:
    """How samples of these parts stand in a costs file."""
    written = []
    for part in parts:
        kind, of_sensor, sensor = part.partition(".")
        table, key = (f"samples.{kind}", toml_key(sensor)) if of_sensor else ("samples", kind)
        written.append(f"[{table}] {key} = [...]")
    return " and ".join([", ".join(written[:-1]), written[-1]] if written[1:] else written)
