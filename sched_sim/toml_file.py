"""Reading the user's TOML files: numbers as exact decimals, every error on one line."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from sched_sim.errors import InputError


def read_toml(path: Path, what: str, remedy: str) -> dict[str, Any]:
    """The document in `path`. what: how messages name the file; remedy: what to do if there is none.

    Raises InputError if the file is not there, cannot be read, or is no TOML.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"), parse_float=Decimal)
    except (FileNotFoundError, NotADirectoryError, IsADirectoryError):
        raise InputError(f"{what} not found: {remedy}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{what} cannot be read: {error}") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{what} is not valid TOML: {error}") from None


def problems(error: ValidationError, document: Mapping[str, Any] | None = None) -> str:
    """Every error of a checked file on one line: where, what was there, what is wrong. With the document, an entry of a
    list is named if it has a name: "sensor 'gps'.every" instead of "sensor.0.every"."""
    lines = []
    for item in error.errors():
        where = _where(item["loc"], document)
        message = item["msg"].removeprefix("Value error, ")
        value = item["input"]
        given = "" if isinstance(value, dict | list) else f" (given: {value})"
        lines.append(f"{where}: {message}{given}" if where else message)
    return "; ".join(lines)


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
