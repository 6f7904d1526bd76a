"""Reading a scenario from TOML: [predictor], [[sensor]], [[task]] and how they run. Numbers are read as exact
decimals, or as quotients in quotes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from sched_sim.bounds import MOST_STEPS, check_sensors, short
from sched_sim.costs.sample_file import SampledCosts, read_sampled_costs
from sched_sim.costs.table import SECONDS
from sched_sim.errors import InputError, option
from sched_sim.files.toml_numbers import Number, Positive, Whole, above_zero, whole
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.processors.part import seconds_for
from sched_sim.processors.part_file import load_part, shipped_parts
from sched_sim.scenario.fields import ends
from sched_sim.scenario.scenario import Late, Samples, Scenario, Sensor, needed_parts
from sched_sim.schedule.jobs import HR, LR
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.task_file import TaskEntry


def _several(value: Any, what: str, read: Callable[[Any], Any]) -> tuple[Any, ...]:
    """A number, or a list of at least one."""
    if not isinstance(value, list):
        return (read(value),)
    if not value:
        raise ValueError(f"is an empty list: give at least one {what}")
    entries = []
    for number, item in enumerate(value):
        try:
            entries.append(read(item))
        except ValueError as error:
            shown = "" if isinstance(item, dict | list) else f" is {short(item)}"
            raise ValueError(f"entry {number}{shown}: {error}") from None
    return tuple(entries)


def _cost(value: Any) -> tuple[Fraction, ...]:
    if isinstance(value, dict):
        raise ValueError("must be a number, or a list to draw from, such as [0.3, 0.5]")
    return _several(value, "execution time", above_zero)


class _Range(BaseModel):
    model_config = ConfigDict(extra="forbid")
    least: Whole
    most: Whole


def _delays(value: Any) -> Sequence[int]:
    if not isinstance(value, dict):
        return _several(value, "number of steps", whole)
    if lacking := [key for key in _Range.model_fields if key not in value]:
        raise ValueError(f"has no {' and no '.join(lacking)}: give both, as {{ least = 3, most = 5 }}, in whole steps")
    try:
        between = _Range.model_validate(value)
    except ValidationError as error:
        raise ValueError(f"{{ least = ..., most = ... }} in whole steps: {problems(error, _Range)}") from None
    if between.least > between.most:
        raise ValueError(f"least = {between.least} is above most = {between.most}: exchange them")
    return range(between.least, between.most + 1)


def _file(value: Any, what: str) -> str:
    if not isinstance(value, str):
        raise ValueError(f"must be the path of a file, {what}")
    if not value:
        raise ValueError("the name is empty: give the path of a TOML file, or delete the key")
    return value


def _cost_file(value: Any) -> str:
    return _file(value, 'costs = "costs.toml"; what a part costs is `cost` of [predictor] and of each [[sensor]]')


def _processor(value: Any) -> str:
    return _file(value, f"or one of {', '.join(shipped_parts())}")


def _late(value: Any) -> Any:
    if value == "dual-rate":
        ways = " or ".join(repr(way) for way in get_args(Late))
        raise ValueError(
            f"a scenario cannot do that: choose {ways}; for a filter of one sensor there is "
            f"`sched-sim simulate --method dual-rate`"
        )
    return value


_Cost = Annotated[tuple[Fraction, ...], BeforeValidator(_cost)]
_Delays = Annotated[Any, BeforeValidator(_delays)]


def _not_too_many(sensors: Any) -> Any:
    if isinstance(sensors, list):
        check_sensors(sensors)
    return sensors


class _Entry(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)


class _Predictor(_Entry):
    priority: Whole = HR
    cost: _Cost | None = None


class _Sensor(_Entry):
    name: str
    every: Whole
    delay: _Delays = (0,)
    offset: Whole = 0
    dropout: Number = Fraction(0)
    priority: Whole = LR
    land_by: Whole | None = None
    cost: _Cost | None = None

    @model_validator(mode="after")
    def _possible(self) -> Self:
        try:
            self.sensor()
        except InputError as error:
            raise ValueError(str(error).removeprefix(f"sensor {self.name!r}: ")) from None
        return self

    @property
    def first(self) -> str:
        """The earliest step in which one arrives, as the subject of a sentence."""
        least = ends(self.delay)[0]
        if self.offset and least:
            return f"offset {self.offset} and the least delay {least} together are"
        return f"the offset {self.offset} is" if self.offset else f"the least delay {least} is"

    def sensor(self) -> Sensor:
        return Sensor(
            name=self.name,
            every=self.every,
            delays=self.delay,
            land_by=int(ends(self.delay)[1]) + max(self.every, 1) - 1 if self.land_by is None else self.land_by,
            offset=self.offset,
            dropout=float(self.dropout),
            priority=self.priority,
        )


class _ScenarioFile(_Entry):
    name: Annotated[str, Field(min_length=1)]
    steps: Annotated[Whole, Field(ge=1, le=MOST_STEPS)]
    seed: Annotated[Whole, Field(ge=0)] = 0
    late: Annotated[Late, BeforeValidator(_late)] = "recalculate"
    hr_hz: Positive | None = None
    speed: Positive | None = None
    costs: Annotated[str | None, BeforeValidator(_cost_file)] = None
    processor: Annotated[str | None, BeforeValidator(_processor)] = None
    times_slower: Positive | None = None
    context_switch: Annotated[Number, Field(ge=0)] = Fraction(0)
    cpus: Annotated[Literal[1, 2], BeforeValidator(whole)] = 1
    predictor: _Predictor = _Predictor()
    sensor: Annotated[list[_Sensor], Field(min_length=1), BeforeValidator(_not_too_many)]
    task: list[TaskEntry] = []

    @model_validator(mode="after")
    def _together(self) -> Self:
        if wrong := [*self._no_unit(), *self._never_arrive()]:
            raise ValueError("; ".join(wrong))
        return self

    def _no_unit(self) -> Iterator[str]:
        if (self.hr_hz is None) == (self.speed is None):
            problem = "neither is given" if self.speed is None else "both are given"
            yield (
                f"{problem} of hr_hz and speed: give hr_hz (steps per second) where costs are in seconds, else speed "
                f"(cost units per HR period)"
            )
        elif self.processor and self.hr_hz is None:
            yield f"processor {self.processor!r} makes seconds of operations: give hr_hz instead of speed"
        if self.costs is None and (self.processor or self.times_slower):
            key = "processor" if self.processor else "times_slower"
            yield f"{key} has no meaning without a costs file: give costs, or delete it"
        elif self.processor and self.times_slower:
            yield "times_slower is for measured costs, processor for counted ones: give one of them"

    def _never_arrive(self) -> Iterator[str]:
        for sensor in self.sensor:
            if sensor.offset + ends(sensor.delay)[0] >= self.steps:
                yield (
                    f"sensor {sensor.name!r}: {sensor.first} not less than steps = {self.steps}: none arrives; give "
                    f"more steps"
                )


def read_scenario(path: str | Path) -> Scenario:
    """The scenario in `path`; files that it names are looked for in its folder.

    What it says itself of costs is taken as it stands, before what the costs file says, which is made slower by
    `times_slower` or turned into seconds on `processor`.
    Raises InputError that lists every wrong entry of the file with its value.
    """
    what, path = f"{option('scenario')} {str(path)!r}", Path(path)
    document = read_toml(path, what, "give the path of a TOML file with [predictor] and [[sensor]] entries")
    try:
        checked = _ScenarioFile.model_validate(document)
        return _scenario(checked, path.parent)
    except ValidationError as error:
        raise InputError(f"{what}: {problems(error, _ScenarioFile, document)}") from None
    except InputError as error:
        raise InputError(f"{what}: {error}") from None


def _scenario(checked: _ScenarioFile, folder: Path) -> Scenario:
    tasks = [entry.task() for entry in checked.task]
    check_simulation(checked.steps, tasks, f"steps = {checked.steps}")
    stated = {f"correct.{sensor.name}": sensor.cost for sensor in checked.sensor if sensor.cost is not None}
    if checked.predictor.cost is not None:
        stated["predict"] = checked.predictor.cost
    costs: dict[str, Sequence[Fraction]] = {}
    sensors, harness = [sensor.sensor() for sensor in checked.sensor], False
    needed = needed_parts(sensors, checked.late)
    if unused := [part.partition(".")[2] for part in stated if part not in needed]:
        raise InputError(
            f'the cost of sensor {", ".join(unused)} has no meaning with late = "larsen": its late corrections are '
            f"another part, whose costs are under [samples.correct_late] of a costs file; delete the cost, or choose "
            f'late = "recalculate"'
        )
    if checked.costs is not None:
        sampled = read_sampled_costs(folder / checked.costs)
        costs |= _from_file(sampled, checked, folder)
        harness = sampled.harness and not set(needed) <= set(stated)
    costs |= stated
    speed = checked.speed if checked.hr_hz is None else 1 / checked.hr_hz
    assert speed is not None  # see _one_unit
    return Scenario(
        name=checked.name,
        steps=checked.steps,
        speed=speed,
        sensors=sensors,
        costs=costs,
        hr_hz=checked.hr_hz,
        seed=checked.seed,
        late=checked.late,
        priority=checked.predictor.priority,
        tasks=tasks,
        context_switch=checked.context_switch,
        cpus=checked.cpus,
        files=[folder / name for name in (checked.costs, checked.processor) if name is not None],
        harness=harness,
    )


def _from_file(sampled: SampledCosts, checked: _ScenarioFile, folder: Path) -> Samples:
    """Costs in the scenario's unit, on its processor."""
    if checked.processor is not None:
        if not sampled.operations:
            raise InputError(
                f"costs {sampled.shown} has no [operations] to run on processor {checked.processor!r}: count them with "
                f"`sched-sim measure --filter ... --backend counted`, or delete processor"
            )
        shipped = checked.processor in shipped_parts()
        part = load_part(checked.processor if shipped else folder / checked.processor)
        return {
            name: (seconds_for(counts, part, f"[operations] {name} of costs {sampled.shown}"),)
            for name, counts in sampled.operations.items()
        }
    if checked.hr_hz is not None and sampled.unit not in SECONDS:
        raise InputError(
            f"costs {sampled.shown} has the unit {sampled.unit!r}, and hr_hz needs one of time: write unit = with "
            f"{', '.join(SECONDS)} for times, give processor = ... where operations are counted, or speed = ... (cost "
            f"units per HR period) instead of hr_hz"
        )
    slower = (checked.times_slower or Fraction(1)) * (1 if checked.hr_hz is None else SECONDS[sampled.unit])
    return {name: tuple(slower * sample for sample in samples) for name, samples in sampled.samples.items()}
