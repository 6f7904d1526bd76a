"""What functions of single numbers count as."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.special import erf

from filters.backends.counted_functions import OF_MATH, elementwise
from filters.backends.counted_scalar import Scalar, Tally

FUNCTION, SQRT, MULTIPLY, NOTHING = Tally(function=1), Tally(sqrt=1), Tally(multiply=1), Tally()


@pytest.mark.parametrize(
    ("names", "counted"),
    [
        ("sin cos tan arcsin arccos arctan sinh cosh tanh arcsinh arctanh", FUNCTION),
        ("exp exp2 expm1 log log2 log10 log1p cbrt", FUNCTION),
        ("sqrt", SQRT),
        ("degrees radians deg2rad rad2deg", MULTIPLY),
        ("floor ceil trunc rint fabs sign isnan isinf isfinite", NOTHING),
    ],
)
def test_functions_of_numpy(names: str, counted: Tally) -> None:
    for name in names.split():
        function, tally = getattr(np, name), Tally()
        version = elementwise(function)
        assert version is not None
        result = version(Scalar(0.25, tally))
        assert getattr(result, "value", result) == function(0.25)
        assert tally == counted, name


@pytest.mark.parametrize("name", ["hypot", "fmod", "arctan2", "logaddexp"])
def test_functions_of_two_numbers(name: str) -> None:
    tally, function = Tally(), getattr(np, name)
    version: Any = elementwise(function)
    assert version(Scalar(0.75, tally), 0.5).value == version(0.75, Scalar(0.5, tally)).value == function(0.75, 0.5)
    assert tally == Tally(function=2)


def test_functions_of_scipy() -> None:
    tally, version = Tally(), elementwise(erf)
    assert version is not None
    assert version(Scalar(0.5, tally)).value == erf(0.5)
    assert tally == FUNCTION


def test_arrays_may_hold_constants_beside_numbers_that_count() -> None:
    tally = Tally()
    row = np.array([Scalar(0.25, tally), 0.25], dtype=object)
    sine: Any = elementwise(np.sin)
    assert [getattr(item, "value", item) for item in sine(row)] == [np.sin(0.25)] * 2
    assert tally == FUNCTION
    is_nan: Any = elementwise(np.isnan)
    assert is_nan(row).dtype == bool


@pytest.mark.parametrize("function", [np.add, np.matmul, np.modf, np.frompyfunc(abs, 1, 1)])
def test_others_are_left_to_operators(function: np.ufunc) -> None:
    assert elementwise(function) is None


@pytest.mark.parametrize(
    ("function", "arguments", "counted"),
    [
        (math.sin, (0.25,), FUNCTION),
        (math.atan2, (0.25, 2.0), FUNCTION),
        (math.erf, (0.25,), FUNCTION),
        (math.hypot, (0.25, 2.0, 3.0), FUNCTION),
        (math.log, (0.25,), FUNCTION),
        (math.log, (0.25, 2.0), Tally(function=1, divide=1)),
        (math.pow, (0.25, 2.0), MULTIPLY),
        (math.pow, (0.25, 3.0), FUNCTION),
        (math.sqrt, (0.25,), SQRT),
        (math.radians, (0.25,), MULTIPLY),
        (math.floor, (0.25,), NOTHING),
        (math.isnan, (0.25,), NOTHING),
    ],
)
def test_functions_of_math(function: Callable[..., Any], arguments: tuple[float, ...], counted: Tally) -> None:
    tally = Tally()
    result = OF_MATH[function](Scalar(arguments[0], tally), *arguments[1:])
    assert getattr(result, "value", result) == function(*arguments)
    assert tally == counted
