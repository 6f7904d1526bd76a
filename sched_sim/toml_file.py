"""Reading the user's TOML files: numbers as exact decimals, every error on one line."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from sched_sim.errors import InputError
from sched_sim.toml_tables import entries_at, no_such_key, required_keys, table_at

_NUMBER = re.compile(r"[+-]?\d+(\.\d+)?([eE][+-]?\d+)?")


def read_toml(path: Path, what: str, remedy: str) -> dict[str, Any]:
    """The document in `path`. what: how messages name the file; remedy: what to do if there is none.

    Raises InputError if the file is not there, is a folder, cannot be read, or is no TOML.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"), parse_float=Decimal)
    except (FileNotFoundError, NotADirectoryError, IsADirectoryError):
        problem = "is a folder, not a file" if path.is_dir() else "not found"
        raise InputError(f"{what} {problem}: {remedy}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{what} cannot be read: {error}") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{what} is not valid TOML: {error}") from None


def problems(
    error: ValidationError, document: Mapping[str, Any] | None = None, model: type[BaseModel] | None = None
) -> str:
    """Every error of a checked file on one line: where, what was there, what is wrong. With the document, an entry of a
    list is named if it has a name: "sensor 'gps'.every" instead of "sensor.0.every". With the model that it was checked
    by, a key that does not exist is told those that do."""
    lines = []
    for item in error.errors():
        where = _where(item["loc"], document)
        message = _message(item, model)
        given = _given(item)
        lines.append(f"{where}: {message}{given}" if where else message)
    return "; ".join(lines)


def _message(item: ErrorDetails, model: type[BaseModel] | None) -> str:
    path, value = item["loc"], item["input"]
    if item["type"] == "list_type" and isinstance(value, dict):
        return f"this is one table and a list is needed: write [[{path[-1]}]], in two pairs of brackets"
    if item["type"] == "extra_forbidden" and model is not None:
        table = table_at(model, path[:-1])
        if table is not None:
            return no_such_key(str(path[-1]), table)
    if item["type"] == "missing" and model is not None:
        entry = entries_at(model, path)
        if entry is not None:
            return f"there is none: give at least one [[{path[-1]}]], with {' and '.join(required_keys(entry))}"
    return item["msg"].removeprefix("Value error, ")


def _given(item: ErrorDetails) -> str:
    value = item["input"]
    if isinstance(value, dict | list):
        return ""
    if isinstance(value, str) and item["type"] not in ("literal_error", "extra_forbidden") and _NUMBER.fullmatch(value):
        return f' (given: "{value}", which is text: write {value}, without quotes)'
    return f" (given: {value})"


def _where(path: Sequence[int | str], document: Mapping[str, Any] | None) -> str:
    parts: list[str] = []
    at: Any = document
    for part in path:
        if str(part).startswith("function-"):
            continue
        if isinstance(part, int):
            at = at[part] if isinstance(at, list) else None
        else:
            at = at.get(part) if isinstance(at, dict) else None
        if isinstance(part, int) and isinstance(at, dict) and isinstance(at.get("name"), str):
            parts[-1] += f" {at['name']!r}"
        else:
            parts.append(str(part))
    return ".".join(parts)
