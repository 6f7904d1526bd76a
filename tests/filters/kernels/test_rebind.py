"""Clones that call other versions of what they called."""

from __future__ import annotations

from types import FunctionType
from typing import Any

from filters.kernels.rebind import callees, rebind


def leaf(x: int) -> int:
    return x + 1


def middle(x: int) -> int:
    return leaf(x) + sum(leaf(item) for item in range(2))


def factorial(n: int) -> int:
    return 1 if n == 0 else n * factorial(n - 1)


def closing_over(inner: Any, bonus: int) -> Any:
    def outer(x: int, *, twice: int = 2) -> int:
        return int(inner(x)) * twice + bonus

    return outer


def unchanged(clone: FunctionType, _original: FunctionType) -> Any:
    return clone


def test_a_callee_is_replaced_wherever_it_is_called() -> None:
    clone = rebind(middle, unchanged, {leaf: lambda _: 100})
    assert clone(1) == 300
    assert middle(1) == 5


def test_a_callee_in_a_closure_is_replaced() -> None:
    outer = closing_over(middle, bonus=7)
    clone = rebind(outer, unchanged, {leaf: lambda _: 100})
    assert clone(1) == 607
    assert clone(1, twice=1) == 307
    assert outer(1) == 17


def test_every_version_is_wrapped_once() -> None:
    wrapped: list[str] = []

    def wrap(clone: FunctionType, original: FunctionType) -> Any:
        wrapped.append(original.__name__)
        return clone

    rebind(middle, wrap, {})
    assert wrapped == ["middle", "leaf"]


def test_a_recursive_function_calls_its_clone() -> None:
    calls: list[int] = []

    def wrap(clone: FunctionType, _original: FunctionType) -> Any:
        def noted(n: int) -> int:
            calls.append(n)
            return int(clone(n))

        return noted

    assert rebind(factorial, wrap, {})(4) == 24
    assert calls == [4, 3, 2, 1, 0]


def test_callees() -> None:
    assert callees(middle) == {"leaf": leaf}
    assert callees(closing_over(leaf, 0)) == {"inner": leaf}
