"""Reading and writing the cost table's TOML file. Numbers are read as exact decimals."""

from __future__ import annotations

import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, ValidationError

from sched_sim.costs import KINDS, Cost, CostTable, positive_cost, shipped_names
from sched_sim.errors import InputError


def _known_kinds(costs: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    for method, entries in costs.items():
        if method not in KINDS:
            raise ValueError(f"[costs.{method}] is no method: choose from {', '.join(KINDS)}")
        for kind in entries:
            if kind not in KINDS[method]:
                raise ValueError(f"[costs.{method}] {kind} is no job kind: choose from {', '.join(KINDS[method])}")
    if not costs:
        raise ValueError("[costs] is empty: give at least one method's entries")
    return costs


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
    operations: dict[str, int] = {}


class _CostFile(BaseModel):
    model_config = ConfigDict(extra="allow")
    name: str
    unit: str
    costs: Annotated[dict[str, dict[str, Annotated[_CostEntry, BeforeValidator(_cost)]]], AfterValidator(_known_kinds)]


def read_cost_table(path: Path, shown: str = "") -> CostTable:
    """The table in `path`; `shown` is what the user called it.

    Raises InputError that lists every wrong entry of the file with its value.
    """
    shown = shown or str(path)
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"), parse_float=Decimal)
    except (FileNotFoundError, NotADirectoryError, IsADirectoryError):
        raise InputError(
            f"cost table {shown!r} not found: give one of {', '.join(shipped_names())}, or the path of a TOML file"
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cost table {shown!r} cannot be read: {error}") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"cost table {shown!r} is not valid TOML: {error}") from None
    try:
        checked = _CostFile.model_validate(document)
    except ValidationError as error:
        raise InputError(f"cost table {shown!r}: {problems(error)}") from None
    costs = {
        method: {kind: Cost(entry.minimum, entry.median, entry.p95) for kind, entry in entries.items()}
        for method, entries in checked.costs.items()
    }
    return CostTable(
        name=checked.name, unit=checked.unit, costs=costs, provenance=dict(checked.model_extra or {}), path=shown
    )


def problems(error: ValidationError) -> str:
    """Every error of a checked file on one line: where, what was there, what is wrong."""
    lines = []
    for item in error.errors():
        where = ".".join(str(part) for part in item["loc"] if not str(part).startswith("function-"))
        message = item["msg"].removeprefix("Value error, ")
        value = item["input"]
        given = "" if isinstance(value, dict | list) else f" (given: {value})"
        lines.append(f"{where}: {message}{given}" if where else message)
    return "; ".join(lines)
