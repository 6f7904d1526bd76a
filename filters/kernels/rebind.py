"""Clone a function with everything that it calls replaced: one source, several ways to run it.

    def update(...): gain(...)          rebind(update, jit)  ->  jit(update'), in which `gain` is jit(gain')

The source stays undecorated, so that the same lines can be read, run, counted on special scalars and compiled.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import CellType, CodeType, FunctionType
from typing import Any

Wrap = Callable[[FunctionType, FunctionType], Any]


def named_values(function: FunctionType) -> dict[str, Any]:
    """What the names in `function` stand for that come from its module's globals or from its closure."""
    names = _names(function.__code__)
    return {
        **{name: function.__globals__[name] for name in names if name in function.__globals__},
        **dict(_closure(function)),
    }


def callees(function: FunctionType) -> dict[str, FunctionType]:
    """The plain functions among its `named_values`."""
    return {name: value for name, value in named_values(function).items() if isinstance(value, FunctionType)}


def rebind(function: FunctionType, wrap: Wrap, versions: dict[FunctionType, Any]) -> Any:
    """A clone of `function` that calls clones of what it called, and so on down; recursive functions are handled.

    wrap(clone, original) gives the version that callers get to see.
    versions: those known before, used as they are; the new ones are added, so that a function is cloned once.
    The originals and their modules are not touched.
    """
    if function in versions:
        return versions[function]

    names = dict(function.__globals__)
    cells = {name: CellType(value) for name, value in _closure(function)}
    closure = tuple(cells[name] for name in function.__code__.co_freevars)
    clone = FunctionType(function.__code__, names, function.__name__, function.__defaults__, closure)
    clone.__kwdefaults__ = function.__kwdefaults__
    clone.__qualname__ = function.__qualname__
    clone.__module__ = function.__module__
    clone.__doc__ = function.__doc__
    versions[function] = version = wrap(clone, function)  # known before descending: a function may call itself

    for name, callee in callees(function).items():
        bound = rebind(callee, wrap, versions)
        if name in cells:
            cells[name].cell_contents = bound
        else:
            names[name] = bound
    return version


def _closure(function: FunctionType) -> Iterator[tuple[str, Any]]:
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        yield name, cell.cell_contents


def _names(code: CodeType) -> Iterator[str]:
    """The global names in a code object and in those nested in it (comprehensions, lambdas)."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)
