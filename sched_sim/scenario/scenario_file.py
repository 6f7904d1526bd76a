"""Reading a scenario from TOML: [predictor], [[sensor]], [[task]] and how they run. Numbers are read as exact
decimals, or as quotients in quotes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import ceil, isclose
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, ValidationError, ValidationInfo, model_validator

from sched_sim.bounds import MOST_STEPS, check_sensors, short
from sched_sim.costs.sample_file import SampledCosts, read_sampled_costs
from sched_sim.costs.sample_text import of_each
from sched_sim.costs.table import SECONDS
from sched_sim.errors import InputError, option
from sched_sim.files.kinds import refuse_other_kind
from sched_sim.files.toml_numbers import Positive, Whole, above_zero, whole
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.processors.part import NoTimeError, seconds_for
from sched_sim.processors.part_file import load_part, read_part, shipped_parts
from sched_sim.scenario.composition import Composition, Describe, with_its_sensors
from sched_sim.scenario.fields import ends
from sched_sim.scenario.file_accuracy import AccuracyEntry
from sched_sim.scenario.file_entries import Entry, PredictorEntry, SensorEntry, not_negative
from sched_sim.scenario.file_units import Said, Units, agreed, costs_said, plain_cost, shown, time, timed_cost, units_of
from sched_sim.scenario.scenario import Late, Samples, Scenario, carried, needed_parts
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.task_file import TaskEntry, TaskUnits, tasks_of
from sched_sim.schedule.tasks import Task

NO_TIME = "without hr_hz no period has one: give hr_hz (steps per second) instead of speed, or cost = ... in cost units"


def _file(value: Any, what: str) -> str:
    if not isinstance(value, str):
        raise ValueError(f"must be the path of a file, {what}")
    if not value:
        raise ValueError("the name is empty: give the path of a TOML file, or delete the key")
    return value


def _filter(value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise ValueError('must name a function that returns a filter: write filter = "module:function"')
    return value


def _cost_file(value: Any) -> str:
    return _file(value, 'costs = "costs.toml"; what a part costs is `cost` of [predictor] and of each [[sensor]]')


def _processor(value: Any) -> str:
    return _file(value, f"or one of {', '.join(shipped_parts())}")


def _not_too_many(sensors: Any) -> Any:
    if isinstance(sensors, list):
        check_sensors(sensors)
    return sensors


def _steps(value: Any, info: ValidationInfo) -> int | None:
    """It may be left out where `duration_s` says it."""
    if value is not None:
        return whole(value)
    if "duration_s" in info.data and info.data["duration_s"] is None:
        raise ValueError("is missing: write `steps = ...`, or `duration_s = ...` beside hr_hz")
    return None


_Steps = Annotated[Annotated[int, Field(ge=1, le=MOST_STEPS)] | None, BeforeValidator(_steps)]
_Switch = Annotated[Fraction | None, BeforeValidator(plain_cost(not_negative))]
_TimedSwitch = Annotated[Fraction | None, BeforeValidator(timed_cost(not_negative))]


class _ScenarioFile(Entry):
    name: Annotated[str, Field(min_length=1)]
    hr_hz: Positive | None = None
    speed: Positive | None = None
    unit: Literal["us", "ms", "s"] | None = None
    duration_s: Annotated[Fraction | None, BeforeValidator(time(above_zero))] = None
    steps: Annotated[_Steps, Field(validate_default=True)] = None
    seed: Annotated[Whole, Field(ge=0)] = 0
    late: Late = "recalculate"
    filter: Annotated[str | None, BeforeValidator(_filter)] = None
    costs: Annotated[str | None, BeforeValidator(_cost_file)] = None
    processor: Annotated[str | None, BeforeValidator(_processor)] = None
    times_slower: Positive | None = None
    context_switch: _Switch = None
    context_switch_us: _TimedSwitch = None
    context_switch_ms: _TimedSwitch = None
    context_switch_s: _TimedSwitch = None
    cpus: Annotated[Literal[1, 2], BeforeValidator(whole)] = 1
    predictor: PredictorEntry = PredictorEntry()
    sensor: Annotated[list[SensorEntry], Field(min_length=1), BeforeValidator(_not_too_many)]
    task: list[TaskEntry] = Field(default_factory=list)
    accuracy: AccuracyEntry | None = None

    @model_validator(mode="after")
    def _together(self, info: ValidationInfo) -> Self:
        units = units_of(info)
        wrong = [*self._no_unit(), *self._other_rate(units)]
        for check in (self._never_arrive, self.tasks) if units.sure else ():
            try:
                check(units)
            except InputError as error:
                wrong.append(str(error))
        if wrong:
            raise ValueError("; ".join(wrong))
        return self

    def so_many(self, units: Units) -> int:
        """HR steps; those that start within `duration_s`."""
        within = None if self.duration_s is None else ceil(units.steps(1000 * self.duration_s))
        steps: int = agreed(
            [
                None if self.steps is None else Said(f"steps = {self.steps}", self.steps),
                None if within is None else Said(f"duration_s = {shown(self.duration_s)} ({within} steps)", within),
            ]
        )
        if steps > MOST_STEPS:
            raise InputError(f"duration_s = {shown(self.duration_s)} is {steps:,} steps: give at most {MOST_STEPS:,}")
        return steps

    def _no_unit(self) -> Iterator[str]:
        if (self.hr_hz is None) == (self.speed is None):
            problem = "neither is given" if self.speed is None else "both are given"
            yield (
                f"{problem} of hr_hz and speed: give hr_hz (steps per second) where costs are times, else speed "
                f"(cost units per HR period)"
            )
        elif self.unit and self.hr_hz is None:
            yield f"unit = {self.unit!r} makes times of costs: give hr_hz instead of speed, or delete it"
        elif self.processor and self.hr_hz is None:
            yield f"processor {self.processor!r} makes seconds of operations: give hr_hz instead of speed"
        if self.costs is None and (self.processor or self.times_slower):
            key = "processor" if self.processor else "times_slower"
            yield (
                f"{key} is for what a costs file says, and there is none: give costs = ..., or delete {key}: stated "
                f"costs are taken as they are"
            )
        elif self.processor and self.times_slower:
            yield "times_slower is for measured costs, processor for counted ones: give one of them"

    def _other_rate(self, units: Units) -> Iterator[str]:
        dt = None if units.composition is None else units.composition.dt
        if dt is not None and units.hr_hz is not None and not isclose(dt * float(units.hr_hz), 1, rel_tol=1e-9):
            yield (
                f"hr_hz = {shown(units.hr_hz)} and the filter's dt = {dt:g} ({1 / dt:g} Hz) do not agree: mend the one "
                f"that is wrong"
            )

    def _never_arrive(self, units: Units) -> None:
        """Raises InputError for sensors of which no measurement arrives."""
        steps, never = self.so_many(units), []
        for entry in self.sensor:
            sensor = entry.sensor(units)
            if ceil(sensor.offset + ends(sensor.delays)[0]) >= steps:
                never.append(
                    f"sensor {entry.name!r}: {entry.first(sensor)} not less than steps = {steps}: none arrives"
                )
        if never:
            raise InputError(f"{'; '.join(never)}; give more steps")

    def tasks(self, units: Units) -> list[Task]:
        """The [[task]] entries, their costs as all others; raises InputError for one whose unit is not said."""
        second = None if units.hr_hz is None else Fraction(1)
        return tasks_of(self.task, TaskUnits(units.hr_hz, second, units.unit, NO_TIME))


def read_scenario(path: str | Path, describe: Describe | None = None, *, processor: str | None = None) -> Scenario:
    """The scenario in `path`; files that it names are looked for in its folder.

    processor: a shipped one by name, or the path of a file, in place of the one that the file names.
    describe: what runs the function that its `filter` names; `studies.describe_filter`.

    What it says itself of costs is taken as it stands, before what the costs file says, which is made slower by
    `times_slower` or turned into seconds on `processor`.
    Raises InputError that lists every wrong entry of the file with its value, and for a processor where no cost is one
    of counted operations.
    """
    what, path = f"{option('scenario')} {str(path)!r}", Path(path)
    document = read_toml(path, what, "give the path of a TOML file with [predictor] and [[sensor]] entries")
    refuse_other_kind(document, what, "scenario")
    try:
        composition = _composition(document.get("filter"), describe, path.parent)
        if processor is not None:
            shipped = processor in shipped_parts()
            document = {**document, "processor": processor if shipped else str(Path(processor).resolve())}
        if composition is not None:
            document = with_its_sensors(document, composition)
        if processor is not None and "sensor" in document:  # else that is what is missing
            _check_it_depends_on_one(document)
        units = Units.of(document, composition)
        return _scenario(_ScenarioFile.model_validate(document, context=units), units, path.parent)
    except ValidationError as error:
        raise InputError(f"{what}: {problems(error, _ScenarioFile, document)}") from None
    except NoTimeError as error:
        raise NoTimeError(f"{what}: {error}", error.operations) from None
    except InputError as error:
        raise InputError(f"{what}: {error}") from None


def _check_it_depends_on_one(document: Mapping[str, Any]) -> None:
    """Raises InputError for a scenario of which all processors would make the same, or none anything."""
    sensors = document.get("sensor")
    entries = [document.get("predictor", {}), *(sensors if isinstance(sensors, list) else [])]
    tables = [entry for entry in entries if isinstance(entry, Mapping)]
    stated = all(any(str(key).startswith("cost") for key in entry) for entry in tables)
    if "costs" in document and not stated:
        return
    if not stated:
        why = "a processor needs counted operations, and there are none"
    elif "hr_hz" in document:
        why = (
            "all costs are stated, as times, and what comes out is the same on every processor: "
            "`sched-sim simulate --scenario FILE` says it"
        )
    else:
        why = (
            "all costs are stated, in units of which `speed` says how fast they are done, and no processor's file says "
            "that: `sched-sim simulate --scenario FILE` runs it as it is"
        )
    raise InputError(
        f"{why}; to compare processors {'' if 'hr_hz' in document else 'give hr_hz, not speed, '}"
        f"{'leave out these costs and ' if stated else ''}name a file of counts: costs = ..., from `sched-sim measure "
        f"--filter ... --backend counted -o FILE`"
    )


def _composition(name: Any, describe: Describe | None, folder: Path) -> Composition | None:
    """Of the filter that the file names, if it names one."""
    if not isinstance(name, str) or not name:
        return None
    if describe is None:
        raise InputError(
            f"filter = {short(repr(name))} names a function, which read_scenario runs only if it is told to: give "
            f"describe=studies.describe_filter"
        )
    return describe(name, folder)


def _scenario(checked: _ScenarioFile, units: Units, folder: Path) -> Scenario:
    steps, tasks = checked.so_many(units), checked.tasks(units)
    check_simulation(steps, tasks, f"steps = {steps}")
    parts = {"predict": checked.predictor} | {f"correct.{sensor.name}": sensor for sensor in checked.sensor}
    found = {part: costs_said(entry, "cost", units) for part, entry in parts.items()}
    stated = {part: cost for part, cost in found.items() if cost is not None}
    costs: dict[str, Sequence[Fraction]] = {}
    sensors, harness = [sensor.sensor(units) for sensor in checked.sensor], False
    needed = needed_parts(sensors, checked.late, carried(sensors, checked.late, steps, checked.seed))
    if unused := [part for part in stated if part not in needed]:
        raise InputError(_of_no_use(unused, checked.late))
    if checked.costs is not None:
        sampled = read_sampled_costs(folder / checked.costs)
        costs |= _from_file(sampled, checked, folder)
        harness = sampled.harness and not set(needed) <= set(stated)
    costs |= stated
    speed = checked.speed if checked.hr_hz is None else 1 / checked.hr_hz
    assert speed is not None  # see _one_unit
    return Scenario(
        name=checked.name,
        steps=steps,
        speed=speed,
        sensors=sensors,
        costs=costs,
        hr_hz=checked.hr_hz,
        seed=checked.seed,
        late=checked.late,
        priority=checked.predictor.priority,
        tasks=tasks,
        context_switch=costs_said(checked, "context_switch", units) or Fraction(0),
        cpus=checked.cpus,
        files=[folder / name for name in (checked.costs, checked.processor) if name is not None],
        harness=harness,
        accuracy=None if checked.accuracy is None else checked.accuracy.asked(),
        filter=checked.filter,
    )


def _of_no_use(parts: Sequence[str], late: Late) -> str:
    """What to say of the costs of these parts, which are stated and do not run."""
    sensors = [part.partition(".")[2] for part in parts if part != "predict"]
    named = ["[predictor]"] * ("predict" in parts) + [f"sensor {', '.join(sensors)}"] * bool(sensors)
    said, choose = f'the cost of {" and ".join(named)} has no meaning with late = "{late}"', 'late = "recalculate"'
    if late == "dual-rate":
        return (
            f"{said}: its tasks have other parts, whose costs are under [samples] of a costs file; delete the cost, or "
            f"choose {choose}"
        )
    return (
        f"{said}: its late corrections are another part, whose costs are under [samples.correct_late] of a costs file; "
        f"delete the cost, or choose {choose}"
    )


def _from_file(sampled: SampledCosts, checked: _ScenarioFile, folder: Path) -> Samples:
    """Costs in the scenario's unit, on its processor."""
    if checked.processor is not None:
        if not sampled.operations:
            raise InputError(
                f"costs {sampled.shown} has no [operations], which a processor's file turns into time: count them with "
                f"`sched-sim measure --filter ... --backend counted`, or leave the processor out"
            )
        shipped = checked.processor in shipped_parts()
        part = load_part(checked.processor) if shipped else read_part(folder / checked.processor, argument="processor")
        return {
            name: (seconds_for(counts, part, f"[operations] {name} of costs {sampled.shown}"),)
            for name, counts in sampled.operations.items()
        }
    if checked.hr_hz is not None and sampled.unit not in SECONDS:
        raise InputError(
            f"costs {sampled.shown} has the unit {sampled.unit!r}, and hr_hz needs one of time: give processor = ... "
            f"where operations are counted, or speed = ... (cost units per HR period) instead of hr_hz; in a file of "
            f"times write one of these units: {', '.join(SECONDS)}"
        )
    slower = (checked.times_slower or Fraction(1)) * (1 if checked.hr_hz is None else SECONDS[sampled.unit])
    return {name: of_each(slower.__mul__, samples) for name, samples in sampled.samples.items()}
