"""What is said of a function that numba cannot compile."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import scipy.linalg as sl
from scipy.linalg import expm
from scipy.special import erf

from filters.backends.choose import function_for
from filters.backends.numba_error import gist, is_numbas


def by_module(x: float) -> Any:
    return sl.expm(x)


def by_name(x: float) -> Any:
    return expm(x)


def by_ufunc(x: float) -> Any:
    return erf(x)


@pytest.mark.parametrize(
    ("function", "called"), [(by_module, "scipy.linalg.expm"), (by_name, "expm"), (by_ufunc, "erf")]
)
def test_a_function_that_numba_does_not_know_is_named_with_its_line(function: Callable[..., Any], called: str) -> None:
    with pytest.raises(Exception, match=called.rpartition(".")[2]) as caught:
        function_for("compiled", function)(1.0)
    assert is_numbas(caught.value)
    said = gist(caught.value)
    assert said.startswith(f"it has no code for {called}, in test_numba_error.py, line ")
    assert said.endswith("; compute that with functions of NumPy or in loops")
