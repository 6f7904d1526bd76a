"""Where arrays are from: a parameter, a field of one, or memory of the function itself; those from elsewhere are apart.

An origin is a path: a name in C, then the fields that lead to the array. The origins of a value are pairs: the fields
that lead to a part of it, and where that part may be from.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias

from filters.translation.kinds import Array, Kind, Record

Path: TypeAlias = tuple[str, ...]
Origins: TypeAlias = frozenset[tuple[Path, Path]]

UNKNOWN: Path = ()
TABLES: Path = ("static",)
"""Of the arrays of numbers in the file itself; no variable in C has this name."""


def wholly(origin: Path) -> Origins:
    """Of a value that is from there with all its parts."""
    return frozenset({((), origin)})


ANYWHERE = wholly(UNKNOWN)


def of_field(origins: Origins, name: str) -> Origins:
    """Those of a field of a record."""
    found: set[tuple[Path, Path]] = set()
    for part, origin in origins:
        if not part:
            found.add(((), (*origin, name) if origin else UNKNOWN))
        elif part[0] == name:
            found.add((part[1:], origin))
    return frozenset(found)


def as_field(origins: Origins, name: str) -> Origins:
    """Those of a record of which this is a field."""
    return frozenset(((name, *part), origin) for part, origin in origins)


def in_caller(origins: Origins, given: Mapping[str, Origins]) -> Origins:
    """Those of a value of a function, where it is called. given: of each argument, by the name of the parameter."""
    found: set[tuple[Path, Path]] = set()
    for part, path in origins:
        there = wholly(path) if path in (UNKNOWN, TABLES) else given.get(path[0], ANYWHERE)
        for name in path[1:]:
            there = of_field(there, name)
        found |= {((*part, *rest), origin) for rest, origin in there}
    return frozenset(found)


def arrays_of(kind: Kind, path: Path) -> Iterator[Path]:
    """The paths of the arrays in a parameter of this kind."""
    match kind:
        case Array():
            yield path
        case Record(fields=fields):
            for name, part in fields:
                yield from arrays_of(part, (*path, name))
