"""What is said of what cannot be counted."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
import scipy.linalg

from filters.backends.counted import Operations, count
from filters.backends.uncountable import UncountableError, uncountable
from filters.kernels.dense import matmul

KEPT = {"last": np.zeros(1)}


def keeping(x: Any) -> Any:
    KEPT["last"][0] = x
    return x


def said(function: Any, *arguments: Any) -> str:
    with pytest.raises(UncountableError) as caught:
        count(function, *arguments)
    return str(caught.value)


def test_the_function_the_line_the_expression_the_reason_and_the_remedy() -> None:
    line = keeping.__code__.co_firstlineno + 1
    assert said(keeping, 1.0) == (
        f'keeping() in test_uncountable.py, line {line}: KEPT["last"][0] cannot be counted: it makes a plain float of '
        "a number that is counted; write it with + - * / and functions of single numbers, such as np.sin or math.sin, "
        "in arrays of its own"
    )


def test_the_function_around_a_comprehension_is_named() -> None:
    def inverses(x: Any) -> Any:
        return [np.linalg.inv(np.diag([each])) for each in x]

    assert said(inverses, np.ones(2)).startswith("inverses() in ")


def test_the_users_line_is_named_before_that_of_a_kernel_of_ours() -> None:
    def wrong(x: Any) -> Any:
        matmul(x, x, None)  # type: ignore[arg-type]

    assert said(wrong, np.ones((2, 2))).startswith("wrong() in test_uncountable.py")


def test_an_expression_of_several_lines_is_its_first() -> None:
    def long(x: Any) -> Any:
        return np.linalg.inv(
            x,
        )

    assert ": return np.linalg.inv( cannot be counted" in said(long, np.ones((2, 2)))


def test_an_error_of_nobodys_function_is_left() -> None:
    assert uncountable(TypeError("raised nowhere")) is None
    with pytest.raises(TypeError, match="argument"):
        count(print, sep=1)  # type: ignore[call-arg]


@pytest.mark.parametrize(
    "source", ["def f(x):\n    return np.linalg.inv(x)", "def f(x):\n    return complex(\n    x[0, 0])"]
)
def test_what_has_no_source_is_not_quoted(source: str) -> None:
    """As in code from standard input or from exec."""
    names: dict[str, Any] = {"np": np}
    exec(source, names)
    assert said(names["f"], np.eye(2)).startswith("f() in <string>, line 2: what it does cannot be counted: it ")


@pytest.mark.parametrize(
    ("function", "arguments", "name"),
    [
        (np.linalg.inv, (np.eye(3),), "inv"),
        (np.linalg.solve, (np.eye(3), np.ones(3)), "solve"),
        (partial(np.linalg.inv), (np.eye(3),), "inv"),
        (math.fsum, (np.ones(3),), "fsum"),
    ],
)
def test_a_librarys_function_by_itself_is_named(function: Any, arguments: tuple[Any, ...], name: str) -> None:
    assert said(function, *arguments).startswith(f"{name}() cannot be counted: it ")


def test_a_librarys_function_in_python_by_itself_is_named() -> None:
    assert said(scipy.linalg.expm, np.eye(3)).startswith("expm() cannot be counted; write it with ")


@pytest.mark.parametrize("function", [math.sin, np.sin, math.erf])
def test_a_function_of_a_single_number_is_counted_by_itself_and_as_an_argument(function: Any) -> None:
    def called(inner: Any, x: Any) -> Any:
        return inner(x)

    assert count(function, 1.0) == count(called, function, 1.0) == Operations(function=1)


def test_a_wrong_call_is_left() -> None:
    with pytest.raises(TypeError, match="missing 1 required positional argument"):
        count(keeping)
