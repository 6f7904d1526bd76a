"""Choose among the correctors of a filter by number, in code that can be compiled."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np

from filters.kernels.place import IntArray
from filters.modular.composition import ModularFilter
from filters.modular.correctors import Corrector
from filters.modular.workspace import new_workspace


class Chain(NamedTuple):
    """use(kind, member, parts, given) does the job (view, observed space, workspace, given) of a sensor.

    places (sensors, 2): kind and member of each sensor. parts: (view, observed space, workspace) of each member of the
    first kind, then the parts of the other kinds: ((member, member), ((member,), ())).
    """

    use: Callable[..., None]
    parts: Any
    places: IntArray


def chain(job_of: Callable[[Corrector], Callable[..., None]], composed: ModularFilter) -> Chain:
    """The chain of a filter's sensors. job_of(corrector): the job(..., given); given is whatever else it takes.

    Correctors differ in the types of what they take, and compiled code cannot choose among types by a number. Those of
    one kind, with the same job and the user's same functions, have the same types, and are compiled once.
    """
    kinds: dict[tuple[Any, ...], list[Any]] = {}
    places = []
    for sensor in composed.sensors:
        corrector = sensor.corrector
        view, work = corrector.view(composed.of.errors), new_workspace(composed.of, corrector.observed)
        key = job_of(corrector), *(value for value in view if isinstance(value, FunctionType))
        members = kinds.setdefault(key, [])
        places.append((list(kinds).index(key), len(members)))
        members.append((view, corrector.observed, work))
    parts: Any = ()
    for members in reversed(kinds.values()):
        parts = (tuple(members), parts)
    use = _chained(tuple(job for job, *_ in kinds))
    return Chain(use, parts, np.array(places, dtype=np.int64).reshape(-1, 2))


@cache
def _chained(jobs: tuple[Callable[..., None], ...]) -> Callable[..., None]:
    """Same jobs in, same function out, so that it is compiled once."""
    rest: Callable[..., None] = _no_such_kind
    for job in reversed(jobs):
        rest = _first_or(job, rest)
    return rest


def _first_or(job: Callable[..., None], rest: Callable[..., None]) -> Callable[..., None]:
    def use(kind: int, member: int, parts: Any, case: Any) -> None:
        if kind == 0:
            view, observed, work = parts[0][member]
            job(view, observed, work, case)
        else:
            rest(kind - 1, member, parts[1], case)

    return use


def _no_such_kind(_kind: int, _member: int, _parts: Any, _case: Any) -> None:
    pass
