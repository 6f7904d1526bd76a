"""What a user asks of a sweep, by flags or in a TOML file, and the sweep that it makes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import Field, fields
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import (
    BaseModel,
    ConfigDict,
    PlainValidator,
    StrictBool,
    ValidationError,
    ValidationInfo,
    create_model,
)
from pydantic import Field as Bounds
from pydantic_core import ErrorDetails

from sched_sim.bounds import MOST_STEPS, short
from sched_sim.costs.methods import METHODS
from sched_sim.costs.table import COUNTED, PAPERS, SECONDS, CostTable, default_methods
from sched_sim.costs.table_file import load_costs, shipped_tables
from sched_sim.design.options import Options, choices
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError, option
from sched_sim.files.toml_problems import problem, problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.processors.part import Part, on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from sched_sim.schedule.engine import Engine
from sched_sim.schedule.task_file import read_tasks
from sched_sim.schedule.tasks import Task
from studies.sweep.axes import numbers, whole_numbers, words
from studies.sweep.grid import Grid
from studies.sweep.run import Sweep

if TYPE_CHECKING:
    from studies.sweep.accuracy import OutputAccuracy

ALL = "all"
"""Instead of values of M or L: every legal one."""


def _called(info: ValidationInfo) -> str:
    """What the message calls the field; that of a file's key stands before the message."""
    return option(str(info.field_name)) if info.context == "given" else "the value"


def _periods(entry: Any, info: ValidationInfo) -> tuple[int, ...]:
    return whole_numbers(entry, _called(info), at_least=1)


def _steps_or_all(entry: Any, info: ValidationInfo) -> tuple[int, ...] | None:
    return None if entry in (ALL, [ALL]) else whole_numbers(entry, _called(info), at_least=0)


def _speeds(entry: Any, info: ValidationInfo) -> tuple[Fraction, ...]:
    return numbers(entry, _called(info))


def _works(entry: Any, info: ValidationInfo) -> tuple[Fraction, ...]:
    return numbers(entry, _called(info), zero=True)


def _listed(entry: Any) -> list[Any]:
    return entry if isinstance(entry, list) else [entry]


def _names_of(what: str) -> PlainValidator:
    def validated(entry: Any, info: ValidationInfo) -> tuple[str, ...]:
        items = [str(item) if isinstance(item, Path) else item for item in _listed(entry)]
        for item in items:
            if isinstance(item, CostTable | Part):
                raise InputError(
                    f"{_called(info)} is a {type(item).__name__}: give its file's path, or the name of a shipped {what}"
                )
        if not items or not all(isinstance(item, str) and item for item in items):
            raise InputError(
                f"{_called(info)} {short(repr(entry))}: give the name of a shipped {what}, or the path of a TOML file"
            )
        return tuple(dict.fromkeys(items))

    return PlainValidator(validated)


def _path(entry: Any, info: ValidationInfo) -> str:
    if not isinstance(entry, str | Path) or not str(entry):
        raise InputError(f"{_called(info)} {short(repr(entry))}: give the path of a TOML file")
    return str(entry)


def _name(entry: Any, info: ValidationInfo) -> str:
    if not isinstance(entry, str) or not entry:
        raise InputError(f"{_called(info)} {short(repr(entry))}: give text")
    return entry


def _one_of(*known: Any) -> PlainValidator:
    def validated(entry: Any, info: ValidationInfo) -> tuple[str, ...]:
        return words(entry, _called(info), [str(word) for word in known])

    return PlainValidator(validated)


class _Settings(BaseModel):
    """The axes of the grid as the user gave them, and what to do at each point; a field that is not set has its
    default."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    N: Annotated[tuple[int, ...], PlainValidator(_periods)] = ()
    M: Annotated[tuple[int, ...] | None, PlainValidator(_steps_or_all)] = None
    L: Annotated[tuple[int, ...] | None, PlainValidator(_steps_or_all)] = None
    speed: Annotated[tuple[Fraction, ...], PlainValidator(_speeds)] = ()
    method: Annotated[tuple[str, ...], _one_of(*METHODS)] = ()
    costs: Annotated[tuple[str, ...], _names_of("cost table")] = ()
    statistic: Statistic = "minimum"
    processor: Annotated[tuple[str, ...], _names_of("processor")] = ()
    hr_hz: Annotated[tuple[Fraction, ...], PlainValidator(_speeds)] = ()
    tasks: Annotated[str | None, PlainValidator(_path)] = None
    model: Annotated[str | None, PlainValidator(_name)] = None
    output: Annotated[str | None, PlainValidator(_name)] = None
    simulate: StrictBool = False
    cycles: Annotated[int, Bounds(strict=True, ge=1, le=MOST_STEPS)] = 3
    engine: Engine = "auto"

    def sweep(self) -> Sweep:
        """Raises InputError without N, for speeds said twice, a file that cannot be read, a cost table that lacks an
        entry, and an empty grid."""
        if not self.N:
            raise InputError(
                f"N is missing: give {option('N')} (such as {option('N')} 10 or {option('N')} 10:100:10), or N = ... "
                f"in the grid file"
            )
        tables = self._tables()
        methods = self.method or default_methods(*tables)
        if not methods:
            has = "; ".join(f"{table.shown} has {', '.join(table.costs)}" for table in tables)
            raise InputError(
                f"{option('costs')}: the cost tables have no method in common ({has}): sweep each by itself"
            )
        grid = Grid(
            N=self.N,
            M=self.M,
            L=self.L,
            speeds=self._paces(tables),
            methods=methods,
            tables=tables,
            options=self._options(),
            statistic=self.statistic,
            tasks=self._tasks(tables),
            accuracy=self._accuracy(),
        )
        return Sweep(grid, self.cycles if self.simulate else None, self.engine)

    def _accuracy(self) -> OutputAccuracy | None:
        if self.model is None and self.output is None:
            return None
        from studies.sweep.accuracy import output_accuracy

        if self.model is not None and self.processor and not self.hr_hz:
            raise InputError(
                f"{option('model')} {self.model} and {option('processor')} {self.processor[0]} without "
                f"{option('hr_hz')}: the rows have the rate that each design may reach, and the accuracy is of one "
                f"rate; give it, such as {option('hr_hz')} 400"
            )
        return output_accuracy(self.model, self.output, self.hr_hz)

    def _tasks(self, tables: Sequence[CostTable]) -> tuple[Task, ...]:
        """In HR periods at the one rate there is, in the unit of the tables."""
        if self.tasks is None:
            return ()
        rate = self.hr_hz[0] if len(self.hr_hz) == 1 else None
        unit = tables[0].unit
        return tuple(read_tasks(Path(self.tasks), hr_hz=rate, unit_s=SECONDS.get(unit), cost_unit=unit))

    def _tables(self) -> tuple[CostTable, ...]:
        """Each of them on each of the processors, if there are any."""
        tables = [load_costs(name) for name in self.costs or (COUNTED if self.processor else PAPERS,)]
        parts = [load_part(name) for name in self.processor]
        return tuple(on_part(*pair) for pair in product(tables, parts)) if parts else tuple(tables)

    def _paces(self, tables: Sequence[CostTable]) -> tuple[Fraction, ...]:
        """Cost units per HR period: those asked for, or the seconds that a period has."""
        if self.speed and self.processor:
            raise InputError(
                f"{option('speed')} and {option('processor')} (speed and processor in a grid file) exclude each other: "
                f"a part's speed follows from {option('hr_hz')}"
            )
        if self.speed and self.hr_hz:
            raise InputError(
                f"{option('speed')} and {option('hr_hz')} (speed and hr_hz in a grid file) exclude each other: both "
                f"say how much is done in an HR period"
            )
        for table in tables:
            if self.hr_hz and table.unit != "second":
                raise InputError(
                    f"{option('hr_hz')} (hr_hz in a grid file) needs costs in seconds, and those of cost table "
                    f'{table.shown} are in {table.unit!r}: write times in seconds, with unit = "second", give '
                    f"{option('processor')} with counted operations, or {option('speed')} instead"
                )
        return tuple(sorted(1 / rate for rate in self.hr_hz)) or self.speed

    def _options(self) -> tuple[Options, ...]:
        axes = (getattr(self, choice.name) for choice in fields(Options))
        return tuple(Options(*combination) for combination in product(*axes))


def _axis(choice: Field[Any]) -> tuple[Any, Any]:
    """What pydantic needs to know of the values of a choice of `Options`."""
    known = choices()[choice.name]
    kind = type(choice.default)
    if not known:
        return Annotated[tuple[Any, ...], PlainValidator(_works)], (choice.default,)

    def validated(entry: Any, info: ValidationInfo) -> tuple[Any, ...]:
        return tuple(map(kind, words(entry, _called(info), list(map(str, known)))))

    return Annotated[tuple[Any, ...], PlainValidator(validated)], (choice.default,)


if TYPE_CHECKING:
    Settings = _Settings
else:
    Settings = create_model(
        "Settings", __base__=_Settings, **{choice.name: _axis(choice) for choice in fields(Options)}
    )


def settings(entries: Mapping[str, Any], file: Path | None = None) -> Settings:
    """Those of a grid file, if there is one, with those given in their place.

    Raises InputError that lists all that is wrong with the one or the other.
    """
    stated = _validated({name: value for name, value in entries.items() if value is not None}, "given", "")
    if file is None:
        return stated
    return _read(file).model_copy(update={name: getattr(stated, name) for name in stated.model_fields_set})


def _read(path: Path) -> Settings:
    """Those of a TOML file: the flags' long names with _ for -; numbers, text such as "10:100:10", or lists of them."""
    document = read_toml(path, f"grid file {str(path)!r}", "give the path of a TOML file")
    grid = _validated(document, "file", f"grid file {str(path)!r}: ")

    def beside(names: Sequence[str], shipped: Sequence[str] = ()) -> tuple[str, ...]:
        return tuple(name if name in shipped else str(path.parent / name) for name in names)

    files = {"costs": beside(grid.costs, shipped_tables()), "processor": beside(grid.processor, shipped_parts())}
    return grid.model_copy(update=files | {"tasks": grid.tasks and str(path.parent / grid.tasks)})


def _validated(entries: Mapping[str, Any], by: Literal["given", "file"], prefix: str) -> Settings:
    try:
        return Settings.model_validate(entries, context=by)
    except ValidationError as error:
        if by == "file":
            raise InputError(prefix + problems(error, Settings)) from None
        raise InputError("; ".join(map(_told, error.errors()))) from None


def _told(item: ErrorDetails) -> str:
    if item["type"] == "value_error":  # of our own validators, which name it
        return item["msg"].removeprefix("Value error, ")
    return f"{option(str(item['loc'][0]))}: {problem(item, item['loc'], Settings)}"
