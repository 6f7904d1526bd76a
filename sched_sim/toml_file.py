"""Reading the user's TOML files: numbers as exact decimals, every error on one line."""

from __future__ import annotations

import re
import stat
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from sched_sim.bounds import MOST_BYTES, MOST_DIGITS, check_digits, short
from sched_sim.errors import InputError
from sched_sim.toml_tables import entries_at, no_such_key, required_keys, table_at

_DEEP = re.compile(r"""(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')\s*+\.\s*+){100}""")
"""A key in a hundred tables, which `tomllib` takes long for."""
_NUMBER = re.compile(r"[+-]?\d+(\.\d+)?([eE][+-]?\d+)?")


MOST_PROBLEMS = 20
"""Of a file, in one message."""


def read_toml(path: Path, what: str, remedy: str) -> dict[str, Any]:
    """The document in `path`. what: how messages name the file; remedy: what to do if there is none.

    Raises InputError if the file is not there, is a folder or a device, is too large, cannot be read, is no TOML, or
    holds a number that is out of bounds (`sched_sim.bounds`).
    """
    text = _read(path, what, remedy)
    too_deep = f"{what} is nested too deep: no table of this program is in more than a few others"
    if _DEEP.search(text):
        raise InputError(too_deep)
    try:
        document = tomllib.loads(text, parse_float=Decimal)
        if found := list(_out_of_bounds(document, "")):
            raise InputError(f"{what}: {'; '.join(found)}")
        return document
    except RecursionError:
        raise InputError(too_deep) from None
    except InputError:
        raise
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{what} is not valid TOML: {error}") from None
    except (ValueError, ArithmeticError):
        raise InputError(f"{what} holds a number that is too long: give at most {MOST_DIGITS} digits") from None


def _read(path: Path, what: str, remedy: str) -> str:
    """Of a regular file: a device or a pipe may have no end."""
    try:
        about = path.stat()
        if not stat.S_ISREG(about.st_mode):
            problem = "is a folder, not a file" if stat.S_ISDIR(about.st_mode) else "is no regular file"
            raise InputError(f"{what} {problem}: {remedy}")
        if about.st_size > MOST_BYTES:
            raise InputError(f"{what} has {about.st_size:,} bytes: at most {MOST_BYTES:,} are read; give a smaller one")
        with path.open("rb") as file:
            return file.read(MOST_BYTES).decode("utf-8")
    except InputError:
        raise
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"{what} not found: {remedy}") from None
    except OSError as error:
        raise InputError(f"{what} cannot be read: {error.strerror}; {remedy}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{what} cannot be read: {error}; save it as UTF-8") from None
    except ValueError:  # a name with a null character
        raise InputError(f"{what} is no name of a file: {remedy}") from None


def _out_of_bounds(value: Any, where: str) -> Iterator[str]:
    """What to say of the numbers in a document that are too long to be computed with."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _out_of_bounds(item, f"{where}.{key}" if where else key)
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _out_of_bounds(item, f"{where}.{number}")
    elif isinstance(value, int | Decimal) and not isinstance(value, bool):
        try:
            check_digits(value, where)
        except InputError as error:
            yield str(error)


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
    if len(lines) > MOST_PROBLEMS:
        lines[MOST_PROBLEMS:] = [f"and {len(lines) - MOST_PROBLEMS} more"]
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
    return f" (given: {short(value)})"


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
