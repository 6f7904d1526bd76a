"""What a checked TOML table may hold, told from its pydantic model."""

from __future__ import annotations

from collections.abc import Sequence
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel

from sched_sim.text import did_you_mean


def table_at(model: type[BaseModel], path: Sequence[int | str]) -> type[BaseModel] | None:
    """The model of the table at this place of a document of `model`; None if that is not a table with known keys."""
    return _model(_type_at(model, path))


def is_text_at(model: type[BaseModel], path: Sequence[int | str]) -> bool:
    return str in _choices(_type_at(model, path))


def keys_of(table: type[BaseModel]) -> list[str]:
    """The keys as the file writes them."""
    return [field.alias or name for name, field in table.model_fields.items()]


def required_keys(table: type[BaseModel]) -> list[str]:
    """Those, and the pairs of which one is; a model names these as its `one_of`."""
    required = [field.alias or name for name, field in table.model_fields.items() if field.is_required()]
    return [*required, *getattr(table, "one_of", ())]


def no_such_key(key: str, table: type[BaseModel], *, listed: bool = False) -> str:
    """What to say of a key that the table may not have. listed: its keys have been said."""
    keys = keys_of(table)
    meant = did_you_mean(key, keys)
    if listed:
        return f"this key is not permitted{meant and f'; {meant.strip()}'}"
    return f"this key is not permitted; {meant}the keys here are {', '.join(keys)}"


def entries_at(model: type[BaseModel], path: Sequence[int | str]) -> type[BaseModel] | None:
    """The model of each entry where the document has a list of tables, [[key]]; None if it has none there."""
    return table_at(model, [*path, 0]) if table_at(model, path) is None else None


def _type_at(model: type[BaseModel], path: Sequence[int | str]) -> Any:
    at: Any = model
    for part in path:
        at = _within(at, part)
    return at


def _within(annotation: Any, part: int | str) -> Any:
    """The type of what stands at `part` of a value of this type; None if it is not known."""
    table = _model(annotation)
    if table is not None:
        annotations = [field.annotation for name, field in table.model_fields.items() if part in (name, field.alias)]
        return annotations[0] if annotations else None
    for choice in _choices(annotation):
        if get_origin(choice) in (list, dict):
            return get_args(choice)[-1]
    return None


def _model(annotation: Any) -> type[BaseModel] | None:
    models = [choice for choice in _choices(annotation) if isinstance(choice, type) and issubclass(choice, BaseModel)]
    return models[0] if models else None


def _choices(annotation: Any) -> list[Any]:
    """The members of a union, without what annotates them."""
    if get_origin(annotation) is Annotated:
        return _choices(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return [choice for each in get_args(annotation) for choice in _choices(each)]
    return [annotation]
