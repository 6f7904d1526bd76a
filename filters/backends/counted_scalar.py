"""A number that counts what is done with it."""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NoReturn, TypeAlias

import numpy as np


@dataclass(slots=True)
class Tally:
    """What the scalars of one count have done so far."""

    multiply: int = 0
    add: int = 0
    divide: int = 0
    sqrt: int = 0
    function: int = 0


class UncountedError(TypeError):
    """What would go on without being counted."""


Operand: TypeAlias = "Scalar | float"


def plain(value: Any) -> Any:
    """What a scalar holds; anything else as it is."""
    return value.value if isinstance(value, Scalar) else value


def _number(value: Any) -> float:
    return value.value if isinstance(value, Scalar) else float(value)


def _each(operation: Callable[[Scalar, Any], Any], dtype: type = object) -> Callable[[Scalar, Any], Any]:
    """Entry by entry, where the other side is an array: NumPy leaves that to the scalar, see its priority."""

    def either(self: Scalar, other: Any) -> Any:
        if not isinstance(other, np.ndarray):
            return operation(self, other)
        results: Any = np.empty(other.shape, dtype=dtype)
        for index in np.ndindex(other.shape):
            results[index] = operation(self, other[index])
        return results

    return either


def _compared(comparison: Callable[[Any, Any], bool]) -> Callable[[Scalar, Any], Any]:
    def holds(self: Scalar, other: Any) -> bool:
        return comparison(self.value, _number(other))

    return _each(holds, dtype=bool)


class Scalar:
    """A float that counts, in a tally shared with others, what is done with it.

    Rounding to a whole number costs nothing, as comparison does. It becomes no plain float: what is done with that
    would not be counted.
    """

    __array_priority__ = 1000.0
    __slots__ = ("tally", "value")

    def __init__(self, value: float, tally: Tally) -> None:
        self.value = value
        self.tally = tally

    def __float__(self) -> NoReturn:
        raise UncountedError("it makes a plain float of a number that is counted")

    def __int__(self) -> NoReturn:
        raise UncountedError("it makes a plain whole number of a number that is counted")

    def __bool__(self) -> bool:
        return self.value != 0.0

    def __repr__(self) -> str:
        return f"Scalar({self.value!r})"

    def __str__(self) -> str:
        return str(self.value)

    def __format__(self, specification: str) -> str:
        return format(self.value, specification)

    @_each
    def __add__(self, other: Operand) -> Scalar:
        self.tally.add += 1
        return Scalar(self.value + _number(other), self.tally)

    __radd__ = __add__

    @_each
    def __sub__(self, other: Operand) -> Scalar:
        self.tally.add += 1
        return Scalar(self.value - _number(other), self.tally)

    @_each
    def __rsub__(self, other: Operand) -> Scalar:
        self.tally.add += 1
        return Scalar(_number(other) - self.value, self.tally)

    @_each
    def __mul__(self, other: Operand) -> Scalar:
        self.tally.multiply += 1
        return Scalar(self.value * _number(other), self.tally)

    __rmul__ = __mul__

    @_each
    def __truediv__(self, other: Operand) -> Scalar:
        self.tally.divide += 1
        return Scalar(_hardware(operator.truediv, self.value, other), self.tally)

    @_each
    def __rtruediv__(self, other: Operand) -> Scalar:
        self.tally.divide += 1
        return Scalar(_hardware(operator.truediv, other, self.value), self.tally)

    @_each
    def __floordiv__(self, other: Operand) -> Scalar:
        self.tally.divide += 1
        return Scalar(_hardware(operator.floordiv, self.value, other), self.tally)

    @_each
    def __rfloordiv__(self, other: Operand) -> Scalar:
        self.tally.divide += 1
        return Scalar(_hardware(operator.floordiv, other, self.value), self.tally)

    @_each
    def __mod__(self, other: Operand) -> Scalar:
        return self._remainder(self.value, other)

    @_each
    def __rmod__(self, other: Operand) -> Scalar:
        return self._remainder(other, self.value)

    def _remainder(self, a: Operand, b: Operand) -> Scalar:
        """a - b floor(a / b): a divide, a multiply and an add."""
        self.tally.divide += 1
        self.tally.multiply += 1
        self.tally.add += 1
        return Scalar(_hardware(operator.mod, a, b), self.tally)

    @_each
    def __pow__(self, exponent: Operand) -> Scalar:
        """A square is one multiply; any other power is a function."""
        if exponent == 2:
            self.tally.multiply += 1
        else:
            self.tally.function += 1
        return Scalar(_hardware(operator.pow, self.value, exponent), self.tally)

    @_each
    def __rpow__(self, base: Operand) -> Scalar:
        self.tally.function += 1
        return Scalar(_hardware(operator.pow, base, self.value), self.tally)

    def __neg__(self) -> Scalar:
        return Scalar(-self.value, self.tally)

    def __pos__(self) -> Scalar:
        return self

    def __abs__(self) -> Scalar:
        return Scalar(abs(self.value), self.tally)

    def __round__(self) -> Scalar:
        return Scalar(float(np.rint(self.value)), self.tally)

    def __floor__(self) -> Scalar:
        return Scalar(float(np.floor(self.value)), self.tally)

    def __ceil__(self) -> Scalar:
        return Scalar(float(np.ceil(self.value)), self.tally)

    __lt__ = _compared(operator.lt)
    __le__ = _compared(operator.le)
    __gt__ = _compared(operator.gt)
    __ge__ = _compared(operator.ge)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scalar | float | int | np.number) and self.value == plain(other)

    def __hash__(self) -> int:
        return hash(self.value)

    def conjugate(self) -> Scalar:
        """What np.conj calls on an object."""
        return self


def _hardware(operation: Callable[[Any, Any], Any], a: Operand, b: Operand) -> float:
    """The result of floating-point hardware: inf or nan where Python has an exception, or a complex number."""
    with np.errstate(all="ignore"):
        return float(operation(np.float64(_number(a)), np.float64(_number(b))))
