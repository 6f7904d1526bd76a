"""Choose among the correctors of a filter by number, in code that can be compiled."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np

from filters.kernels.place import IntArray
from filters.modular.composition import ModularFilter
from filters.modular.workspace import new_workspace


class Chain(NamedTuple):
    """use(kind, member, parts, given) does job(expect, view, observed space, workspace, given) for a sensor.

    places (sensors, 2): kind and member of each sensor. parts: (view, observed space, workspace) of each member of the
    first kind, then the parts of the other kinds: ((member, member), ((member,), ())).
    """

    use: Callable[..., None]
    parts: Any
    places: IntArray


def chain(job: Callable[..., None], composed: ModularFilter) -> Chain:
    """The chain of a filter's sensors. job(..., given): given is whatever else it takes.

    Correctors differ in the types of what they take, and compiled code cannot choose among types by a number. Those of
    one kind, with the same `expect` and the user's same functions, have the same types, and are compiled once.
    """
    kinds: dict[tuple[Any, ...], list[Any]] = {}
    places = []
    for sensor in composed.sensors:
        corrector = sensor.corrector
        view, work = corrector.view(composed.of.errors), new_workspace(composed.of, corrector.observed)
        key = corrector.expect, *(value for value in view if isinstance(value, FunctionType))
        members = kinds.setdefault(key, [])
        places.append((list(kinds).index(key), len(members)))
        members.append((view, corrector.observed, work))
    parts: Any = ()
    for members in reversed(kinds.values()):
        parts = (tuple(members), parts)
    use = _chained(job, tuple(expect for expect, *_ in kinds))
    return Chain(use, parts, np.array(places, dtype=np.int64).reshape(-1, 2))


@cache
def _chained(job: Callable[..., None], expects: tuple[Callable[..., None], ...]) -> Callable[..., None]:
    """Same job and functions in, same function out, so that it is compiled once."""
    rest: Callable[..., None] = _no_such_kind
    for expect in reversed(expects):
        rest = _first_or(job, expect, rest)
    return rest


def _first_or(job: Callable[..., None], expect: Callable[..., None], rest: Callable[..., None]) -> Callable[..., None]:
    def use(kind: int, member: int, parts: Any, given: Any) -> None:
        if kind == 0:
            view, observed, work = parts[0][member]
            job(expect, view, observed, work, given)
        else:
            rest(kind - 1, member, parts[1], given)

    return use


def _no_such_kind(_kind: int, _member: int, _parts: Any, _given: Any) -> None:
    pass
