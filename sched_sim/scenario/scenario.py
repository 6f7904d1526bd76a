"""A scenario: a filter composed of one predictor and several sensors' correctors, on one simulated processor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import ceil
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args

from sched_sim.bounds import MOST_STEPS, check_sensors, short
from sched_sim.errors import InputError
from sched_sim.files.toml_writer import toml_key
from sched_sim.scenario.accuracy_asked import AccuracyAsked
from sched_sim.scenario.draws import fates
from sched_sim.scenario.fields import (
    all_of,
    any_whole,
    at_least,
    cpu_count,
    ends,
    one_of,
    probability,
    rate,
    samples,
    settle,
    steps_at_least,
    steps_drawn,
    text,
    work,
)
from sched_sim.scenario.in_flight import Flight, first_overlap
from sched_sim.scenario.instants import Steps, lag, roundings, taken
from sched_sim.schedule.jobs import HR, LR, step_at
from sched_sim.schedule.tasks import Task, wrong_together
from sched_sim.ticks import exact

Late = Literal["recalculate", "larsen", "carried-gain", "dual-rate"]
"""What a late measurement does: the filter rolls back to it and replays, or its correction is carried forward, by
Larsen's method or as a gain; or every measurement is the low-rate task's, which corrects in a later step."""

Samples = Mapping[str, Sequence[Fraction]]
"""Execution times by part of the filter, as in `sample_file.SampledCosts`."""

HIGH_RATE = ("hr_propagate", "hr_restart", "hr_update", "lr_propagate")
OF_KNOTS = ("gain", "lr_correct", "hr_pass")
AFTER_A_LOSS = ("gain_again", "gain_kept")
"""Parts of the dual-rate filter: there once, and for each sensor, always or where any sensor loses measurements."""


class Carried(NamedTuple):
    """Parts of a filter that carries several: of each in flight, in each step; beside each correction; at the landing.

    each: whether `carry` is another part for each sensor.
    """

    carry: str
    beside: str
    land: str
    each: bool

    def of(self, sensor: str) -> str:
        """What it costs to carry a measurement of the sensor of this name."""
        return f"{self.carry}.{sensor}" if self.each else self.carry


GAINS = Carried("carry", "beside", "land", each=True)
PRODUCTS = Carried("carry_product", "beside_product", "land_product", each=False)


@dataclass(frozen=True)
class Sensor:
    """One sensor; all times in HR steps, whole ones or quotients, such as Fraction(40, 3).

    A measurement is taken at the instants offset, offset + every, ...; k is the step that starts then, or the first
    after it. It never arrives with the probability `dropout`, else in the first step that starts at instant + delay or
    after it, the delay drawn from `delays`, one or several, with equal probability.
    priority: of its corrections; smaller is more urgent. land_by: the correction must finish during step k + land_by,
    or before; its deadline is the end of that step, met exactly if the achieved l is k + land_by or less. Of the
    dual-rate filter, whose corrections land in the step after that in which they finish, it is the start of that step.
    Raises InputError that names the sensor and lists all that is wrong with it.
    """

    name: str
    every: Steps
    delays: Sequence[Steps]
    land_by: int
    offset: Steps = 0
    dropout: float = 0.0
    priority: int = LR

    def __post_init__(self) -> None:
        wrong = settle(self, SENSOR_FIELDS)
        if not {"every", "offset", "delays", "land_by"} & {*wrong} and self.land_by < self.least_delay:
            wrong["land_by"] = (
                f"land_by {self.land_by} must not be less than the least delay {self.least_delay}: the correction "
                f"may land in the step so many after the measurement's, and none lands before its measurement arrives; "
                f"give {self.least_delay} or more"
            )
        if wrong:
            raise InputError(f"sensor {self.name!r}: {'; '.join(wrong.values())}")

    @property
    def delayed(self) -> bool:
        """Whether any of its measurements is late."""
        return self.longest_delay > 0

    @property
    def least_delay(self) -> int:
        """HR steps from the step in which a measurement is taken to that in which it arrives, at the least."""
        return ceil(ends(self.delays)[0] - roundings(self.every, self.offset)[1])

    @property
    def longest_delay(self) -> int:
        """The same at the most."""
        return ceil(ends(self.delays)[1] - roundings(self.every, self.offset)[0])

    @property
    def between_steps(self) -> bool:
        """Whether any of its measurements is taken at an instant at which no step starts."""
        return Fraction(self.every).denominator > 1 or Fraction(self.offset).denominator > 1

    def instant(self, step: int) -> Fraction:
        """When the measurement of this step is taken, in HR steps: then or less than one before."""
        return Fraction(self.offset + (step - self.offset) // self.every * self.every)

    def takes(self, steps: int) -> Sequence[int]:
        """The steps, of so many, in which its measurements are taken."""
        return taken(self.every, self.offset, steps)

    def measurements(self, steps: int, seed: int) -> Iterator[tuple[int, int | None]]:
        """Those of a simulation of so many steps: the step in which each is taken, and how many later it arrives; None:
        it never does."""
        takes = self.takes(steps)
        drawn = fates(self.delays, self.dropout, len(takes), seed, self.name)
        for number, (step, delay) in enumerate(zip(takes, drawn, strict=True)):
            if delay is None or isinstance(delay, int):
                yield step, delay
            else:
                yield step, lag(self.offset + number * self.every, delay)

    def flights(self, steps: int, seed: int) -> list[Flight]:
        """Those of its measurements that arrive in a later step."""
        return [Flight(self.name, step, step + late) for step, late in self.measurements(steps, seed) if late]


SENSOR_FIELDS = {
    "name": text("it is how its costs and results are found"),
    "every": steps_at_least(1, "the number of steps between measurements"),
    "offset": steps_at_least(0, "the step of the first measurement"),
    "dropout": probability,
    "delays": steps_drawn,
    "land_by": any_whole,
    "priority": any_whole,
}


@dataclass(frozen=True)
class Scenario:
    """What is simulated, for so many HR `steps`.

    speed: cost units that the processor does per HR period; hr_hz: the HR rate where the unit is a second, else None.
    costs: by part, one or several execution times, of all `needed_parts`. priority: of the predict jobs.
    cpus: with 2, corrections run on the second. context_switch: in cost units, as in `options.Options`.
    files: those that its own file names, from which costs were read.
    harness: whether any of the costs are samples from which no probability of a miss follows, see `SampledCosts`.
    accuracy: what its file asks to know of it. filter: the function that its file names as its filter.
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
    accuracy: AccuracyAsked | None = None
    filter: str | None = None

    def __post_init__(self) -> None:
        bad = settle(self, SCENARIO_FIELDS)
        wrong = [*bad.values(), *self._at_odds({*bad})]
        if wrong:
            raise InputError(f"scenario {self.name!r}: {'; '.join(wrong)}")

    def _at_odds(self, bad: set[str]) -> Iterator[str]:
        """What to say of fields that cannot be together; bad: those that cannot be by themselves."""
        if "sensors" in bad:
            return
        names = [sensor.name for sensor in self.sensors]
        for name in dict.fromkeys(names):
            if names.count(name) > 1:
                yield f"sensor {name!r} is there {names.count(name)} times: give each its own name"
        if "tasks" not in bad:
            yield from wrong_together(self.tasks)
        if not bad & {"tasks", "cpus"}:
            for task in self.tasks:
                if task.cpu > self.cpus:
                    yield f"task {task.name!r}: cpu {task.cpu} is not there; give cpus = {task.cpu}, or cpu = 1"
        if self.late == "dual-rate":
            yield from _not_low_rate(self.sensors, None if "priority" in bad else self.priority)
        known = {"costs", "late"} if self.late == "recalculate" else {"costs", "late", "steps", "seed"}
        if not bad & known:
            yield from _lacking(self)

    @cached_property
    def carries(self) -> Carried | None:
        """What the filter carries of each measurement in flight, see `carried`."""
        return carried(self.sensors, self.late, self.steps, self.seed)

    def lands(self, finish: int, period: int) -> int:
        """The step in whose state a correction is that finishes then."""
        return step_at(finish, period) + (self.late == "dual-rate")

    def due(self, sensor: Sensor) -> int:
        """At the start of which step, from its own, a correction must have finished."""
        return sensor.land_by + (self.late != "dual-rate")

    def preempted(self, sensor: Sensor) -> bool:
        """Whether predict jobs go on while a correction of `sensor` is under way."""
        return self.cpus == 2 or sensor.priority > self.priority


def _so_many(value: Any, name: str) -> int:
    steps = at_least(1, "how many HR steps are simulated")(value, name)
    if steps > MOST_STEPS:
        raise InputError(f"{name} {short(steps)} is above {MOST_STEPS:,}: simulate fewer HR steps")
    return steps


def _sensors(value: Any, name: str) -> tuple[Sensor, ...]:
    sensors = all_of(Sensor, least=1)(value, name)
    check_sensors(sensors)
    return sensors


def _speed(value: Any, name: str) -> Fraction:
    speed = exact(value, name)
    if speed <= 0:
        raise InputError(f"{name} {float(speed):g} must be greater than 0 cost units per HR period")
    return speed


SCENARIO_FIELDS = {
    "name": text("tables and charts show it"),
    "steps": _so_many,
    "speed": _speed,
    "sensors": _sensors,
    "costs": samples,
    "hr_hz": rate,
    "seed": at_least(0, "a whole number that the draws start from"),
    "late": one_of(*get_args(Late)),
    "priority": any_whole,
    "tasks": all_of(Task),
    "context_switch": work,
    "cpus": cpu_count,
}


def carried(sensors: Sequence[Sensor], late: Late, steps: int, seed: int) -> Carried | None:
    """What a filter carries of each measurement in flight; None if it goes back, or Larsen's method has one at most, or
    its correction waits for a later step."""
    if late in ("recalculate", "dual-rate") or not any(sensor.delayed for sensor in sensors):
        return None
    if late == "carried-gain":
        return GAINS
    return PRODUCTS if _several_in_flight(sensors, steps, seed) else None


def _several_in_flight(sensors: Sequence[Sensor], steps: int, seed: int) -> bool:
    """Whether one that will arrive late is taken before another has."""
    delayed = [sensor for sensor in sensors if sensor.delayed]
    if len(delayed) == 1 and ends(delayed[0].delays)[1] <= delayed[0].every:
        return False
    return first_overlap(flight for sensor in delayed for flight in sensor.flights(steps, seed)) is not None


def needed_parts(sensors: Sequence[Sensor], late: Late, carries: Carried | None) -> list[str]:
    """The parts of the filter that run in such a scenario. carries: see `carried`."""
    if late == "dual-rate":
        kinds = OF_KNOTS + (AFTER_A_LOSS if any(sensor.dropout for sensor in sensors) else ())
        return [*HIGH_RATE, *(f"{kind}.{sensor.name}" for sensor in sensors for kind in kinds)]
    if late == "recalculate" or not any(sensor.delayed for sensor in sensors):
        return ["predict", *(f"correct.{sensor.name}" for sensor in sensors)]
    if carries is not None:
        late_ones = [sensor.name for sensor in sensors if sensor.delayed]
        return [
            "predict",
            *dict.fromkeys(carries.of(name) for name in late_ones),
            *(f"{kind}.{sensor.name}" for sensor in sensors for kind in ("correct", carries.beside)),
            *(f"{carries.land}.{name}" for name in late_ones),
        ]
    one = {True: ("correct_late",), False: ("correct", "correct_accumulate")}
    of_sensors = [f"{kind}.{sensor.name}" for sensor in sensors for kind in one[sensor.delayed]]
    return ["predict", "predict_accumulate", *of_sensors]


def _not_low_rate(sensors: Sequence[Sensor], predictor: int | None) -> Iterator[str]:
    """What to say of sensors that the low-rate task cannot do. predictor: its priority; None if it is wrong."""
    for sensor in sensors:
        if sensor.land_by <= sensor.least_delay:
            yield (
                f"sensor {sensor.name!r}: land_by {sensor.land_by} must be more than the least delay "
                f'{sensor.least_delay}: with late = "dual-rate" a correction lands in a later step than that in which '
                f"its measurement arrives; give {sensor.least_delay + 1} or more"
            )
    first = sensors[0]
    for sensor in sensors[1:]:
        if sensor.priority != first.priority:
            yield (
                f"sensor {sensor.name!r}: priority {sensor.priority}, where {first.name!r} has {first.priority}: with "
                f'late = "dual-rate" one low-rate task does all corrections, first in, first out; give them the same'
            )
    if predictor is not None and first.priority <= predictor:
        yield (
            f"sensor {first.name!r}: priority {first.priority} must be more than {predictor}, that of [predictor]: "
            f'with late = "dual-rate" the low-rate task gives way to the high-rate one; give {predictor + 1} or more'
        )


def _lacking(scenario: Scenario) -> list[str]:
    """What to say of the costs that are not there."""
    needed = needed_parts(scenario.sensors, scenario.late, scenario.carries)
    parts = [part for part in needed if not scenario.costs.get(part)]
    said = []
    if "predict" in parts:
        said.append("no costs of predict: give [predictor] a cost, or the scenario a costs file with it")
    for part in parts:
        kind, _, sensor = part.partition(".")
        if kind == "correct":
            said.append(f"no costs of {part}: give sensor {sensor!r} a cost, or the scenario a costs file with it")
    others = [part for part in parts if part.partition(".")[0] not in ("predict", "correct")]
    if others:
        several = " with several measurements in flight" if scenario.carries == PRODUCTS else ""
        said.append(
            f'no costs of {", ".join(others)}: late = "{scenario.late}"{several} takes them from a costs file, not '
            f'from `cost`: write there {_entries(others)}, beside its name and unit, and costs = "FILE.toml" in the '
            f"scenario; "
            f"`sched-sim measure --filter` writes them for a filter of linear and extended parts, not of unscented "
            f'ones; or choose late = "recalculate"'
        )
    return said


def _entries(parts: Sequence[str]) -> str:
    """How samples of these parts stand in a costs file."""
    tables: dict[str, list[str]] = {}
    for part in parts:
        kind, of_sensor, sensor = part.partition(".")
        table, key = (f"samples.{kind}", toml_key(sensor)) if of_sensor else ("samples", kind)
        tables.setdefault(table, []).append(f"{key} = [...]")
    written = [f"[{table}] {', '.join(entries)}" for table, entries in tables.items()]
    return " and ".join([", ".join(written[:-1]), written[-1]] if written[1:] else written)
