"""Clones that call other versions of what they called."""

from __future__ import annotations

from types import FunctionType, ModuleType
from typing import Any

import numpy as np
import scipy.linalg
from numpy import eye
from scipy.linalg import expm

from filters.backends.dependencies import Dependencies
from filters.backends.rebind import Versions


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


def as_it_is(clone: FunctionType, _original: FunctionType, _known: Dependencies) -> Any:
    return clone


WITH_100 = Versions(as_it_is, given={leaf: lambda _: 100})


def test_a_callee_is_replaced_wherever_it_is_called() -> None:
    assert WITH_100.of(middle)(1) == 300
    assert middle(1) == 5


def test_a_callee_in_a_closure_is_replaced() -> None:
    outer = closing_over(middle, bonus=7)
    clone = WITH_100.of(outer)
    assert clone(1) == 607
    assert clone(1, twice=1) == 307
    assert outer(1) == 17


def test_a_callee_in_a_module_a_tuple_or_a_default_is_replaced() -> None:
    module = ModuleType("module")
    module.leaf, module.itself = leaf, module  # type: ignore[attr-defined]
    pair = (leaf, 1)

    def by_module(x: int) -> int:
        return module.itself.leaf(x)

    def by_tuple(x: int) -> int:
        return pair[0](x)

    def by_default(x: int, call: Any = leaf, *, other: Any = leaf) -> int:
        return int(call(x) + other(x))

    assert [WITH_100.of(function)(1) for function in (by_module, by_tuple, by_default)] == [100, 100, 200]
    assert [function(1) for function in (by_module, by_tuple, by_default)] == [2, 2, 4]


def test_what_numba_knows_by_itself_is_left() -> None:
    def identity(n: int) -> Any:
        return np.eye(n), eye(n)

    wrapped: list[str] = []

    def wrap(clone: FunctionType, original: FunctionType, _known: Dependencies) -> Any:
        wrapped.append(original.__name__)
        return clone

    Versions(wrap).of(identity)
    assert wrapped == ["identity"]


def test_every_version_is_wrapped_once_until_something_changes() -> None:
    wrapped: list[str] = []

    def wrap(clone: FunctionType, original: FunctionType, _known: Dependencies) -> Any:
        wrapped.append(original.__name__)
        return clone

    constant = np.ones(1)

    def use(x: float) -> float:
        return float(constant[0]) + leaf(int(x))

    versions = Versions(wrap)
    first = versions.of(use)
    assert versions.of(use) is first
    constant[0] = 2.0
    second = versions.of(use)
    assert wrapped == ["use", "leaf", "use"]
    assert (first(1), second(1), use(1)) == (3.0, 4.0, 4.0)


def test_a_recursive_function_calls_its_clone() -> None:
    calls: list[int] = []

    def wrap(clone: FunctionType, _original: FunctionType, _known: Dependencies) -> Any:
        def noted(n: int) -> int:
            calls.append(n)
            return int(clone(n))

        return noted

    assert Versions(wrap).of(factorial)(4) == 24
    assert calls == [4, 3, 2, 1, 0]


def test_a_function_of_an_installed_library_is_called_as_it_is() -> None:
    def by_module(A: Any) -> Any:
        return scipy.linalg.expm(A)

    def by_name(A: Any) -> Any:
        return expm(A)

    wrapped: list[str] = []

    def wrap(clone: FunctionType, original: FunctionType, _known: Dependencies) -> Any:
        wrapped.append(original.__name__)
        return clone

    versions = Versions(wrap)
    for function in (by_module, by_name):
        np.testing.assert_array_equal(versions.of(function)(np.zeros((2, 2))), np.eye(2))
    assert wrapped == ["by_module", "by_name"]


def test_what_is_no_function_of_ours_is_replaced_by_what_stands_for_it() -> None:
    table = np.ones(2)

    def use() -> Any:
        return len(table), np, float

    seen: list[Any] = []

    def outside(value: Any) -> Any:
        seen.append(value)
        return "ab"

    assert Versions(as_it_is, outside=outside, builtins={"float": str}).of(use)() == (2, "ab", str)
    assert any(value is np for value in seen)
    assert any(value is not table and value is not np and value.tolist() == [1.0, 1.0] for value in seen)
