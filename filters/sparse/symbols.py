"""Numbers that remember what was done with them: a kernel run on them leaves behind what each of its results is.

What makes no difference to the last bit is not remembered: a product with one, a sum with zero, a sign that a sum can
take; and what is the same is there once, also with its two terms or factors in the other order. A product with zero is
zero, as it is of all numbers that are finite.
"""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

Operation: TypeAlias = Literal["given", "number", "+", "-", "*", "/", "negative", "sqrt"]


class Symbol:
    """A number: given, as an entry of an array; known; or made of others. Those of one `Symbols` alone go together."""

    def __init__(self, symbols: Symbols, operation: Operation, of: tuple[Any, ...], order: int) -> None:
        self._symbols = symbols
        self.operation = operation
        self.of: tuple[Any, ...] = of  # symbols; of what is given, the array and indices; of what is known, the number
        self.order = order  # later than all that it is made of

    def __add__(self, other: Any) -> Symbol:
        return self._symbols.sum(self, other)

    def __radd__(self, other: Any) -> Symbol:
        return self._symbols.sum(other, self)

    def __sub__(self, other: Any) -> Symbol:
        return self._symbols.difference(self, other)

    def __rsub__(self, other: Any) -> Symbol:
        return self._symbols.difference(other, self)

    def __mul__(self, other: Any) -> Symbol:
        return self._symbols.product(self, other)

    def __rmul__(self, other: Any) -> Symbol:
        return self._symbols.product(other, self)

    def __truediv__(self, other: Any) -> Symbol:
        return self._symbols.quotient(self, other)

    def __rtruediv__(self, other: Any) -> Symbol:
        return self._symbols.quotient(other, self)

    def __neg__(self) -> Symbol:
        return self._symbols.negative(self)

    def sqrt(self) -> Symbol:
        """What np.sqrt asks of an object."""
        return self._symbols.root(self)

    def __bool__(self) -> bool:
        raise TypeError("a kernel that asks for the value of a number has no straight line")


class Symbols:
    """All symbols of a kernel, each once."""

    def __init__(self) -> None:
        self._made: dict[tuple[Any, ...], Symbol] = {}

    def given(self, array: str, *indices: int) -> Symbol:
        """An entry of an array."""
        return self._one("given", array, *indices)

    def number(self, value: float) -> Symbol:
        """A number that is known."""
        return self._one("number", float(value))

    def sum(self, left: Any, right: Any) -> Symbol:
        a, b = self._symbol(left), self._symbol(right)
        if _is(a, 0.0):
            return b
        if _is(b, 0.0):
            return a
        if b.operation == "negative":
            return self.difference(a, b.of[0])
        if a.operation == "negative":
            return self.difference(b, a.of[0])
        return self._one("+", *_in_order(a, b))

    def difference(self, left: Any, right: Any) -> Symbol:
        a, b = self._symbol(left), self._symbol(right)
        if _is(a, 0.0):
            return self.negative(b)
        if _is(b, 0.0):
            return a
        if b.operation == "negative":
            return self.sum(a, b.of[0])
        return self._one("-", a, b)

    def product(self, left: Any, right: Any) -> Symbol:
        a, b = self._symbol(left), self._symbol(right)
        if _is(a, 0.0) or _is(b, 0.0):
            return self.number(0.0)
        if _is(a, 1.0):
            return b
        if _is(b, 1.0):
            return a
        if a.operation == "negative":
            return self.negative(self.product(a.of[0], b))
        if b.operation == "negative":
            return self.negative(self.product(a, b.of[0]))
        return self._one("*", *_in_order(a, b))

    def quotient(self, left: Any, right: Any) -> Symbol:
        a, b = self._symbol(left), self._symbol(right)
        if _is(a, 0.0):
            return a
        if _is(b, 1.0):
            return a
        return self._one("/", a, b)

    def negative(self, value: Any) -> Symbol:
        a = self._symbol(value)
        if a.operation == "number":
            return self.number(-a.of[0] if a.of[0] else 0.0)
        positive: Symbol = a.of[0] if a.operation == "negative" else self._one("negative", a)
        return positive

    def root(self, a: Any) -> Symbol:
        return self._one("sqrt", self._symbol(a))

    def _symbol(self, value: Any) -> Symbol:
        return value if isinstance(value, Symbol) else self.number(value)

    def _one(self, operation: Operation, *of: Any) -> Symbol:
        key = operation, *of
        if key not in self._made:
            self._made[key] = Symbol(self, operation, of, len(self._made))
        return self._made[key]


def _in_order(a: Symbol, b: Symbol) -> tuple[Symbol, Symbol]:
    """The older first."""
    return (a, b) if a.order <= b.order else (b, a)


def _is(a: Symbol, value: float) -> bool:
    return a.operation == "number" and a.of[0] == value
