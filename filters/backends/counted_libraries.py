"""What a counted function sees in place of NumPy, `math` and `float`.

Arrays that it makes hold objects, so that numbers that count stay such when they are written there. What is computed
of constants alone is not counted, whatever computes it; of numbers that count, what NumPy does with their operators.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from filters.backends.bind import like
from filters.backends.counted_functions import OF_MATH, elementwise
from filters.backends.counted_scalar import Scalar, UncountedError
from filters.backends.dependencies import is_of_library
from filters.backends.installed import is_installed


class _FloatType(type):
    def __instancecheck__(cls, value: Any) -> bool:
        return isinstance(value, float | Scalar)


class Float(float, metaclass=_FloatType):
    """`float`, which leaves what counts as it is. NumPy takes it for the type of objects."""

    def __new__(cls, value: Any = 0.0) -> Any:
        if isinstance(value, np.ndarray):
            return value.item() if value.size == 1 else value.astype(object)
        return value if isinstance(value, Scalar) else float(value)


def _import(*arguments: Any) -> Any:
    module = __import__(*arguments)
    return _Module(module) if is_of_library(module) else module


BUILTINS = {"float": Float, "__import__": _import}
_FLOATS = (float, np.float64, np.float32, np.longdouble)


def counted_version(value: Any) -> Any:
    """What stands for a value that is no function of the user's or of this project."""
    if type(value) is np.ndarray:
        return holding(value)
    if isinstance(value, ModuleType):
        return _Module(value) if is_of_library(value) else value
    if isinstance(value, np.ufunc):
        return elementwise(value) or _Function(value)
    if isinstance(value, type):
        return Float if value in _FLOATS else _Function(value) if value in (np.dtype, np.finfo) else value
    if not callable(value):
        return value
    if getattr(value, "__module__", None) == math.__name__:
        return OF_MATH.get(value, value)
    return _Function(value) if _makes_arrays(value) else value


def holding(value: Any) -> Any:
    """With every array of floats, also in tuples and lists, as one of objects, which can hold numbers that count."""
    if type(value) is np.ndarray and np.issubdtype(value.dtype, np.floating):
        objects = np.empty(value.shape, dtype=object)
        for index in np.ndindex(value.shape):
            objects[index] = value[index]
        objects.flags.writeable = value.flags.writeable
        return objects
    if isinstance(value, tuple):
        return like(value, [holding(item) for item in value])
    return [holding(item) for item in value] if type(value) is list else value


class _Module(ModuleType):
    """A library's module, with what stands for its members."""

    def __init__(self, module: ModuleType) -> None:
        super().__init__(module.__name__)
        self.__dict__["__wrapped__"] = module

    def __getattr__(self, name: str) -> Any:
        return counted_version(getattr(self.__dict__["__wrapped__"], name))


class _Function:
    """A library's function, whose arrays can hold numbers that count.

    What it does with such numbers is counted as far as it uses their operators. Where it does not, it fails: it cannot
    make plain floats of them.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function

    def __getattr__(self, name: str) -> Any:
        attribute = getattr(self._function, name)
        return _Function(attribute) if callable(attribute) else attribute

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        counting = _counts(arguments) or _counts(options)
        kind = object if counting else np.float64
        arguments = tuple(kind if argument is Float else argument for argument in arguments)
        options = {name: kind if _is_float_type(name, option) else option for name, option in options.items()}
        try:
            return holding(self._function(*arguments, **options))
        except Exception as error:
            if counting:
                raise UncountedError("it does not work with numbers that are counted") from error
        return holding(self._function(*_plain(arguments), **_plain(options)))


def _is_float_type(name: str, option: Any) -> bool:
    return option is Float or (name == "dtype" and option is not None and np.issubdtype(option, np.floating))


def _counts(value: Any) -> bool:
    if isinstance(value, np.ndarray):
        return value.dtype == object and any(isinstance(item, Scalar) for item in value.flat)
    if isinstance(value, dict):
        return any(map(_counts, value.values()))
    return isinstance(value, Scalar) or (isinstance(value, tuple | list) and any(map(_counts, value)))


def _plain(value: Any) -> Any:
    """With every array of objects as one of floats."""
    if type(value) is np.ndarray and value.dtype == object:
        return value.astype(np.float64)
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, tuple):
        return like(value, [_plain(item) for item in value])
    return [_plain(item) for item in value] if type(value) is list else value


def _makes_arrays(function: Any) -> bool:
    """Whether it is of an installed library other than Python's own."""
    package = str(getattr(function, "__module__", None)).partition(".")[0]
    if package not in sys.modules or package in sys.stdlib_module_names:
        return False
    if isinstance(function, FunctionType):
        return is_installed(function.__code__.co_filename)
    return package == np.__name__ or is_installed(str(getattr(sys.modules[package], "__file__", None)))
