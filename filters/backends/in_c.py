"""Run kernels and jobs as C: translated, compiled by the C compiler of the machine, and loaded.

A model of the user's is ready in a second, where numba takes ten. The numbers are those of the other backends to the
last bit, for the compiler may neither reorder nor fuse operations. Shared objects are kept in the user's cache folder
under the digest of what they were made from.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from itertools import count
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from filters.backends.disk_cache import cache_folder
from filters.translation.kinds import Array, Flag, Int, Kind, Nothing, Real, Record, kind_of, lasts
from filters.translation.names import c_name
from filters.translation.origins import Path as Origin
from filters.translation.overlaps import Pair
from filters.translation.prototype import declared, passed
from filters.translation.translated import Translated
from filters.translation.unit import Unit

FLAGS = ("-std=c99", "-O3", "-march=native", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared")
_FAULT = """static const char *fault;
#define FAULT(message) (fault = (message))
"""
_LOOP = """
void repeat_job({declared})
{{
    for (int round = 0; round < times; round++) {{
        {name}({passed});
        __asm__ volatile("" ::: "memory");
    }}
}}
"""
_TAKE_FAULT = """
const char *take_fault(void)
{
    const char *const found = fault;
    fault = 0;
    return found;
}
"""


def in_c(function: FunctionType) -> InC:
    """The version of a plain function that runs as C, translated and compiled for each new kind of arguments."""
    return InC(function)


def compiler() -> str:
    """The C compiler: $CC, cc or gcc. Raises ValueError if there is none."""
    for name in (os.environ.get("CC", ""), "cc", "gcc", "clang"):
        if name and (path := shutil.which(name)):
            return path
    raise ValueError("backend='c' needs a C compiler: install gcc or clang, name one in CC, or use backend='compiled'")


@cache
def compiler_version() -> str:
    """The first line of what the compiler says of itself."""
    done = subprocess.run([compiler(), "--version"], capture_output=True, text=True, check=False)
    return done.stdout.partition("\n")[0]


class InC:
    def __init__(self, function: FunctionType) -> None:
        self._function = function
        self.__name__ = function.__name__

    def __call__(self, *arguments: Any) -> Any:
        return self._for(arguments)(arguments)

    def loop(self, *arguments: Any) -> Callable[[int], None]:
        """A function that runs it so many times in one call."""
        return self._for(arguments).loop(arguments)

    def _for(self, arguments: tuple[Any, ...]) -> _Loaded:
        names = self._function.__code__.co_varnames
        given = [(c_name(name), argument) for name, argument in zip(names, arguments, strict=False)]
        kinds = tuple(kind_of(argument) for argument in arguments)
        return _loaded(self._function, kinds, overlapping(given))


def overlapping(arguments: Iterable[tuple[str, Any]]) -> frozenset[Pair]:
    """Which arrays among arguments of these names share memory."""
    spans = sorted(span for name, value in arguments for span in _spans(value, (name,)))
    pairs: set[Pair] = set()
    for index, (_, end, path) in enumerate(spans):
        for start, _, other in spans[index + 1 :]:
            if start >= end:
                break
            pairs.add(frozenset((path, other)))
    return frozenset(pairs)


def _spans(value: Any, path: Origin) -> Iterator[tuple[int, int, Origin]]:
    """Where each array in it begins and ends."""
    if isinstance(value, np.ndarray):
        start = value.ctypes.data
        yield start, start + value.nbytes, path
    elif isinstance(value, tuple):
        for name, item in zip(getattr(value, "_fields", None) or map("f{}".format, count()), value, strict=False):
            yield from _spans(item, (*path, name))


@cache
def _loaded(function: FunctionType, kinds: tuple[Kind, ...], pairs: frozenset[Pair]) -> _Loaded:
    unit = Unit(public=frozenset({function}), overlapping=pairs)
    translated = unit.function(function, kinds)
    head = ", ".join([*declared(translated, unit.record_name), "int times"])
    loop = _LOOP.format(declared=head, name=translated.name, passed=", ".join(passed(translated)))
    source = _FAULT + unit.header("FILTER_H") + unit.source("").partition("\n")[2] + _TAKE_FAULT + loop
    return _Loaded(translated, _library(source))


class _Loaded:
    """A translated function in a shared object."""

    def __init__(self, translated: Translated, library: ctypes.CDLL) -> None:
        self._kinds = dict(zip(translated.parameters, translated.kinds, strict=True))
        self._translated = translated
        self._function = getattr(library, translated.name)
        self._function.restype = _result_type(translated.result)
        self._loop = library.repeat_job
        self._loop.restype = None
        self._take_fault = library.take_fault
        self._take_fault.restype = ctypes.c_char_p

    def __call__(self, arguments: tuple[Any, ...]) -> Any:
        passed, _memory = self._passed(arguments)
        result = self._function(*passed)
        message = self._take_fault()
        if message is not None:
            raise ValueError(message.decode())
        return _returned(result, self._translated.result)

    def loop(self, arguments: tuple[Any, ...]) -> Callable[[int], None]:
        passed, memory = self._passed(arguments)

        def loop(times: int, _kept: Any = (arguments, memory)) -> None:
            self._loop(*passed, times)

        return loop

    def _passed(self, arguments: tuple[Any, ...]) -> tuple[list[Any], list[np.ndarray[Any, Any]]]:
        """What the function is given, and memory that it needs as long as it runs."""
        translated = self._translated
        given = dict(zip(translated.parameters, arguments, strict=True))
        memory = [np.empty([length or 0 for length in kind.shape], _dtype(kind)) for kind in translated.memory.values()]
        passed = [part for name in translated.used for part in _passed(given[name], self._kinds[name])]
        return [*passed, *(ctypes.c_void_p(array.ctypes.data) for array in memory)], memory


def _passed(value: Any, kind: Kind) -> list[Any]:
    match kind:
        case Array():
            pointer = ctypes.c_void_p(value.ctypes.data)
            return [pointer, ctypes.c_int(len(value))] if kind.is_long else [pointer]
        case Record():
            return [ctypes.byref(_structure(value, kind))]
        case Real():
            return [ctypes.c_double(value)]
        case Flag():
            return [ctypes.c_bool(value)]
    return [ctypes.c_int(value)]


@cache
def _structure_type(kind: Record) -> type[ctypes.Structure]:
    fields: list[tuple[str, Any]] = []
    for name, part in kind.fields:
        if lasts(part):
            fields.append((c_name(name), _field_type(part)))
            if isinstance(part, Array) and part.is_long:
                fields.append((f"{c_name(name)}_rows", ctypes.c_int))
    return type(kind.name, (ctypes.Structure,), {"_fields_": fields})


def _field_type(kind: Kind) -> Any:
    match kind:
        case Array():
            return ctypes.c_void_p
        case Record():
            return _structure_type(kind)
        case Real():
            return ctypes.c_double
        case Flag():
            return ctypes.c_bool
    return ctypes.c_int


def _result_type(kind: Kind) -> Any:
    return None if isinstance(kind, Nothing) else _field_type(kind)


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


def _dtype(kind: Array) -> str:
    return {"real": "float64", "bool": "bool"}.get(kind.item, kind.item.removesuffix("_t"))


def _returned(result: Any, kind: Kind) -> Any:
    match kind:
        case Array(shape=shape):
            if None in shape:
                raise ValueError("a function that returns an array of so many rows cannot be run as C")
            size = int(np.prod([length or 0 for length in shape])) * np.dtype(_dtype(kind)).itemsize
            return np.frombuffer(ctypes.string_at(result, size), _dtype(kind)).reshape([n or 0 for n in shape]).copy()
        case Record(fields=fields, made_by=made_by):
            items = []
            for name, part in fields:
                if lasts(part):
                    items.append(_returned(getattr(result, c_name(name)), part))
                else:
                    assert isinstance(part, Int | Flag)
                    items.append(part.known)
            return made_by(*items)
    return result


@cache
def _library(source: str) -> ctypes.CDLL:
    path = compiler()
    digest = hashlib.sha256(repr((source, FLAGS, compiler_version(), os.uname().machine)).encode()).hexdigest()[:40]
    folder = cache_folder()
    with tempfile.TemporaryDirectory() as scratch:
        kept = (folder.parent / "c" if folder else Path(scratch)) / f"{digest}.so"
        if not kept.exists():
            kept.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            written, built = Path(scratch) / "filter.c", Path(scratch) / "filter.so"
            written.write_text(source)
            done = subprocess.run(
                [path, *FLAGS, "-o", built, written, "-lm"], capture_output=True, text=True, check=False
            )
            if done.returncode:
                raise ValueError(f"backend='c': {path} cannot compile what was made of the filter: {done.stderr[:400]}")
            shutil.copy(built, kept.with_suffix(f".{os.getpid()}"))
            kept.with_suffix(f".{os.getpid()}").replace(kept)
        return ctypes.CDLL(str(kept))
