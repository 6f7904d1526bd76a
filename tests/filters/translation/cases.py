"""Run the same function in Python and in C, and compare all that it leaves."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from filters.backends.in_c import in_c

HAS_COMPILER = any(map(shutil.which, ("cc", "gcc", "clang")))
needs_compiler = pytest.mark.skipif(not HAS_COMPILER, reason="there is no C compiler here")


def copied(value: Any) -> Any:
    """With arrays of its own."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, tuple):
        items = [copied(item) for item in value]
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    return value


def numbers(value: Any) -> Iterator[np.ndarray[Any, Any]]:
    """All that it holds."""
    if isinstance(value, tuple):
        for item in value:
            yield from numbers(item)
    elif isinstance(value, np.ndarray | float | int | np.generic):
        yield np.asarray(value)


def check_same(function: Callable[..., Any], *arguments: Any, rtol: float = 0.0) -> None:
    """What it returns and what it writes, to the last bit unless rtol says otherwise."""
    ours, theirs = copied(arguments), copied(arguments)
    with np.errstate(all="ignore"):
        expected = function(*ours)
    found = in_c(function)(*theirs)
    for one, other in zip(numbers((found, theirs)), numbers((expected, ours)), strict=True):
        if rtol:
            np.testing.assert_allclose(one, other, rtol=rtol, atol=rtol)
        else:
            np.testing.assert_array_equal(one, other)
