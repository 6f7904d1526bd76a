"""The ways to run a filter, by name."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any, Literal, TypeAlias

from filters.kernels.bind import bind
from filters.kernels.compiled import compiled
from filters.kernels.vectorised import vectorised

BackendName: TypeAlias = Literal["reference", "compiled", "numpy"]

BACKENDS: dict[BackendName, Callable[[FunctionType], Any]] = {
    "reference": lambda function: function,  # the loops as they are written
    "compiled": compiled,
    "numpy": vectorised,
}


def bind_to(backend: BackendName, value: Any) -> Any:
    """A function, or a (named) tuple with functions in it such as a system model, in its version for a backend.

    Raises:
        ValueError: there is no backend of this name.
    """
    if backend not in BACKENDS:
        raise ValueError(f"backend {backend!r} is unknown; give one of {', '.join(BACKENDS)}")
    return bind(value, BACKENDS[backend])
