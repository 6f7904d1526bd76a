"""Choose among the correctors of a filter by number, in code that can be compiled."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from filters.modular.composition import ModularFilter
from filters.modular.workspace import new_workspace


@cache
def chain(job: Callable[..., None], expects: tuple[Callable[..., None], ...]) -> Callable[..., None]:
    """use(number, parts, given) does job(expect, view, observed space, workspace, given) for the sensor of this number.

    parts: see `parts_of`. given: whatever else the job takes. Correctors differ in the types of what they take, and
    compiled code cannot choose among types by a number. Same job and functions in, same function out, so that it is
    compiled once.
    """
    rest: Callable[..., None] = _no_such_sensor
    for expect in reversed(expects):
        rest = _first_or(job, expect, rest)
    return rest


def parts_of(composed: ModularFilter) -> Any:
    """(view, observed space, workspace) of the first sensor, then the parts of the others: ((...), ((...), ()))."""
    parts: Any = ()
    for sensor in reversed(composed.sensors):
        corrector = sensor.corrector
        work = new_workspace(composed.of, corrector.observed)
        parts = ((corrector.view(composed.of.errors), corrector.observed, work), parts)
    return parts


def _first_or(job: Callable[..., None], expect: Callable[..., None], rest: Callable[..., None]) -> Callable[..., None]:
    def use(number: int, parts: Any, given: Any) -> None:
        if number == 0:
            view, observed, work = parts[0]
            job(expect, view, observed, work, given)
        else:
            rest(number - 1, parts[1], given)

    return use


def _no_such_sensor(_number: int, _parts: Any, _given: Any) -> None:
    pass
