"""Writing TOML that `toml_reader.read_toml` reads back."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any

BARE = re.compile(r"[A-Za-z0-9_-]+")
"""A key that needs no quotes."""


def toml_key(name: str) -> str:
    """A key, in quotes where it must be."""
    return name if BARE.fullmatch(name) else toml_value(name)


def toml_number(value: Fraction) -> str:
    """A number; exact if it is a decimal that a float has."""
    return str(value.numerator) if value.denominator == 1 else repr(float(value))


def toml_value(value: Any) -> str:
    """A scalar, also one of NumPy's or a decimal, a list or an inline table; JSON writes strings, numbers, booleans as
    TOML does."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{toml_key(name)} = {toml_value(item)}" for name, item in value.items()) + " }"
    return json.dumps(value, ensure_ascii=False, default=_plain)


def _plain(value: Any) -> Any:
    return float(value) if isinstance(value, Decimal) else value.item()


def toml_tables(name: str, values: Mapping[str, Any]) -> list[str]:
    """The lines of a TOML table, or of one for each of its values where these are tables themselves."""
    if not all(isinstance(value, Mapping) for value in values.values()):
        values, name = {name: values}, ""
    prefix = f"{toml_key(name)}." if name else ""
    return [
        line
        for table, entries in values.items()
        for line in (
            "",
            f"[{prefix}{toml_key(table)}]",
            *(f"{toml_key(entry)} = {toml_value(item)}" for entry, item in entries.items()),
        )
    ]
