"""Values of Python as data of a C program: arrays, and records that point at them."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from filters.translation.declarations import memory, pointer
from filters.translation.kinds import Array, Kind, Real, Record, lasts
from filters.translation.library import Precision
from filters.translation.prototype import wrapped
from filters.translation.refusal import Untranslatable
from filters.translation.unit import Unit


class Kept(NamedTuple):
    """How an array is kept. name: in C. constant: nothing writes to it, so that it may stay in flash."""

    name: str
    constant: bool = False


Placing: TypeAlias = Callable[[tuple[str, ...]], Kept | None]
"""How an array is kept, by the names of the fields that lead to it, that of the value first; None: nothing needs it."""


@dataclass
class Data:
    """lines: the declarations so far. An array that several values share is declared once, so that they share it.

    sizes: of the arrays that are not constant, how many numbers each has. refuses: numbers that single precision has
    not, which are infinite or zero otherwise.
    """

    unit: Unit
    refuses: bool = True
    lines: list[str] = field(default_factory=list)
    sizes: dict[str, int] = field(default_factory=dict)
    _names: dict[int, str] = field(default_factory=dict)
    _taken: set[str] = field(default_factory=set)
    _held: list[Any] = field(default_factory=list)  # so that no other array gets the identity of one that is named

    def record(self, name: str, value: Any, kind: Record, placing: Placing) -> None:
        """A record that never changes, behind the arrays that it points at."""
        text = self.text(value, kind, (name,), placing)
        self.lines.append(wrapped(f"static const {self.unit.record_name(kind)} {name} = {text};"))

    def text(self, value: Any, kind: Kind, names: tuple[str, ...], placing: Placing) -> str:
        """The value as an initialiser, behind the arrays that it needs.

        Raises:
            Untranslatable: it holds a number that single precision does not have.
        """
        match kind:
            case Array():
                return self._array(value, kind, names, placing)
            case Record(fields=fields):
                texts = []
                for item, (name, part) in zip(value, fields, strict=True):
                    if lasts(part):
                        texts.append(self.text(item, part, (*names, name), placing))
                        texts += [str(len(item))] if isinstance(part, Array) and part.is_long else []
                return "{" + ", ".join(texts) + "}"
            case Real():
                return self._number(float(value), ".".join(names))
        return str(int(value))

    def array(self, kept: Kept, value: Any, item: str = "real") -> None:
        """An array with these numbers, not shared; zeros are not written."""
        shape = Array(item, value.shape, value.shape[1:])
        begin = f"static {'const ' if kept.constant else ''}{memory(shape, kept.name)}"
        if np.any(value):
            begin += f" = {self._listed(value, kept.name)}"
        elif kept.constant:
            begin += f" = {'{' * value.ndim}0{'}' * value.ndim}"
        self._taken.add(kept.name)
        if not kept.constant:
            self.sizes[kept.name] = value.size
        self.lines += map(wrapped, f"{begin};".splitlines())

    def name(self, value: Any) -> str | None:
        """Of an array, if it is declared."""
        return self._names.get(id(value))

    def _array(self, value: Any, kind: Array, names: tuple[str, ...], placing: Placing) -> str:
        kept = placing(names)
        if kept is None:
            return "NULL"
        if id(value) not in self._names:
            self._held.append(value)
            while kept.name in self._taken:  # a.b_c and a_b.c
                kept = kept._replace(name=f"{kept.name}_")
            self.array(kept, value, kind.item)
            cast = f"({pointer(kind, '')})" if kept.constant else ""
            self._names[id(value)] = f"{cast}{kept.name}"
        return self._names[id(value)]

    def _listed(self, value: Any, name: str) -> str:
        if value.ndim > 1:
            rows = ",\n".join(textwrap.indent(self._listed(row, name), "    ") for row in value)
            return f"{{\n{rows}\n}}"
        texts = [self._number(float(x), name) if value.dtype.kind == "f" else str(int(x)) for x in value]
        return "{" + ", ".join(texts) + "}"

    def _number(self, value: float, what: str) -> str:
        if self.refuses or self.unit.precision == "double":
            return number(self.unit, value, what)
        with np.errstate(over="ignore", under="ignore"):
            return self.unit.number(float(str(np.float32(value))))


def number(unit: Unit, value: float, what: str) -> str:
    """The number that is nearest to a value, as C has it. what: whose it is, for messages.

    Raises:
        Untranslatable: single precision has none.
    """
    if unit.precision == "single" and np.isfinite(value):
        with np.errstate(over="ignore", under="ignore"):
            nearest = np.float32(value)
        if not np.isfinite(nearest) or (value and not nearest):
            raise Untranslatable(f"{what}: single precision has no {value:g}; choose double")
        return unit.number(float(str(nearest)))
    return unit.number(value)


def rounded(value: Any, precision: Precision, done: dict[int, tuple[Any, Any]]) -> Any:
    """A value with floats of single precision, if that is asked for. done: arrays and what became of them, by identity,
    so that what is shared stays shared."""
    if precision == "double":
        return value
    if isinstance(value, np.ndarray):
        if value.dtype.kind != "f":
            return value
        if id(value) not in done:
            with np.errstate(over="ignore", under="ignore"):
                done[id(value)] = value, value.astype(np.float32)
        return done[id(value)][1]
    if isinstance(value, tuple):
        items = [rounded(item, precision, done) for item in value]
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    return np.float32(value) if isinstance(value, float) else value
