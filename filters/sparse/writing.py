"""Symbols as statements of Python: what is used more than once has a name, and what is long is cut into parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from filters.sparse.symbols import Symbol

WIDTH = 80
"""Characters of an expression; what is longer is computed in parts."""

LINES = 40
"""Of a function. Compilers take the square of the time for one that is twice as long."""

Place: TypeAlias = tuple[Any, ...]
"""The text of an array, and the indices of one of its entries."""

Written: TypeAlias = Sequence[tuple[Place, Symbol]]
"""What is written where."""


def nodes(written: Written) -> Iterator[Symbol]:
    """All that these numbers are made of, each once."""
    seen: set[Symbol] = set()
    waiting = [node for _, node in written]
    while waiting:
        node = waiting.pop()
        if node not in seen:
            seen.add(node)
            yield node
            waiting += _made_of(node)


def written_out(written: Written, homes: Mapping[Symbol, Place]) -> list[list[str]]:
    """The statements, in parts that can be functions of their own.

    homes: scratch in which a number may be kept from one part to the next, by which it is also named.
    """
    uses = Counter(part for node in nodes(written) for part in _made_of(node))
    uses.update({node: 1 for _, node in written})
    places: dict[Symbol, list[Place]] = {}
    for place, node in written:
        places.setdefault(node, []).append(place)
    writer = _Writer(uses, homes, places)
    before: Any = None
    for node, place in _in_order(places, written):
        if place[:2] != before:
            writer.begin_row()
        before = place[:2]
        writer.write(node)
    return writer.parts


def _made_of(node: Symbol) -> tuple[Symbol, ...]:
    return () if _is_plain(node) else node.of


def _is_plain(node: Symbol) -> bool:
    return node.operation in ("given", "number")


def _in_order(places: Mapping[Symbol, Sequence[Place]], written: Written) -> list[tuple[Symbol, Place]]:
    """Each number with the last of its places: of what is symmetric, that below the diagonal."""
    return [(node, place) for place, node in written if place == places[node][-1]]


def _text(place: Place) -> str:
    return f"{place[0]}[{', '.join(map(str, place[1:]))}]"


class _Writer:
    """Expressions, and the local variables that they need."""

    def __init__(
        self, uses: Mapping[Symbol, int], homes: Mapping[Symbol, Place], places: Mapping[Symbol, Sequence[Place]]
    ) -> None:
        self._uses, self._homes, self._places = uses, homes, places
        self._left = dict(uses)  # how often each is still to be used
        self._local: dict[Symbol, str] = {}
        self._kept: dict[Symbol, str] = {}
        self._written: set[Symbol] = set()
        self._unnamed = 0
        self.parts: list[list[str]] = [[]]

    def begin_row(self) -> None:
        """A new part, if this one is long and what the next ones need of it has a place to be kept in."""
        needed = [node for node in self._local if self._left[node] > 0]
        if len(self.parts[-1]) < LINES or not all(node in self._places or node in self._homes for node in needed):
            return
        for node in needed:
            if node in self._places:
                self._kept[node] = _text(self._places[node][-1])
            else:
                self._kept[node] = _text(self._homes[node])
                self._add(f"{self._kept[node]} = {self._local[node]}")
        self._local.clear()
        self.parts.append([])

    def write(self, node: Symbol) -> None:
        """To all of its places, unless it is there."""
        text, _ = self._expression(node)
        if node not in self._written:
            if len(self._places[node]) > 1 and not _is_plain(node) and node not in self._local:
                text = self._named(node, text)
            else:
                self._write(node, text)

    def _write(self, node: Symbol, text: str) -> None:
        self._written.add(node)
        for place in self._places[node]:
            self._add(f"{_text(place)} = {text}")

    def _add(self, line: str) -> None:
        self.parts[-1].append(line)

    def _expression(self, node: Symbol) -> tuple[str, int]:
        """And how tightly its outermost operator binds, the tightest last."""
        if _is_plain(node):
            return self._written_out(node)
        self._left[node] -= 1
        if node in self._local:
            return self._local[node], 3
        if node in self._kept:
            return self._kept[node], 3
        text, level = self._written_out(node)
        return (text, level) if self._uses[node] < 2 else (self._named(node, text), 3)

    def _named(self, node: Symbol, text: str) -> str:
        """A local variable, which is written to the places of the number at once."""
        name = self._local[node] = self._name(node)
        self._add(f"{name} = {text}")
        if node in self._places and node not in self._written:
            self._write(node, name)
        return name

    def _name(self, node: Symbol) -> str:
        home = self._homes.get(node) or self._places.get(node, [None])[-1]
        if home is not None:
            array, *indices = home
            return "_".join([str(array).rpartition(".")[2], *map(str, indices)])
        self._unnamed += 1
        return f"t{self._unnamed}"

    def _written_out(self, node: Symbol) -> tuple[str, int]:
        match node.operation:
            case "given":
                return _text(node.of), 3
            case "number":
                return repr(node.of[0]), 3
            case "sqrt":
                return f"np.sqrt({self._expression(node.of[0])[0]})", 3
            case "negative":
                return f"-{self._within(node.of[0], 2)}", 2
        tight = node.operation in "*/"
        sides = [(self._within(part, level), part) for part, level in zip(node.of, _LEVELS[tight], strict=True)]
        while sum(len(text) for text, _ in sides) > WIDTH:
            longer = max((0, 1), key=lambda side: len(sides[side][0]))
            text, part = sides[longer]
            sides[longer] = self._named(part, text), part
        return f"{sides[0][0]} {node.operation} {sides[1][0]}", 1 if tight else 0

    def _within(self, node: Symbol, level: int) -> str:
        text, own = self._expression(node)
        return text if own >= level else f"({text})"


_LEVELS = {False: (0, 1), True: (1, 2)}
"""How tightly the sides of + and - must bind, and of * and /."""
