"""One function while it is translated: what its names stand for, and the memory that it needs."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from types import FunctionType

from filters.translation.kinds import NOTHING, Array, Flag, Int, Kind, Record, lasts
from filters.translation.library import Library
from filters.translation.names import c_name
from filters.translation.origins import TABLES, Origins, in_caller, wholly
from filters.translation.overlaps import Effects, Site
from filters.translation.refusal import Untranslatable
from filters.translation.scope import Place, assigned, escaping, places
from filters.translation.source import Source, source_of
from filters.translation.translated import Translated
from filters.translation.values import Value


class Widened(Exception):  # noqa: N818 - no error: the function is translated again
    """A variable turns out to hold another kind of number than it was declared for."""

    def __init__(self, name: str, kind: Kind) -> None:
        self.name, self.kind = name, kind


class Elsewhere(Exception):  # noqa: N818 - no error either
    """A variable turns out to hold arrays from elsewhere too."""

    def __init__(self, name: str, origins: Origins) -> None:
        self.name, self.origins = name, origins


@dataclass
class Body:
    """names: what each local name stands for now. wide: kinds of variables that a first translation found too narrow;
    also: origins of variables that it found too few.

    result: the kind of what it returns so far; result_origins: those of all that. memory: arrays that the caller gives
    it for what it returns; own: those of its own. writes: origins of what it writes. sites: the calls in it. before:
    lines that an expression needs done before it. loops: the names that were declared when each loop began that is
    being translated. target: the name that is being assigned to. assigned: how often each is. taken: the names in C.
    """

    unit: Library
    function: FunctionType
    kinds: tuple[Kind, ...]
    translate: Callable[[Body, ast.expr, bool], Value]
    wide: dict[str, Kind] = field(default_factory=dict)
    also: dict[str, Origins] = field(default_factory=dict)

    source: Source = field(init=False)
    places: dict[str, Place] = field(init=False)
    assigned: Counter[str] = field(init=False)
    escaping: set[str] = field(init=False)
    names: dict[str, Value] = field(init=False, default_factory=dict)
    result: Kind = field(init=False, default=NOTHING)
    result_origins: Origins = field(init=False, default=frozenset())
    writes: Origins = field(init=False, default=frozenset())
    sites: list[Site] = field(init=False, default_factory=list)
    memory: dict[str, Array] = field(init=False, default_factory=dict)
    own: dict[str, Array] = field(init=False, default_factory=dict)
    before: list[str] = field(init=False, default_factory=list)
    taken: set[str] = field(init=False)
    target: str = field(init=False, default="")
    loops: list[set[str]] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        self.source = source_of(self.function)
        self.assigned = assigned(self.source.body)
        self.places = {
            name: place for name, place in places(self.source.body).items() if name not in self.source.parameters
        }
        self.taken = {c_name(name) for name in (*self.source.parameters, *self.places)}
        self.escaping = escaping(self.source.body)
        if len(self.source.parameters) != len(self.kinds):
            raise Untranslatable(
                f"{self.source.file}:{self.source.first_line}: {self.function.__qualname__}: is "
                f"called with {len(self.kinds)} arguments, and has {len(self.source.parameters)} parameters"
            )
        for name, kind in zip(self.source.parameters, self.kinds, strict=True):
            if isinstance(kind, Int) and lasts(kind):
                kind = self.wide.get(name, kind)
            text = c_name(name) if lasts(kind) else ""
            if isinstance(kind, Int | Flag) and kind.known is not None:
                text = str(kind.known).lower()
            rows = f"{text}_rows" if isinstance(kind, Array) and kind.is_long else ""
            origins = wholly((c_name(name),)) | self.also.get(name, frozenset())
            self.names[name] = Value(text, kind, by_pointer=isinstance(kind, Record), rows=rows, origins=origins)

    def expression(self, node: ast.expr, *, returned: bool = False) -> Value:
        """See `expressions.expression`."""
        return self.translate(self, node, returned)

    def fresh(self, wanted: str) -> str:
        """A name in C that nothing else has here."""
        name, number = wanted, 1
        while name in self.taken:
            number += 1
            name = f"{wanted}_{number}"
        self.taken.add(name)
        return name

    def array(self, wanted: str, kind: Array, *, returned: bool) -> Value:
        """Memory for a new array: of the caller if it is returned."""
        name = self.fresh(f"{c_name(self.target)}_memory" if self.target else wanted)
        (self.memory if returned else self.own)[name] = kind
        return Value(name, kind, passing=bool(self.loops), origins=wholly((name,)))

    def effects(self) -> Effects:
        """What it does with arrays, when all of it is translated."""
        arguments = {
            **{c_name(name): kind for name, kind in zip(self.source.parameters, self.kinds, strict=True)},
            **self.memory,
        }
        written = {path for _, path in self.writes if not path or path == TABLES or path[0] in arguments}
        return Effects(
            arguments,
            frozenset(written | {(name,) for name in self.memory}),
            frozenset(map(c_name, self.assigned)),
            tuple(self.sites),
        )

    def calls(self, function: Translated, given: dict[str, Origins]) -> None:
        """Note a call. given: the origins of its arguments, by the name of the parameter in C."""
        self.sites.append(Site(function.name, given))
        self.writes |= in_caller(frozenset(((), path) for path in function.effects.writes), given)
