"""Clone a function with everything that it calls replaced: one source, several ways to run it.

    def update(...): gain(...)          Versions(jit).of(update)  ->  jit(update'), in which `gain` is jit(gain')

The source stays undecorated, so that the same lines can be read, run, counted on special scalars and compiled.
"""

from __future__ import annotations

import builtins as python
from collections.abc import Callable, Mapping
from types import CellType, FunctionType, ModuleType
from typing import Any

import numpy as np

from filters.backends.bind import like
from filters.backends.dependencies import Dependencies, dependencies, is_of_library, named_attributes, named_values
from filters.backends.installed import is_foreign

Wrap = Callable[[FunctionType, FunctionType, Dependencies], Any]


class Versions:
    """The version of each function, made once for as long as what the function depends on stays as it is.

    wrap(clone, original, dependencies) gives the version that callers get to see.
    given: versions that are used as they are.
    parts: where the versions of callees come from, if not from here.
    outside(value): what callers see in place of any other value that they name, such as a library's function.
    builtins: what they see in place of Python's own functions of these names.
    """

    def __init__(
        self,
        wrap: Wrap,
        given: Mapping[FunctionType, Any] | None = None,
        parts: Versions | None = None,
        outside: Callable[[Any], Any] = lambda value: value,
        builtins: Mapping[str, Any] | None = None,
    ) -> None:
        self._wrap = wrap
        self._given = given or {}
        self._parts = parts or self
        self._outside = outside
        self._builtins = {"__builtins__": {**vars(python), **builtins}} if builtins else {}
        self._made: dict[str, tuple[Any, Dependencies]] = {}  # opaque values are kept alive: they are known by address

    def of(self, function: FunctionType) -> Any:
        """A clone of `function` that calls clones of what it called, and so on down; recursive functions are handled.

        The originals and their modules are not touched. A clone keeps the constants as they are now: modules that it
        names are copied, arrays too. Functions of other installed libraries are called as they are.
        """
        if function in self._given:
            return self._given[function]
        known = dependencies(function)
        if known.digest in self._made:
            return self._made[known.digest][0]

        names = {**function.__globals__, **self._builtins}
        cells = {name: CellType() for name in function.__code__.co_freevars}
        clone = FunctionType(function.__code__, names, function.__name__, closure=tuple(cells.values()))
        clone.__qualname__ = function.__qualname__
        clone.__module__ = function.__module__
        clone.__doc__ = function.__doc__
        snapshot = _Snapshot(function, self._parts.of, self._outside)
        clone.__defaults__ = function.__defaults__ and snapshot.of(function.__defaults__)
        clone.__kwdefaults__ = {name: snapshot.of(value) for name, value in (function.__kwdefaults__ or {}).items()}

        version = self._wrap(clone, function, known)
        self._made[known.digest] = version, known  # before descending: a function may call itself
        for name, value in named_values(function).items():
            bound = version if value is function else snapshot.of(value)
            if name in cells:
                cells[name].cell_contents = bound
            else:
                names[name] = bound
        return version


class _Snapshot:
    """Values that a function names, as nobody changes them any more, with version(f) for each plain function f."""

    def __init__(
        self, function: FunctionType, version: Callable[[FunctionType], Any], outside: Callable[[Any], Any]
    ) -> None:
        self._function = function
        self._version = version
        self._outside = outside
        self._modules: dict[ModuleType, ModuleType] = {}  # modules may name each other

    def of(self, value: Any) -> Any:
        if is_of_library(value):
            return self._outside(value)
        if isinstance(value, FunctionType) and not is_foreign(value, self._function):
            return self._version(value)
        if type(value) is tuple or (isinstance(value, tuple) and hasattr(value, "_fields")):
            return like(value, [self.of(item) for item in value])
        if type(value) is np.ndarray:
            copy = value.copy(order="K")
            copy.flags.writeable = value.flags.writeable
            return self._outside(copy)
        if isinstance(value, ModuleType):
            return self._module(value)
        return self._outside(value)

    def _module(self, module: ModuleType) -> ModuleType:
        if module not in self._modules:
            self._modules[module] = copy = ModuleType(module.__name__)
            for name, value in named_attributes(module, self._function).items():
                setattr(copy, name, self.of(value))
        return self._modules[module]
