"""Reading the user's TOML files: numbers as exact decimals, every error on one line."""

from __future__ import annotations

import tomllib
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
