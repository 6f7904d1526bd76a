"""Reading the user's other periodic tasks from TOML: `[[task]]` in HR periods and cost units, or in Hz, ms and us."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from sched_sim.errors import InputError, option
from sched_sim.files.kinds import refuse_other_kind
from sched_sim.files.toml_numbers import Number, Positive, Whole, number
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.schedule.tasks import Task, wrong_together
from sched_sim.ticks import Number as AnyNumber
from sched_sim.ticks import positive

COST_UNITS: Mapping[str, Fraction] = {"us": Fraction(1, 10**6), "ms": Fraction(1, 1000), "s": Fraction(1)}
"""In seconds."""


class TaskUnits(NamedTuple):
    """What the figures of tasks are turned into.

    hr_hz: HR periods in a second, None if it is not given. unit_s: seconds in a cost unit, None if it is no time.
    unit: of plain costs, one of `COST_UNITS`, where the file says it. no_time: what to do about costs that are times
    where unit_s is None.
    """

    hr_hz: Fraction | None = None
    unit_s: Fraction | None = None
    unit: str | None = None
    no_time: str = "give cost = ... in cost units"


def _offset(value: Any) -> Any:
    try:
        return value if value == "any" else number(value)
    except ValueError:
        raise ValueError('must be a number, or "any"') from None


class TaskEntry(BaseModel):
    """One [[task]]."""

    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    name: str
    period: Positive | None = None
    period_ms: Positive | None = None
    hz: Positive | None = None
    cost: Positive | None = None
    cost_us: Positive | None = None
    cost_ms: Positive | None = None
    cost_s: Positive | None = None
    priority: Whole
    offset: Annotated[Fraction | Literal["any"] | None, BeforeValidator(_offset)] = None
    offset_ms: Number | None = None
    jitter: Number | None = None
    jitter_ms: Number | None = None
    deadline: Positive | None = None
    deadline_ms: Positive | None = None
    preemptive: Annotated[bool, Field(strict=True)] = True
    cpu: Whole = 1

    @model_validator(mode="after")
    def _possible(self) -> Self:
        """Raises ValueError for what is out of range in HR periods, whatever the units are."""
        timed = (self.hz, self.period_ms, self.offset_ms, self.jitter_ms, self.deadline_ms)
        if self.period is None or any(value is not None for value in timed):
            return self
        known = {key: getattr(self, key) for key in ("offset", "jitter", "deadline")}
        known = {key: value for key, value in known.items() if value is not None}
        try:
            Task(self.name, self.period, Fraction(1), self.priority, cpu=self.cpu, **known)
        except InputError as error:
            raise ValueError(str(error).removeprefix(f"task {self.name!r}: ")) from None
        return self

    def task(self, units: TaskUnits) -> Task:
        """Raises InputError that names the task, and what is missing, contradictory or out of range."""
        wrong: list[str] = []

        def steps(key: str) -> Any:
            ms = getattr(self, f"{key}_ms")
            found = {key: getattr(self, key), f"{key}_ms": ms and _in_steps(ms, units)}
            if key == "period":
                found["hz"] = None if self.hz is None else units.hr_hz and units.hr_hz / self.hz
            given = {name: found[name] for name in found if getattr(self, name) is not None}
            if units.hr_hz is None and given.keys() - {key}:
                timed = [self._said(name) for name in given if name != key]
                wrong.append(
                    f"{' and '.join(timed)} {'needs' if len(timed) == 1 else 'need'} {option('hr_hz')}, the HR periods "
                    f"in a second: give it, or {key} = ... in HR periods"
                )
            elif len({*given.values()}) > 1:
                said = " and ".join(map(self._said, given))
                wrong.append(f"{said} do not agree: leave out the one that is wrong")
            return next(iter(given.values()), None)

        figures = {key: steps(key) for key in ("period", "offset", "jitter", "deadline")}
        cost = self._cost(units, wrong)
        if figures["period"] is None and not wrong:
            wrong.append("the period is missing: give hz = ..., period_ms = ..., or period = ... in HR periods")
        if not wrong:
            wrong += self._out_of_range(figures, units)
        if wrong:
            raise InputError(f"task {self.name!r}: {'; '.join(wrong)}")
        known = {key: value for key, value in figures.items() if value is not None}
        return Task(self.name, cost=cost, priority=self.priority, preemptive=self.preemptive, cpu=self.cpu, **known)

    def _out_of_range(self, figures: Mapping[str, Any], units: TaskUnits) -> Iterator[str]:
        """What no task can have, as it is written; figures: the same in HR periods."""
        offset, jitter = figures["offset"], figures["jitter"]
        late = figures["deadline"] is not None
        due = figures["deadline"] if late else figures["period"]
        if offset not in (None, "any") and offset < 0:
            yield f"{self._written('offset', units)} must be 0 or more"
        if due > figures["period"]:
            yield (
                f"{self._written('deadline', units)} must be at most the period, {self._written('period', units)}: a "
                f"job is done before the next one comes"
            )
        elif jitter is not None and not 0 <= jitter < due:
            deadline = "the deadline, " if late else "the deadline, by default the period, "
            yield (
                f"{self._written('jitter', units)} must be 0 or more and less than {deadline}"
                f"{self._written('deadline' if late else 'period', units)}"
            )
        try:
            Task(self.name, Fraction(1), Fraction(1), self.priority, cpu=self.cpu, preemptive=self.preemptive)
        except InputError as error:
            yield str(error).removeprefix(f"task {self.name!r}: ")

    def _written(self, key: str, units: TaskUnits) -> str:
        """A time as the file has it; in ms too, where it has it otherwise and there is a rate."""
        names = [f"{key}_ms", *(["hz"] if key == "period" else []), key]
        name = next(name for name in names if getattr(self, name) is not None)
        value = getattr(self, name)
        if name.endswith("_ms") or units.hr_hz is None:
            return self._said(name)
        ms = 1000 / value if name == "hz" else value * 1000 / units.hr_hz
        return f"{self._said(name)} ({_shown(ms)} ms)"

    def _said(self, key: str) -> str:
        return f"{key} = {_shown(getattr(self, key))}"

    def _cost(self, units: TaskUnits, wrong: list[str]) -> Any:
        given = {key: getattr(self, key) for key in ("cost", *(f"cost_{unit}" for unit in COST_UNITS))}
        given = {key: value for key, value in given.items() if value is not None}
        if len(given) != 1:
            wrong.append(f"give one of cost, cost_us, cost_ms and cost_s, not {' and '.join(given) or 'none'}")
            return None
        ((key, value),) = given.items()
        unit = key.removeprefix("cost").removeprefix("_") or units.unit
        if unit is None and units.unit_s is not None:
            wrong.append(
                f"cost = {_shown(value)} has no unit, and costs are times here: write cost_us, cost_ms or cost_s, "
                f'or unit = "us", "ms" or "s" at the top of the file for all'
            )
        elif unit is not None and units.unit_s is None:
            wrong.append(f"{key} = {_shown(value)} is a time: {units.no_time}")
        if unit is None or units.unit_s is None:
            return value
        return value * COST_UNITS[unit] / units.unit_s


def _in_steps(ms: Fraction, units: TaskUnits) -> Fraction | None:
    return None if units.hr_hz is None else ms * units.hr_hz / 1000


def _shown(value: Any) -> str:
    return value if isinstance(value, str) else f"{float(value):g}"


class _TaskFile(BaseModel):
    model_config = ConfigDict(extra="forbid")
    unit: Literal["us", "ms", "s"] | None = None
    task: Annotated[list[TaskEntry], Field(min_length=1)]


def read_tasks(
    path: str | Path,
    *,
    hr_hz: AnyNumber | None = None,
    unit_s: AnyNumber | None = None,
    cost_unit: str | None = None,
) -> list[Task]:
    """The tasks in `path`, in HR periods and cost units.

    hr_hz: rate of the HR loop, which times in ms and rates in Hz need. unit_s: seconds in a unit of the cost table,
    which costs in us, ms or s need, 1 for the table of a part (`on_part`); None if that is no time. cost_unit: what
    messages call that unit.
    Raises InputError that lists every wrong entry with its value.
    """
    what = f"{option('tasks')} {str(path)!r}"
    document = read_toml(Path(path), what, "give the path of a TOML file with [[task]] entries")
    refuse_other_kind(document, what, "tasks")
    try:
        checked = _TaskFile.model_validate(document)
    except ValidationError as error:
        wrong = problems(error, _TaskFile, document)
        raise InputError(
            f"{what}: {wrong}; each [[task]] has name, period (in HR periods; or period_ms, hz), cost (in the unit of "
            f"the cost table; or cost_us, cost_ms, cost_s), and priority (smaller is more urgent; HR jobs 10, LR jobs "
            f"20)"
        ) from None
    units = TaskUnits(
        None if hr_hz is None else positive(hr_hz, "hr_hz"),
        None if unit_s is None else positive(unit_s, "unit_s"),
        checked.unit,
        _no_time(cost_unit),
    )
    try:
        tasks = tasks_of(checked.task, units)
    except InputError as error:
        raise InputError(f"{what}: {error}") from None
    if together := wrong_together(tasks):
        raise InputError(f"{what}: {'; '.join(together)}")
    return tasks


def _no_time(cost_unit: str | None) -> str:
    """cost_unit: None where it is a Python program that reads the file."""
    if cost_unit is None:
        return (
            f"give {option('unit_s')}, the seconds in a unit of the cost table (1 for one in seconds, as `on_part` "
            f"makes it), or cost = ... in that unit"
        )
    return (
        f"the unit of the cost table, {cost_unit}, is no time: give cost = ... in that unit, or a table in seconds "
        f"({option('processor')}, or {option('costs')} with a measured one)"
    )


def tasks_of(entries: list[TaskEntry], units: TaskUnits) -> list[Task]:
    """Raises InputError that lists all that is wrong."""
    tasks, wrong = [], []
    for entry in entries:
        try:
            tasks.append(entry.task(units))
        except InputError as error:
            wrong.append(str(error))
    if wrong:
        raise InputError("; ".join(_said_once(wrong, f": {units.no_time}")))
    return tasks


def _said_once(messages: list[str], remedy: str) -> list[str]:
    """The same, the remedy only after the last of those that end with it."""
    with_it = [message for message in messages if message.endswith(remedy)]
    return [message.removesuffix(remedy) if message in with_it[:-1] else message for message in messages]
