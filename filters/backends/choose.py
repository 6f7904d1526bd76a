"""The ways to run a filter, by name."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any, Literal, NamedTuple, TypeAlias

from filters.backends.bind import bind
from filters.backends.compiled import compiled, inlined
from filters.backends.in_c import in_c
from filters.backends.vectorised import vectorised
from filters.choice import check_choice

BackendName: TypeAlias = Literal["reference", "compiled", "numpy", "c"]


class Backend(NamedTuple):
    """function: the version of a function to call. argument: its version inside an argument of such a call."""

    function: Callable[[FunctionType], Any]
    argument: Callable[[FunctionType], Any]


def _as_written(function: FunctionType) -> Any:
    return function


BACKENDS: dict[BackendName, Backend] = {
    "reference": Backend(_as_written, _as_written),
    "compiled": Backend(compiled, inlined),
    "numpy": Backend(vectorised, vectorised),
    "c": Backend(in_c, _as_written),
}


def function_for(backend: BackendName, function: Callable[..., Any]) -> Any:
    """A kernel or job, to be called with arguments from `arguments_for` the same backend.

    Raises:
        ValueError: there is no backend of this name.
        TypeError: it is not a plain Python function.
    """
    if not isinstance(function, FunctionType):
        raise TypeError(f"{function!r} is not a plain Python function, and only such can be run by a backend")
    return _backend(backend).function(function)


def arguments_for(backend: BackendName, value: Any) -> Any:
    """An argument, or a tuple of them: functions in it, such as those of a system model, in their right version.

    Raises:
        ValueError: there is no backend of this name.
    """
    return bind(value, _backend(backend).argument)


def _backend(name: BackendName) -> Backend:
    check_choice("backend", name, BACKENDS)
    return BACKENDS[name]
