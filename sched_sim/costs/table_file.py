"""Reading and writing the cost table's TOML file. Numbers are read as exact decimals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, ValidationError, model_validator

from sched_sim.bounds import check_kind
from sched_sim.costs.documents import refuse_samples
from sched_sim.costs.methods import KINDS
from sched_sim.costs.operations import ARITHMETIC, OPERATION_KINDS, arithmetic
from sched_sim.costs.table import Cost, CostTable, positive_cost
from sched_sim.errors import InputError, option
from sched_sim.files.kinds import refuse_other_kind
from sched_sim.files.toml_problems import problems
from sched_sim.files.toml_reader import read_toml
from sched_sim.files.toml_writer import toml_number, toml_tables, toml_value
from sched_sim.files.writable import write
from sched_sim.text import did_you_mean

TABLES = Path(__file__).parent / "tables"

Entries = dict[str, Any]
"""One method's entries, by job kind."""


def _known_kinds(section: str) -> Callable[[dict[str, Entries]], dict[str, Entries]]:
    """A check that a section's methods and job kinds exist, and that no method is without any."""

    def check(methods: dict[str, Entries]) -> dict[str, Entries]:
        for method, entries in methods.items():
            if method not in KINDS:
                raise ValueError(f"[{section}.{method}] is no method: choose from {', '.join(KINDS)}")
            known = ", ".join(KINDS[method])
            if not entries:
                raise ValueError(f"[{section}.{method}] has no entry: give some of {known}, or delete it")
            for kind in entries:
                if kind not in KINDS[method]:
                    raise ValueError(f"[{section}.{method}] {kind} is no job kind: choose from {known}")
        return methods

    return check


def _number(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise ValueError("must be a whole number of operations, 0 or more")
    return value


def _counts(counts: dict[str, int]) -> dict[str, int]:
    for kind in counts:
        if kind not in OPERATION_KINDS:
            raise ValueError(f"{kind} is no kind of operation: choose from {', '.join(OPERATION_KINDS)}")
    if not arithmetic(counts):
        raise ValueError(f"a job does at least one of {', '.join(ARITHMETIC)}: give its number, or leave the job out")
    return counts


def _cost(value: Any) -> Any:
    if isinstance(value, dict):
        return value
    number = positive_cost(value, "cost")
    return {"minimum": number, "median": number, "p95": number}


Number = Annotated[Fraction, BeforeValidator(lambda value: positive_cost(value, "cost"))]


class _CostEntry(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
    minimum: Number
    median: Number
    p95: Number

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if not self.minimum <= self.median <= self.p95:
            raise ValueError("minimum, median and p95 must not fall")
        return self


_Cost = Annotated[_CostEntry, BeforeValidator(_cost)]
CountsOfJob = Annotated[dict[str, Annotated[int, BeforeValidator(_number)]], AfterValidator(_counts)]
"""How a job's operations stand in a file."""


class _CostFile(BaseModel):
    model_config = ConfigDict(extra="allow")
    name: str
    unit: str
    costs: Annotated[dict[str, dict[str, _Cost]], AfterValidator(_known_kinds("costs"))] = {}
    operations: Annotated[dict[str, dict[str, CountsOfJob]], AfterValidator(_known_kinds("operations"))] = {}

    @model_validator(mode="after")
    def _something_to_schedule(self) -> Self:
        if not self.costs and not self.operations:
            raise ValueError("no [costs] and no [operations]: give at least one method's entries")
        if not self.costs and self.unit != "operation":
            raise ValueError(
                f'[operations] without [costs] have the unit "operation", this table says {self.unit!r}: '
                f'write unit = "operation", or give the costs too'
            )
        return self

    @model_validator(mode="after")
    def _one_cost_for_each_job(self) -> Self:
        if self.unit in ("operation", "operations") and (problems := list(self._contradictions())):
            raise ValueError("; ".join(problems))
        return self

    def _contradictions(self) -> Iterator[str]:
        """What is said of a job that costs other than the operations that are counted of it."""
        for method, jobs in self.operations.items():
            for kind, counts in jobs.items():
                entry, number = self.costs.get(method, {}).get(kind), arithmetic(counts)
                figures = () if entry is None else (entry.minimum, entry.median, entry.p95)
                if others := [figure for figure in figures if figure != number]:
                    yield (
                        f"[costs.{method}] {kind} is {toml_number(others[0])} operations, and [operations.{method}] "
                        f"{kind} makes {number} without its logic: leave one of them out, or mend it"
                    )


def shipped_tables() -> list[str]:
    """The names of the cost tables that come with the project."""
    return sorted(path.stem for path in TABLES.glob("*.toml"))


def load_costs(name_or_path: str | Path) -> CostTable:
    """A shipped table by its name, or a user's own by its path.

    Raises InputError that names the file, every wrong entry in it, and the remedy.
    """
    check_kind(name_or_path, (str, Path), "name_or_path", "the name of a shipped cost table, or the path of a file")
    name, shipped = str(name_or_path), shipped_tables()
    if name not in shipped:
        remedy = f"{did_you_mean(name, shipped)}give one of {', '.join(shipped)}, or the path of a TOML file"
        return _read(Path(name), name, remedy)
    return replace(read_costs(TABLES / f"{name}.toml", shown=name), found_in=_shipped_with)


def _shipped_with(method: str, kind: str) -> list[str]:
    return [name for name in shipped_tables() if kind in load_costs(name).costs.get(method, {})]


def read_costs(path: str | Path, shown: str = "") -> CostTable:
    """The table in `path`; `shown` is what the user called it.

    Raises InputError that lists every wrong entry of the file with its value.
    """
    remedy = f"give the path of a TOML file; `load_costs` also takes the names {', '.join(shipped_tables())}"
    return _read(Path(path), shown or str(path), remedy)


def _read(path: Path, shown: str, remedy: str) -> CostTable:
    said = f"{option('costs')}: cost table {shown!r}"
    document = read_toml(path, said, remedy)
    refuse_samples(document, said)
    refuse_other_kind(document, said, "costs")
    try:
        checked = _CostFile.model_validate(document)
    except ValidationError as error:
        raise InputError(f"{said}: {problems(error, _CostFile)}") from None
    costs = {
        method: {kind: Cost(entry.minimum, entry.median, entry.p95) for kind, entry in entries.items()}
        for method, entries in checked.costs.items()
    } or {
        method: {kind: Cost.of(Fraction(arithmetic(counts))) for kind, counts in entries.items()}
        for method, entries in checked.operations.items()
    }
    return CostTable(checked.name, checked.unit, costs, dict(checked.model_extra or {}), shown, checked.operations)


def costs_text(table: CostTable) -> str:
    """`table` as the TOML text that `read_costs` reads back; exact where its costs are decimals."""
    lines = [f"name = {toml_value(table.name)}", f"unit = {toml_value(table.unit)}"]
    sections: list[str] = []
    for key, value in table.provenance.items():
        if isinstance(value, Mapping):
            sections += toml_tables(key, value)
        else:
            lines.append(f"{key} = {toml_value(value)}")
    if table.operations:
        sections += toml_tables("operations", table.operations)
    for method, entries in table.costs.items():
        sections += ["", f"[costs.{method}]", *(f"{kind} = {_toml_cost(cost)}" for kind, cost in entries.items())]
    return "\n".join([*lines, *sections]) + "\n"


def write_costs(table: CostTable, path: str | Path) -> None:
    """Write the table to `path`, as `read_costs` reads it. Raises InputError if the path cannot be written."""
    check_kind(table, CostTable, "table", "a cost table, as `load_costs` returns it")
    write(Path(path), costs_text(table).encode(), "cost table")


def _toml_cost(cost: Cost) -> str:
    minimum, median, p95 = (toml_number(value) for value in (cost.minimum, cost.median, cost.p95))
    if minimum == median == p95:
        return minimum
    return f"{{ minimum = {minimum}, median = {median}, p95 = {p95} }}"
