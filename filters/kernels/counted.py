"""Count the arithmetic of a kernel exactly, by running it on scalars that count."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import FunctionType
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from filters.kernels.bind import like


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
    its own literal constants is not seen, nor are functions of `math`: write np.sin, not math.sin.
    """
    tally = Tally()
    function(*(_counting(argument, tally) for argument in arguments))
    return Operations(tally.multiply, tally.add, tally.divide, tally.sqrt, tally.function)


@dataclass(slots=True)
class Tally:
    """What the scalars of one count have done so far."""

    multiply: int = 0
    add: int = 0
    divide: int = 0
    sqrt: int = 0
    function: int = 0


Operand: TypeAlias = "Scalar | float"


def _each(operator: Callable[[Scalar, Any], Scalar]) -> Callable[[Scalar, Any], Any]:
    """The operator, with an array on the other side entry by entry: NumPy leaves it to the scalar, see its priority."""

    def either(self: Scalar, other: Any) -> Any:
        if not isinstance(other, np.ndarray):
            return operator(self, other)
        results = np.empty(other.shape, dtype=object)
        for index in np.ndindex(other.shape):
            results[index] = operator(self, other[index])
        return results

    return either


class Scalar:
    """A float that counts, in a tally shared with others, what is done with it."""

    __array_priority__ = 1000.0
    __slots__ = ("tally", "value")

    def __init__(self, value: float, tally: Tally) -> None:
        self.value = value
        self.tally = tally

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        return f"Scalar({self.value!r})"

    @_each
    def __add__(self, other: Operand) -> Scalar:
        self.tally.add += 1
        return Scalar(self.value + float(other), self.tally)

    __radd__ = __add__

    @_each
    def __sub__(self, other: Operand) -> Scalar:
        self.tally.add += 1
        return Scalar(self.value - float(other), self.tally)

    @_each
    def __rsub__(self, other: Operand) -> Scalar:
        self.tally.add += 1
        return Scalar(float(other) - self.value, self.tally)

    @_each
    def __mul__(self, other: Operand) -> Scalar:
        self.tally.multiply += 1
        return Scalar(self.value * float(other), self.tally)

    __rmul__ = __mul__

    @_each
    def __truediv__(self, other: Operand) -> Scalar:
        self.tally.divide += 1
        return Scalar(_divide(self.value, float(other)), self.tally)

    @_each
    def __rtruediv__(self, other: Operand) -> Scalar:
        self.tally.divide += 1
        return Scalar(_divide(float(other), self.value), self.tally)

    @_each
    def __mod__(self, other: Operand) -> Scalar:
        """a - b floor(a / b): a divide, a multiply and an add."""
        self.tally.divide += 1
        self.tally.multiply += 1
        self.tally.add += 1
        return Scalar(self.value % float(other), self.tally)

    @_each
    def __pow__(self, exponent: Operand) -> Scalar:
        """A square is one multiply; any other power is a function."""
        if exponent == 2:
            self.tally.multiply += 1
        else:
            self.tally.function += 1
        return Scalar(self.value ** float(exponent), self.tally)

    def __neg__(self) -> Scalar:
        return Scalar(-self.value, self.tally)

    def __pos__(self) -> Scalar:
        return self

    def __abs__(self) -> Scalar:
        return Scalar(abs(self.value), self.tally)

    def __lt__(self, other: Operand) -> bool:
        return self.value < float(other)

    def __le__(self, other: Operand) -> bool:
        return self.value <= float(other)

    def __gt__(self, other: Operand) -> bool:
        return self.value > float(other)

    def __ge__(self, other: Operand) -> bool:
        return self.value >= float(other)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scalar | float | int) and self.value == float(other)

    def __hash__(self) -> int:
        return hash(self.value)

    def sqrt(self) -> Scalar:
        """What np.sqrt calls on an object."""
        self.tally.sqrt += 1
        return Scalar(math.sqrt(self.value), self.tally)


def _divide(a: float, b: float) -> float:
    """a / b as floating-point hardware does it: inf or nan, not an exception, for b = 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.float64(a) / b)


def _elementary(name: str) -> Callable[..., Scalar]:
    """The method of this name that NumPy's function of the same name calls on an object: counted as a function."""
    numpy_function = getattr(np, name)

    def method(self: Scalar, *others: Operand) -> Scalar:
        self.tally.function += 1
        return Scalar(float(numpy_function(self.value, *map(float, others))), self.tally)

    return method


for _name in ("sin", "cos", "tan", "arcsin", "arccos", "arctan", "arctan2", "exp", "log", "sinh", "cosh", "tanh"):
    setattr(Scalar, _name, _elementary(_name))


def _counting(value: Any, tally: Tally) -> Any:
    if isinstance(value, float):
        return Scalar(value, tally)
    if isinstance(value, np.ndarray):
        return _counting_array(value, tally)
    if isinstance(value, tuple):
        return like(value, [_counting(item, tally) for item in value])
    if isinstance(value, FunctionType):
        return lambda *arguments: _counting_result(value(*arguments), tally)
    return value


def _counting_result(result: Any, tally: Tally) -> Any:
    return _counting_array(result, tally) if isinstance(result, np.ndarray) else result


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
