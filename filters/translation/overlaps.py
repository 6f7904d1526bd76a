"""Which parameters of functions share no memory that is written with anything else, at whatever place they are called.

That is what `restrict` says in C. Without it a compiler must read arrays again after each number that is written, and
cannot compute several numbers at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple, TypeAlias

from filters.translation.kinds import Kind
from filters.translation.origins import TABLES, Origins, Path, arrays_of, in_caller, wholly

Pair: TypeAlias = frozenset[Path]
"""Two arrays among the arguments of a function that may share memory."""


class Site(NamedTuple):
    """A call. name: of the function that is called. given: origins of its arguments, by parameter, in the caller."""

    name: str
    given: dict[str, Origins]


class Effects(NamedTuple):
    """What a function does with arrays.

    arguments: the kind of each parameter, memory that the caller gives included. writes: origins of what it writes, as
    far as its caller has it. assigned: parameters that it gives other values. sites: the calls in it.
    """

    arguments: dict[str, Kind]
    writes: frozenset[Path]
    assigned: frozenset[str]
    sites: tuple[Site, ...]

    def arrays(self) -> list[Path]:
        """All that it may read or write and that is not its own."""
        given = [path for name, kind in self.arguments.items() for path in arrays_of(kind, (name,))]
        return [*given, TABLES]

    def pairs(self) -> frozenset[Pair]:
        """Of arguments of which nothing is known."""
        return frozenset(map(frozenset, combinations(self.arrays(), 2)))


def apart(effects: dict[str, Effects], called: dict[str, frozenset[Pair]]) -> dict[str, frozenset[str]]:
    """The parameters, by function, of which no number that is written is reached in another way too.

    effects: a function comes behind those that it calls. called: the functions that others call, and what may overlap
    among their arguments.
    """
    pairs: dict[str, set[Pair]] = {name: set(called.get(name, ())) for name in effects}
    for name in reversed(effects):
        for site in effects[name].sites:
            pairs[site.name] |= _overlapping(effects[site.name].arrays(), site, pairs[name])
    return {name: _apart(each, pairs[name]) for name, each in effects.items()}


def _overlapping(arrays: Sequence[Path], site: Site, known: set[Pair]) -> set[Pair]:
    """The arrays among the arguments of a call that may overlap. known: those that may in the caller."""
    from_where = {path: {origin for _, origin in in_caller(wholly(path), site.given)} for path in arrays}
    return {
        frozenset((one, other))
        for one, other in combinations(arrays, 2)
        if any(_overlap(a, b, known) for a in from_where[one] for b in from_where[other])
    }


def _overlap(a: Path, b: Path, known: set[Pair]) -> bool:
    """Whether one is part of the other, or from an unknown place, or they are known to overlap."""
    return a[: len(b)] == b or b[: len(a)] == a or frozenset((a, b)) in known


def _apart(each: Effects, pairs: set[Pair]) -> frozenset[str]:
    if not each.writes or () in each.writes:
        return frozenset()
    shared = {path for pair in pairs if pair & each.writes for path in pair}
    names = {path[0] for path in each.arrays() if len(path) == 1 and path != TABLES} - each.assigned
    return frozenset(name for name in names if (name,) not in shared)
