"""What a function depends on: every constant that can reach its machine code, by value, the same in every process."""

from __future__ import annotations

import enum
import os
import subprocess
import sys
from collections.abc import Callable
from types import FunctionType, ModuleType
from typing import Any, NamedTuple, cast

import numpy as np
import pytest
from scipy.linalg import expm

from filters.backends.dependencies import dependencies
from filters.delayed.standard import filter_all
from filters.modular import recalculate
from filters.robust import run


class Record(NamedTuple):
    gain: Any
    call: Any = None


def naming(value: Any) -> FunctionType:
    """A function with a value in its closure."""
    return cast(FunctionType, lambda: value)


def by_default(value: Any) -> FunctionType:
    def function(x: Any = value) -> Any:
        return x

    return function


def by_keyword(value: Any) -> FunctionType:
    def function(*, x: Any = value) -> Any:
        return x

    return function


def in_nested_code(value: Any) -> FunctionType:
    def function() -> Any:
        return [value for _ in range(2)]

    return function


def in_a_callee(value: Any) -> FunctionType:
    callee = naming(value)
    return cast(FunctionType, lambda: callee())


def in_source(value: Any) -> FunctionType:
    names: dict[str, Any] = {}
    exec(f"def function(): return {value!r}", names)
    return cast(FunctionType, names["function"])


def in_a_module(value: Any) -> ModuleType:
    module = ModuleType("constants")
    module.DT = value  # type: ignore[attr-defined]
    return module


def by_attribute(value: Any) -> FunctionType:
    constants = in_a_module(value)
    return cast(FunctionType, lambda: constants.DT)


def by_alias(value: Any) -> FunctionType:
    constants = in_a_module(value)

    def function() -> Any:
        again = constants
        return again.DT

    return function


def by_getattr(value: Any) -> FunctionType:
    constants = in_a_module(value)
    return cast(FunctionType, lambda: getattr(constants, "DT"))  # noqa: B009


def in_a_submodule(value: Any) -> FunctionType:
    package = ModuleType("package")
    package.constants = in_a_module(value)  # type: ignore[attr-defined]
    return cast(FunctionType, lambda: package.constants.DT)


def by_a_function_of_a_module(value: Any) -> FunctionType:
    package = ModuleType("package")
    package.call = by_attribute(value)  # type: ignore[attr-defined]
    return cast(FunctionType, lambda: package.call())


WAYS = (
    naming,
    by_default,
    by_keyword,
    in_nested_code,
    in_a_callee,
    by_attribute,
    by_alias,
    by_getattr,
    in_a_submodule,
    by_a_function_of_a_module,
)
VALUES: dict[str, Callable[[int], Any]] = {
    "integer": lambda v: v,
    "4,300 digits and more": lambda v: 10**5000 + v,
    "float": lambda v: v / 10,
    "sign of zero": lambda v: (-1) ** v * 0.0,
    "type of number": lambda v: 1 if v == 1 else 1.0,
    "truth": lambda v: True if v == 1 else 1,
    "text": lambda v: "ab"[v - 1],
    "NumPy's number": np.float64,
    "array": lambda v: np.array([0, v]),
    "shape": lambda v: np.zeros((v, 2 // v)),
    "order": lambda v: np.ones((2, 2), order="C" if v == 1 else "F"),
    "kind of array": lambda v: np.zeros(4, f"f{4 * v}"),
    "kind": lambda v: np.dtype(f"f{4 * v}"),
    "tuple in a tuple": lambda v: (1, (2.0, v)),
    "where a tuple ends": lambda v: ((1, 2), 3) if v == 1 else (1, (2, 3)),
    "record": Record,
    "function in a record": lambda v: Record(1, naming(v)),
    "member": lambda v: enum.Enum("Mode", {"GAIN": v}).GAIN,  # type: ignore[attr-defined]
    "members": lambda v: enum.Enum("Mode", {"GAIN": v}),
    "defaults of a record": lambda v: NamedTuple("Pair", [("x", int)]) if v == 1 else Record,
    "function": in_source,
    "library's function": lambda v: (np.sin, np.cos)[v - 1],
}


@pytest.mark.parametrize("way", WAYS)
def test_a_constant_counts_however_it_is_reached(way: Callable[[Any], FunctionType]) -> None:
    assert dependencies(way(1)) == dependencies(way(1))
    assert dependencies(way(1)) != dependencies(way(2))
    assert not dependencies(way(1)).opaque


@pytest.mark.parametrize("kind", VALUES)
def test_every_kind_of_constant_counts_by_its_value(kind: str) -> None:
    value = VALUES[kind]
    assert dependencies(by_attribute(value(1))) == dependencies(by_attribute(value(1)))
    assert dependencies(by_attribute(value(1))).digest != dependencies(by_attribute(value(2))).digest
    assert not dependencies(by_attribute(value(1))).opaque


@pytest.mark.parametrize("value", [object(), {"gain": 1}, [1], np.array([object()]), sys.stdout, Record.gain])
def test_what_has_no_value_is_known_by_identity_only(value: Any) -> None:
    assert dependencies(by_attribute(value)).opaque == (value,)


def test_attributes_of_a_module_that_the_function_does_not_name_do_not_count() -> None:
    constants = in_a_module(1)
    function = cast(FunctionType, lambda: constants.DT)
    before = dependencies(function)
    constants.OTHER = object()  # type: ignore[attr-defined]
    assert dependencies(function) == before


def test_what_a_module_says_of_how_its_functions_are_compiled_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    kernel = sys.modules[filter_all.__module__]
    before = dependencies(filter_all).digest
    monkeypatch.setattr(kernel, "ALLOCATION_FREE", True, raising=False)
    assert dependencies(filter_all).digest != before


def test_modules_and_functions_that_name_each_other_are_walked_once() -> None:
    package = ModuleType("package")
    package.itself = package  # type: ignore[attr-defined]

    def function(n: int) -> Any:
        return function(n - 1) if n else package.itself.itself

    assert dependencies(function) == dependencies(function)


def test_a_function_of_an_installed_library_is_known_by_identity() -> None:
    assert dependencies(naming(expm)).opaque == (expm,)


@pytest.mark.parametrize("function", [filter_all, run.step_all, recalculate.filter_all])
def test_filters_can_be_kept_on_disk(function: FunctionType) -> None:
    assert not dependencies(function).opaque


def test_digests_are_the_same_in_every_process() -> None:
    program = (
        "from filters.backends.dependencies import dependencies\n"
        "from filters.delayed.standard import filter_all\n"
        "flags = lambda x: x in {'a', 'b', 'c'}\n"
        "print(*(dependencies(function).digest for function in (filter_all, flags)))"
    )
    runs = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONHASHSEED": seed},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(runs) == 1
