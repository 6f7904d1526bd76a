"""Replace the functions inside an argument: a system model is a named tuple of functions and arrays."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any


def bind(value: Any, version: Callable[[FunctionType], Any]) -> Any:
    """`value` with version(f) for each plain function f in it, however deep in (named) tuples; the rest is kept."""
    if isinstance(value, FunctionType):
        return version(value)
    if isinstance(value, tuple):
        return like(value, [bind(item, version) for item in value])
    return value


def like(original: tuple[Any, ...], items: list[Any]) -> Any:
    """A tuple of these items, of the named tuple type of `original` if it has one."""
    return type(original)(*items) if hasattr(original, "_fields") else tuple(items)
