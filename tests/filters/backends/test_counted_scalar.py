"""The number that counts: its operators, and that it is never a plain float by accident."""

from __future__ import annotations

import cmath
from collections.abc import Callable
from decimal import Decimal
from typing import Any

import numpy as np
import pytest

from filters.backends.counted_scalar import Scalar, Tally, UncountedError


@pytest.mark.parametrize(
    ("operation", "value", "counted"),
    [
        (lambda x: 7.0 // x, 2.0, Tally(divide=1)),
        (lambda x: x // 2.0, 1.0, Tally(divide=1)),
        (lambda x: 7.0 % x, 1.0, Tally(divide=1, multiply=1, add=1)),
        (lambda x: 2.0**x, 8.0, Tally(function=1)),
        (round, 3.0, Tally()),
        (lambda x: x // 0.0, np.inf, Tally(divide=1)),
    ],
)
def test_operators(operation: Callable[[Any], Scalar], value: float, counted: Tally) -> None:
    tally = Tally()
    assert operation(Scalar(3.0, tally)).value == value
    assert tally == counted


def test_questions_cost_nothing() -> None:
    tally = Tally()
    x, row = Scalar(0.0, tally), np.array([-1.0, 1.0])
    assert not x
    assert Scalar(1.0, tally)
    assert (x > row).tolist() == (row < x).tolist() == [True, False]
    assert f"{x:.1f} {x} {x!s}" == "0.0 0.0 0.0"
    assert tally == Tally()


@pytest.mark.parametrize("conversion", [float, int, complex, cmath.exp, np.float64, Decimal])
def test_it_becomes_no_plain_number(conversion: Callable[[Any], Any]) -> None:
    with pytest.raises(TypeError):
        conversion(Scalar(1.0, Tally()))


def test_nothing_is_stored_as_a_plain_float() -> None:
    with pytest.raises(UncountedError, match="it makes a plain float"):
        np.zeros(1)[0] = Scalar(1.0, Tally())
