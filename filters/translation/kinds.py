"""What a value is in the C program, or that it is known while translating and is not in the program at all."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from types import FunctionType, MethodType
from typing import Any, TypeAlias

import numpy as np

from filters.translation.refusal import Untranslatable

LONG = 64
"""Arrays of more rows than this are translated for any number of rows, and carry theirs with them."""

LARGEST = 2**31 - 1
"""What an int of 32 bits holds."""


@dataclass(frozen=True)
class Int:
    """A whole number in [low, high]; None where there is no bound. One that can be only one number is known."""

    low: int | None = None
    high: int | None = None

    @property
    def known(self) -> int | None:
        return self.low if self.low is not None and self.low == self.high else None

    @property
    def fits(self) -> bool:
        """Whether an int of 32 bits holds it, as far as its bounds say."""
        return all(bound is None or -LARGEST - 1 <= bound <= LARGEST for bound in (self.low, self.high))

    @property
    def counts(self) -> bool:
        """Whether it is never negative."""
        return self.low is not None and self.low >= 0


@dataclass(frozen=True)
class Real:
    """A floating-point number."""


@dataclass(frozen=True)
class Flag:
    """A truth value."""

    known: bool | None = None


@dataclass(frozen=True)
class Nothing:
    """What a function without a result returns."""


@dataclass(frozen=True)
class Array:
    """item: the type of its numbers in C. shape: None for a number of rows that the program knows.

    inner: the lengths of rows in memory, of the axes behind the first; longer than the shape says for part of an array.
    skipped: of each of these axes, how many come before the part begins; nothing where none does.
    """

    item: str
    shape: tuple[int | None, ...]
    inner: tuple[int, ...]
    skipped: tuple[int, ...] = ()

    @property
    def is_long(self) -> bool:
        return bool(self.shape) and self.shape[0] is None


def _plain_tuple(*items: Any) -> tuple[Any, ...]:
    return items


@dataclass(frozen=True)
class Record:
    """A named tuple, or a tuple, whose fields are then f0, f1, ...; made_by: its class in Python."""

    name: str
    fields: tuple[tuple[str, Kind], ...]
    made_by: Callable[..., Any] = field(default=_plain_tuple, compare=False)

    def kind_of_field(self, name: str) -> Kind | None:
        return dict(self.fields).get(name)


@dataclass(frozen=True)
class Function:
    """A function in Python, which is translated where it is called."""

    function: FunctionType


@dataclass(frozen=True, eq=False)
class Constant:
    """Any other value of Python: a module, a class, a shape."""

    value: Any


Kind: TypeAlias = Int | Real | Flag | Nothing | Array | Record | Function | Constant

REAL, FLAG, NOTHING = Real(), Flag(), Nothing()
ITEMS = {"f": "real", "b": "bool"}


def exactly(number: int) -> Int:
    """A whole number that is known."""
    return Int(number, number)


def kind_of(value: Any, *, given: bool = True) -> Kind:
    """The kind of an argument. given: whether a whole number is one that each call gives, or is part of the type.

    Raises:
        Untranslatable: there is no such thing in C.
    """
    if value is None and not given:
        return NOTHING
    if isinstance(value, FunctionType):
        return Function(value)
    if isinstance(value, bool | np.bool_):
        return FLAG if given else Flag(bool(value))
    if isinstance(value, int | np.integer):
        return (Int(0) if value >= 0 else Int()) if given else exactly(int(value))
    if isinstance(value, float | np.floating):
        return REAL
    if isinstance(value, np.ndarray):
        return _array(value)
    if isinstance(value, tuple):
        names = getattr(value, "_fields", None) or [f"f{i}" for i in range(len(value))]
        fields = tuple((name, kind_of(item, given=False)) for name, item in zip(names, value, strict=True))
        return (
            Record(type(value).__name__, fields, type(value)) if hasattr(value, "_fields") else Record("Tuple", fields)
        )
    if isinstance(value, MethodType):
        raise Untranslatable(f"{value.__qualname__} is a method; write a def outside the class")
    raise Untranslatable(f"{value!r:.60} is a {type(value).__name__}, for which there is nothing in C")


def _array(value: np.ndarray[Any, Any]) -> Array:
    item = ITEMS.get(value.dtype.kind) or (f"int{8 * value.dtype.itemsize}_t" if value.dtype.kind == "i" else None)
    if item is None or value.ndim == 0 or not value.flags.c_contiguous:
        raise Untranslatable(f"an array of {value.dtype}, shape {value.shape}, whose rows lie side by side, is needed")
    rows = None if len(value) > LONG else len(value)
    return Array(item, (rows, *value.shape[1:]), value.shape[1:])


def lasts(kind: Kind) -> bool:
    """Whether anything of it is left in the program."""
    match kind:
        case Record(fields=fields):
            return any(lasts(field) for _, field in fields)
        case Int() | Flag():
            return kind.known is None
        case Real() | Array():
            return True
        case _:
            return False


def parameter_of(kind: Kind) -> Kind:
    """The kind for which a function is translated that is called with such an argument: no version for each bound."""
    if isinstance(kind, Int) and kind.known is None:
        return Int(0) if kind.counts else Int()
    return kind


def variable_of(kind: Kind) -> Kind:
    """The kind of a variable that is given such a value, and others later."""
    match kind:
        case Int():
            return (Int(0) if kind.counts else Int()) if kind.fits else REAL
        case Flag():
            return FLAG
        case _:
            return kind
