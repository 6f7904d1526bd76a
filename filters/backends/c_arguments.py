"""Arguments of Python as C takes them: arrays by their address, records as structures of addresses."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from functools import cache
from types import FunctionType
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from filters.translation.kinds import Array, Flag, Int, Kind, Nothing, Real, Record, kind_of, lasts
from filters.translation.names import c_name
from filters.translation.origins import Path
from filters.translation.overlaps import Pair
from filters.translation.refusal import Untranslatable

Span: TypeAlias = tuple[int, int]


class Argument(NamedTuple):
    """value: in Python. number: of its kind. passed: in C. arrays: by address. spans: where each begins and ends."""

    value: Any
    number: int
    passed: tuple[Any, ...]
    arrays: dict[int, np.ndarray[Any, Any]]
    spans: list[Span]


def argument(value: Any) -> Argument:
    """Raises Untranslatable if there is no such thing in C."""
    if isinstance(value, np.ndarray):
        return _array(value)
    if isinstance(value, tuple | FunctionType):
        return _LASTING.get(id(value)) or _lasting(value)
    if isinstance(value, int) and value >= 0 and value is not True and value is not False:
        return Argument(value, _COUNTING, (value,), {}, [])
    kind = kind_of(value)
    number = {Real: float, Flag: bool}.get(type(kind), int)(value)
    return Argument(value, number_of(kind), (number,), {}, [])


def number_of(kind: Kind) -> int:
    """A number for a kind, since to compare kinds of records takes longer than a step of a filter."""
    return _NUMBERS.setdefault(kind, len(_NUMBERS))


_NUMBERS: dict[Kind, int] = {}
_COUNTING = number_of(Int(0))
_ARRAYS: dict[tuple[Any, ...], tuple[int, bool]] = {}

_LASTING: dict[int, Argument] = {}
"""By the identity of the value, which is its own while it is held here."""

_MOST, _LARGE = 128, 1 << 20
"""How many are held, and how many bytes are too many for one."""


def _array(value: np.ndarray[Any, Any]) -> Argument:
    key = value.dtype, value.shape, value.flags.c_contiguous
    known = _ARRAYS.get(key)
    if known is None:
        kind = kind_of(value)
        assert isinstance(kind, Array)
        if value.dtype != dtype_of(kind):
            raise Untranslatable(f"an array of {value.dtype}; backend='c' takes float64")
        known = _ARRAYS[key] = number_of(kind), kind.is_long
    number, is_long = known
    address = value.__array_interface__["data"][0]
    passed = (address, len(value)) if is_long else (address,)
    return Argument(value, number, passed, {address: value}, [(address, address + value.nbytes)])


def _lasting(value: Any) -> Argument:
    """Of what never changes; kept, as a step of a filter takes less time than to look at all that it is given."""
    kind = kind_of(value)
    found = list(_arrays(value, ()))
    passed = (ctypes.byref(_structure(value, kind)),) if isinstance(kind, Record) and lasts(kind) else ()
    arrays = {array.ctypes.data: array for array, _ in found}
    spans = [_span(array) for array, _ in found]
    prepared = Argument(value, number_of(kind), passed, arrays, spans)
    if sum(end - start for start, end in spans) < _LARGE:
        if len(_LASTING) >= _MOST:
            _LASTING.clear()
        _LASTING[id(value)] = prepared
    return prepared


def share_memory(arguments: Sequence[Argument]) -> bool:
    """Whether any of their arrays overlap."""
    spans = [span for each in arguments for span in each.spans]
    spans.sort()
    reached = 0
    for start, end in spans:
        if start < reached:
            return True
        reached = end
    return False


def overlapping(names: Sequence[str], values: Sequence[Any]) -> frozenset[Pair]:
    """Which arrays among arguments of these parameters do."""
    named = zip(names, values, strict=True)
    found = [pair for name, value in named for pair in _arrays(value, (c_name(name),))]
    spans = sorted((_span(array), path) for array, path in found)
    pairs: set[Pair] = set()
    for index, ((_, end), path) in enumerate(spans):
        for (start, _), other in spans[index + 1 :]:
            if start >= end:
                break
            pairs.add(frozenset((path, other)))
    return frozenset(pairs)


def _arrays(value: Any, path: Path) -> Iterator[tuple[np.ndarray[Any, Any], Path]]:
    if isinstance(value, np.ndarray):
        yield value, path
    elif isinstance(value, tuple):
        names = getattr(value, "_fields", None) or [f"f{i}" for i in range(len(value))]
        for name, item in zip(names, value, strict=True):
            yield from _arrays(item, (*path, name))


def _span(array: np.ndarray[Any, Any]) -> Span:
    return array.ctypes.data, array.ctypes.data + array.nbytes


def _structure(value: Any, kind: Record) -> ctypes.Structure:
    structure = _structure_type(kind)()
    for item, (name, part) in zip(value, kind.fields, strict=True):
        if not lasts(part):
            continue
        if isinstance(part, Array):
            setattr(structure, c_name(name), item.ctypes.data)
            if part.is_long:
                setattr(structure, f"{c_name(name)}_rows", len(item))
        else:
            setattr(structure, c_name(name), _structure(item, part) if isinstance(part, Record) else item)
    return structure


@cache
def _structure_type(kind: Record) -> type[ctypes.Structure]:
    fields: list[tuple[str, Any]] = []
    for name, part in kind.fields:
        if lasts(part):
            fields.append((c_name(name), type_of(part)))
            if isinstance(part, Array) and part.is_long:
                fields.append((f"{c_name(name)}_rows", ctypes.c_int))
    return type(kind.name, (ctypes.Structure,), {"_fields_": fields})


def type_of(kind: Kind) -> Any:
    """The type of a field, or of a result."""
    match kind:
        case Array():
            return ctypes.c_void_p
        case Record():
            return _structure_type(kind)
        case Real():
            return ctypes.c_double
        case Flag():
            return ctypes.c_bool
        case Nothing():
            return None
    return ctypes.c_int


def types_passed(kind: Kind) -> list[Any]:
    """The types of what is passed for a parameter."""
    if isinstance(kind, Array) and kind.is_long:
        return [ctypes.c_void_p, ctypes.c_int]
    return [ctypes.c_void_p if isinstance(kind, Record) else type_of(kind)]


def result_of(found: Any, kind: Kind, given: Sequence[Argument]) -> Any:
    """What a function returned, in Python; arrays and records that it was given, as they are.

    Raises:
        ValueError: it is an array of a number of rows that is not known.
    """
    match kind:
        case Array():
            return _array_at(found, kind, given)
        case Record():
            return _record(found, kind, given)
    return found


def _record(found: Any, kind: Record, given: Sequence[Argument]) -> Any:
    items = []
    for name, part in kind.fields:
        if lasts(part):
            items.append(result_of(getattr(found, c_name(name)), part, given))
        else:
            assert isinstance(part, Int | Flag)
            items.append(part.known)
    for each in given:
        if type(each.value) is kind.made_by and all(item is own for item, own in zip(items, each.value, strict=True)):
            return each.value
    return kind.made_by(*items)


def _array_at(address: int, kind: Array, given: Sequence[Argument]) -> np.ndarray[Any, Any]:
    for each in given:
        array = each.arrays.get(address)
        if array is not None and array.shape == kind.shape and array.dtype == dtype_of(kind):
            return array
    if None in kind.shape:
        raise ValueError("a function that returns an array of so many rows cannot be run as C")
    shape = [length or 0 for length in kind.shape]
    size = int(np.prod(shape)) * np.dtype(dtype_of(kind)).itemsize
    return np.frombuffer(ctypes.string_at(address, size), dtype_of(kind)).reshape(shape).copy()


def dtype_of(kind: Array) -> str:
    """As NumPy calls it."""
    return {"real": "float64", "bool": "bool"}.get(kind.item, kind.item.removesuffix("_t"))
