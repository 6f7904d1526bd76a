"""What the machine code of a function depends on: its byte code, all values that it names, what its module says of how
it is compiled, and the same of its callees.

numba writes every constant that a function can name into the machine code: globals, closures, default arguments, and
attributes of modules at any depth. All are taken by value. What cannot be (an object of an unknown class) is taken by
identity, which holds in this process only.
"""

from __future__ import annotations

import enum
import hashlib
import os
import sys
from collections.abc import Iterator
from functools import cache
from operator import attrgetter
from types import CodeType, EllipsisType, FunctionType, ModuleType, NoneType
from typing import Any, NamedTuple

import numpy as np

from filters.backends.installed import is_foreign
from filters.backends.said import NAMES, says

# What comes from these is known by its name and the library's version; numba has its own code for it.
_LIBRARIES = frozenset({*sys.stdlib_module_names, "numba", "numpy"})
_LIBRARY_FOLDERS = tuple(
    os.path.join(os.path.dirname(os.path.abspath(file)), "") for file in (os.__file__, os.path.dirname(np.__file__))
)

_PLAIN = (NoneType, EllipsisType, bool, int, float, complex, str, bytes)


class Dependencies(NamedTuple):
    """digest: of all values, equal in every process if nothing is opaque. opaque: what is known by identity only."""

    digest: str
    opaque: tuple[Any, ...]


def dependencies(function: FunctionType) -> Dependencies:
    """What a plain function depends on now; constants may have been changed by the next call."""
    walk = _Walk()
    walk.function(function)
    return Dependencies(walk.hash.hexdigest(), tuple(walk.opaque))


def named_values(function: FunctionType) -> dict[str, Any]:
    """What the names in `function` stand for that come from its module's globals or from its closure."""
    values = function.__globals__
    names = {name: values[name] for name in _names(function.__code__) if name in values}
    return names | dict(_closure(function))


def named_attributes(module: ModuleType, function: FunctionType) -> dict[str, Any]:
    """What the names in `function`, and its strings (of getattr), stand for if they are attributes of this module."""
    absent = object()
    strings = [item for code in _nested(function.__code__) for item in code.co_consts if isinstance(item, str)]
    values = {name: getattr(module, name, absent) for name in sorted({*_names(function.__code__), *strings})}
    return {name: value for name, value in values.items() if value is not absent}


def is_of_library(value: Any) -> bool:
    """Whether numba knows a module, function or class by itself: it is then neither cloned nor looked into."""
    if isinstance(value, ModuleType):
        return _is_library(value.__name__)
    module, name = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    if not (isinstance(module, str) and isinstance(name, str) and _is_library(module)):
        return False
    try:
        return attrgetter(name)(sys.modules[module]) is value
    except AttributeError:
        return False


def _is_library(module: str) -> bool:
    root = module.partition(".")[0]
    if root not in _LIBRARIES or root not in sys.modules:
        return False
    file = getattr(sys.modules[root], "__file__", None)
    return file is None or os.path.abspath(file).startswith(_LIBRARY_FOLDERS)  # not a user's file of the same name


def _closure(function: FunctionType) -> Iterator[tuple[str, Any]]:
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        try:
            yield name, cell.cell_contents
        except ValueError:  # not assigned yet
            continue


@cache
def _names(code: CodeType) -> tuple[str, ...]:
    """The names of globals and attributes in a code object and in those nested in it."""
    return tuple(sorted({name for part in _nested(code) for name in part.co_names}))


def _nested(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _nested(constant)


class _Walk:
    """Feeds a hash with values, each with its kind and length, and each function once."""

    def __init__(self) -> None:
        self.hash = hashlib.sha256()
        self.opaque: list[Any] = []
        self._functions: dict[FunctionType, int] = {}
        self._by_module: dict[str, tuple[bool, ...]] = {}
        self._function: FunctionType | None = None  # at hand, and the modules that it was seen to name
        self._modules: list[ModuleType] = []

    def function(self, function: FunctionType) -> None:
        if function in self._functions:
            self._put("function seen", self._functions[function])
            return
        self._functions[function] = len(self._functions)
        before = self._function, self._modules
        self._function, self._modules = function, []
        self._put("function", function.__module__, function.__qualname__)
        self._put(self._said(function.__module__))
        self._put(_code_digest(function.__code__))
        self._value(function.__defaults__)
        self._items(function.__kwdefaults__ or {})
        self._items(named_values(function))
        self._function, self._modules = before

    def _said(self, module: str) -> tuple[bool, ...]:
        if module not in self._by_module:
            self._by_module[module] = tuple(says(module, name) for name in NAMES)
        return self._by_module[module]

    def _value(self, value: Any) -> None:
        kind = type(value)
        if kind in _PLAIN:
            self._put(kind.__name__, hex(value) if kind is int else repr(value))  # repr has a limit of digits
        elif isinstance(value, FunctionType) and not (is_of_library(value) or is_foreign(value, self._function)):
            self.function(value)
        elif isinstance(value, CodeType):
            self._put(_code_digest(value))
        elif is_of_library(value):
            self._put("library", getattr(value, "__module__", ""), getattr(value, "__qualname__", value.__name__))
        elif isinstance(value, ModuleType):
            self._module(value)
        elif isinstance(value, enum.Enum):
            self._put("enum", kind.__module__, kind.__qualname__, value.name)
            self._value(value.value)
        elif isinstance(value, type) and issubclass(value, enum.Enum):
            self._put("enum class", value.__module__, value.__qualname__)
            self._items(value.__members__)
        elif isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields"):
            self._put("record class", value.__module__, value.__qualname__, *value._fields)
            self._items(vars(value)["_field_defaults"])
        elif kind is tuple or (isinstance(value, tuple) and hasattr(value, "_fields")):
            self._put("tuple", kind.__module__, kind.__qualname__, *getattr(value, "_fields", ()))
            self._put(len(value))
            for item in value:
                self._value(item)
        elif kind is frozenset and all(type(item) in _PLAIN for item in value):
            self._put("frozenset", *sorted(map(repr, value)))
        elif isinstance(value, np.dtype) and not value.hasobject:
            self._put("dtype", value.str, repr(value))
        elif (kind is np.ndarray or isinstance(value, np.generic)) and not value.dtype.hasobject:
            self._put(kind.__name__, value.dtype.str, repr(value.dtype), value.shape, value.strides)
            self._put(value.flags.writeable, value.tobytes())
        else:
            self._put("opaque", id(value))
            self.opaque.append(value)

    def _items(self, values: Any) -> None:
        self._put("items", len(values))
        for name, value in values.items():
            self._put(name)
            self._value(value)

    def _module(self, module: ModuleType) -> None:
        self._put("module", module.__name__)
        if self._function is not None and module not in self._modules:
            self._modules.append(module)
            self._items(named_attributes(module, self._function))

    def code(self, code: CodeType) -> None:
        self._put("code", code.co_code, code.co_exceptiontable, code.co_flags, code.co_argcount)
        self._put(code.co_posonlyargcount, code.co_kwonlyargcount)
        for names in (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars):
            self._put(len(names), *names)
        self._value(code.co_consts)

    def _put(self, *parts: object) -> None:
        for part in parts:
            data = part if isinstance(part, bytes) else str(part).encode(errors="surrogatepass")
            self.hash.update(len(data).to_bytes(8, "little") + data)


@cache  # code never changes
def _code_digest(code: CodeType) -> bytes:
    walk = _Walk()
    walk.code(code)
    return walk.hash.digest()
