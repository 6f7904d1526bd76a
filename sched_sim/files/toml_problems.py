"""What is wrong with a checked TOML file, in words of the file: tables, keys, lists."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from sched_sim.bounds import short
from sched_sim.files.toml_keys import entries_at, is_text_at, keys_of, no_such_key, required_keys, table_at
from sched_sim.files.toml_writer import toml_key

MOST_PROBLEMS = 20
"""A file's, in one message."""
_NUMBER = re.compile(r"[+-]?\d+(\.\d+)?([eE][+-]?\d+)?")

At = Sequence[int | str]
"""A place in a document: keys, and numbers of list entries."""


def problems(error: ValidationError, model: type[BaseModel], document: Mapping[str, Any] | None = None) -> str:
    """Every error of a file checked by `model` on one line: where, what was there, what is wrong. With the document, an
    entry of a list is named if it has a name: "sensor 'gps'.every" instead of "sensor.0.every"."""
    lines = []
    tables: set[type[BaseModel]] = set()
    for item in error.errors():
        path = [part for part in item["loc"] if not str(part).startswith("function-")]
        where = _where(path, document)
        message = problem(item, path, model, tables)
        lines.append(f"{where}: {message}" if where else message)
    if len(lines) > MOST_PROBLEMS:
        lines[MOST_PROBLEMS:] = [f"and {len(lines) - MOST_PROBLEMS} more"]
    return "; ".join(lines)


def problem(item: ErrorDetails, path: At, model: type[BaseModel], listed: set[type[BaseModel]] | None = None) -> str:
    """One error, without its place: what is wrong and what was there. listed: tables whose keys have been said; is
    added to."""
    return _message(item, path, model, set() if listed is None else listed) + (_given(item) if path else "")


def _message(item: ErrorDetails, path: At, model: type[BaseModel], listed: set[type[BaseModel]]) -> str:
    limits = item.get("ctx", {})
    match item["type"]:
        case "missing":
            return _none_there(path, model)
        case "too_short" if not entries_at(model, path):
            return "is an empty list: give at least one"
        case "too_short":
            return _none_there(path, model)
        case "list_type":
            return _no_list(item["input"], path, model)
        case "model_type" | "dict_type":
            return _no_table(item["input"], path, model)
        case "extra_forbidden" if table := table_at(model, path[:-1]):
            said = table in listed
            listed.add(table)
            return no_such_key(str(path[-1]), table, listed=said)
        case "string_type":
            return f'must be text: write {path[-1]} = "..."'
        case "int_type":
            return "must be a whole number"
        case "bool_type":
            return "must be true or false"
        case "string_too_short":
            return f'is empty: write {path[-1]} = "..."'
        case "greater_than_equal":
            return f"must be at least {limits['ge']:,}"
        case "less_than_equal":
            return f"must be at most {limits['le']:,}"
        case "literal_error":
            return f"choose {limits['expected']}"
    return item["msg"].removeprefix("Value error, ")


def _none_there(path: At, model: type[BaseModel]) -> str:
    if entry := entries_at(model, path):
        return f"there is none: give at least one [[{path[-1]}]], with {' and '.join(required_keys(entry))}"
    value = '"..."' if is_text_at(model, path) else "..."
    return f"is missing: write `{path[-1]} = {value}`"


def _no_list(value: Any, path: At, model: type[BaseModel]) -> str:
    entry = entries_at(model, path)
    if entry is None:
        return f"must be a list: write `{path[-1]} = [...]`"
    if isinstance(value, dict):
        return f"this is one table and a list is needed: write [[{path[-1]}]], in two pairs of brackets"
    return f"must be tables: write [[{path[-1]}]] for each, with {' and '.join(required_keys(entry))}"


def _no_table(value: Any, path: At, model: type[BaseModel]) -> str:
    table = table_at(model, path)
    if isinstance(path[-1], int):
        needed = f", with {' and '.join(required_keys(table))}" if table else ""
        return f"must be a table: write [[{path[-2]}]] for each{needed}"
    header = ".".join(toml_key(str(part)) for part in path)
    if isinstance(value, list):
        return f"this is a list and one table is needed: write [{header}], in one pair of brackets"
    keys = f", which may have {', '.join(keys_of(table))}" if table else ""
    return f"must be a table: write [{header}]{keys}"


def _given(item: ErrorDetails) -> str:
    value = item["input"]
    if value is None or isinstance(value, dict | list):
        return ""
    if isinstance(value, str) and item["type"] not in ("literal_error", "extra_forbidden") and _NUMBER.fullmatch(value):
        return f' (given: "{value}", which is text: write {value}, without quotes)'
    return f" (given: {short(value)})"


def _where(path: At, document: Mapping[str, Any] | None) -> str:
    parts: list[str] = []
    at: Any = document
    for part in path:
        if isinstance(part, int):
            at = at[part] if isinstance(at, list) else None
        else:
            at = at.get(part) if isinstance(at, dict) else None
        if isinstance(part, int) and isinstance(at, dict) and isinstance(at.get("name"), str):
            parts[-1] += f" {at['name']!r}"
        else:
            parts.append(str(part))
    return ".".join(parts)
