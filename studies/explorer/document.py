"""Records as plain data that JSON has."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from fractions import Fraction
from functools import cache
from typing import Any

from sched_sim.text import visible

PLAIN = (str, int, float, list, type(None))


def document(value: Any) -> Any:
    """Records and mappings become objects, tuples lists of what they hold, fractions their value beside the exact text.
    Lists are columns of plain values, and stay as they are."""
    if isinstance(value, PLAIN):
        return value
    if isinstance(value, Fraction):
        return {"value": float(value), "exact": str(value)}
    if names := _names(value.__class__):
        return {name: document(getattr(value, name)) for name in names}
    if isinstance(value, dict):
        return {key: document(item) for key, item in value.items()}
    if isinstance(value, tuple):
        return [document(item) for item in value]
    return value


def all_visible(value: Any) -> Any:
    """Plain data with each text in it, and each key, made `visible`."""
    if isinstance(value, str):
        return visible(value)
    if isinstance(value, dict):
        return {visible(key): all_visible(item) for key, item in value.items()}
    return [all_visible(item) for item in value] if isinstance(value, list | tuple) else value


@cache
def _names(kind: type) -> list[str]:
    """Of the fields of a record; none of what is no record."""
    return [field.name for field in fields(kind)] if is_dataclass(kind) else []
