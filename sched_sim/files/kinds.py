"""Which of the user's files a TOML document is, where another one is needed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from sched_sim.errors import InputError, option

Document = Mapping[str, Any]


def _has_table(*keys: str) -> Callable[[Document], bool]:
    return lambda document: any(isinstance(document.get(key), Mapping) for key in keys)


def _is_part(document: Document) -> bool:
    return "logic_per_arithmetic" in document or _has_table("cycles", "microseconds")(document)


def _is_scenario(document: Document) -> bool:
    return "sensor" in document or "predictor" in document


KINDS: Mapping[str, tuple[str, Callable[[Document], bool]]] = {
    "scenario": ("a scenario", _is_scenario),
    "processor": ("a processor's file", _is_part),
    "costs": ("a cost table", _has_table("costs", "operations")),
    "tasks": ("a file of tasks", lambda document: "task" in document and document.keys() <= {"task", "unit"}),
}
"""By the argument that takes such a file: what it is called, and how it is known."""


def refuse_other_kind(document: Document, what: str, wanted: str) -> None:
    """Raises InputError, with the argument that takes it, for a file of another kind than that which is wanted."""
    if KINDS[wanted][1](document):
        return
    for kind, (name, is_one) in KINDS.items():
        if is_one(document):
            raise InputError(f"{what}: this is {name}, and {KINDS[wanted][0]} is needed; give it to {option(kind)}")
