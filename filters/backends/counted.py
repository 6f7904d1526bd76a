"""Count the arithmetic of a kernel exactly, by running it on scalars that count."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from types import FunctionType, MethodType
from typing import Any, NamedTuple

import numpy as np

from filters.backends.bind import like
from filters.backends.counted_libraries import BUILTINS, counted_version
from filters.backends.counted_scalar import Scalar, Tally
from filters.backends.rebind import Versions
from filters.backends.uncountable import uncountable


class Operations(NamedTuple):
    """Scalar floating-point operations. A subtraction is an add; negation, comparison and copying cost nothing."""

    multiply: int = 0
    add: int = 0
    divide: int = 0
    sqrt: int = 0
    function: int = 0  # sin, cos, exp, ...

    @property
    def total(self) -> int:
        """All operations, each counted once whatever its kind."""
        return sum(self)

    def __add__(self, other: Operations) -> Operations:  # type: ignore[override]  # a tuple's + would join the two
        """The sum, kind by kind."""
        return Operations(*(mine + theirs for mine, theirs in zip(self, other, strict=True)))


def count(function: Callable[..., Any], *arguments: Any) -> Operations:
    """The operations that function(*arguments) does. The arguments are copied, not changed.

    Floats and arrays in the arguments, also inside (named) tuples, become counting scalars; functions inside them
    (those of a system model) run on these, and arrays that they return are counting again. A model's arithmetic among
    its own constants is not counted.

    Raises:
        UncountableError: a function does with its numbers what cannot be counted; its line is named.
    """
    tally = Tally()
    try:
        _version(function)(*(_counting(argument, tally) for argument in arguments))
    except (TypeError, AttributeError) as error:
        raise uncountable(error, function) or error from error
    return Operations(tally.multiply, tally.add, tally.divide, tally.sqrt, tally.function)


def _version(function: Any) -> Any:
    """That runs on counting scalars."""
    if isinstance(function, FunctionType):
        return _VERSIONS.of(function)
    if isinstance(function, MethodType):
        return MethodType(_version(function.__func__), function.__self__)
    if isinstance(function, partial):
        return partial(_version(function.func), *function.args, **function.keywords)
    if _is_jitted(function):
        return _version(function.py_func)
    return counted_version(function)


def _is_jitted(value: Any) -> bool:
    """Whether it is a function that numba's decorator compiles; asked without an import of numba, which takes long."""
    return type(value).__module__.startswith("numba.") and isinstance(getattr(value, "py_func", None), FunctionType)


def _outside(value: Any) -> Any:
    return _version(value) if _is_jitted(value) else counted_version(value)


_VERSIONS = Versions(lambda clone, _original, _known: clone, outside=_outside, builtins=BUILTINS)


def _counting(value: Any, tally: Tally) -> Any:
    if isinstance(value, float):
        return Scalar(float(value), tally)
    if isinstance(value, np.ndarray):
        return _counting_array(value, tally)
    if isinstance(value, tuple):
        return like(value, [_counting(item, tally) for item in value])
    if callable(value) and not isinstance(value, type):
        return _counting_function(_version(value), tally)
    return value


def _counting_function(version: Callable[..., Any], tally: Tally) -> Callable[..., Any]:
    """Whose constants count from then on, in the array that it returns and in those that it was given to fill."""

    def counting(*arguments: Any) -> Any:
        result = version(*arguments)
        for argument in arguments:
            if isinstance(argument, np.ndarray) and argument.dtype == object:
                _count_entries(argument, tally)
        return _counting_array(result, tally) if isinstance(result, np.ndarray) else result

    return counting


def _count_entries(array: Any, tally: Tally) -> None:
    for index in np.ndindex(array.shape):
        if isinstance(array[index], int | float | np.number):
            array[index] = Scalar(float(array[index]), tally)


def _counting_array(array: Any, tally: Tally) -> Any:
    """An array of scalars with these values; entries that count already are kept, as is an array full of them."""
    if array.dtype != object and not np.issubdtype(array.dtype, np.floating):
        return array
    if array.dtype == object and all(isinstance(item, Scalar) for item in array.flat):
        return array
    scalars = np.empty(array.shape, dtype=object)
    for index in np.ndindex(array.shape):
        item = array[index]
        scalars[index] = item if isinstance(item, Scalar) else Scalar(float(item), tally)
    return scalars
