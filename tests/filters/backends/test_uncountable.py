"""What is said of what cannot be counted."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.backends.counted import count
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
