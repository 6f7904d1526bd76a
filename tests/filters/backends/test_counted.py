"""Counting scalars: what is counted, what is not, and that the values come out right."""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import njit

from filters.backends.counted import Operations, count
from filters.backends.counted_scalar import Scalar, Tally
from filters.backends.uncountable import UncountableError


class Pair(NamedTuple):
    gain: float
    values: Any


def test_kinds_of_operations() -> None:
    def work(a: Any, b: Any) -> None:
        results = [a + b, 1.0 + a, a - b, 1.0 - a, a * b, 2.0 * a, a / b, 1.0 / a, a**2, a**3, -a, +a, abs(a)]
        assert [float(result) for result in results] == [7, 4, -1, -2, 12, 6, 0.75, 1 / 3, 9, 27, -3, 3, 3]
        assert a < b
        assert b >= a
        assert a <= 3.0
        assert b > 3.0
        assert a == 3.0

    assert count(work, 3.0, 4.0) == Operations(multiply=3, add=4, divide=2, function=1)


def test_functions_of_numpy() -> None:
    def work(x: Any, row: Any) -> None:
        assert float(np.sqrt(x)) == 2.0
        assert float(np.sin(x)) == np.sin(4.0)
        assert float(np.arctan2(x, x)) == np.arctan2(4.0, 4.0)
        np.cos(row)
        row @ row

    assert count(work, 4.0, np.ones(3)) == Operations(multiply=3, add=2, sqrt=1, function=5)


def test_a_scalar_counts_with_each_entry_of_an_array_on_either_side() -> None:
    def work(x: Any, row: Any) -> None:
        for result in (x * row, row * x, x + row, row + x, x - row, row - x, x / row, row / x, x**row):
            assert len(result) == 2
        assert [float(item) for item in x - row] == [3.0, 2.0]
        assert [float(item) for item in row / x] == [0.25, 0.5]

    found = count(work, 4.0, np.array([1.0, 2.0]))
    assert found == Operations(multiply=5, add=10, divide=6, function=1)  # x**1 is a function, x**2 a multiply


def test_records_and_functions_inside_the_arguments_count() -> None:
    def model(x: Any) -> Any:
        matrix = np.eye(2)
        matrix[0, 1] = x * x
        return matrix

    def work(functions: tuple[Any, ...], record: Pair, whole: int, out: Any) -> None:
        matrix = functions[0](record.gain)
        out[0] = matrix[0, 0] + matrix[1, 1]  # ones that the model wrote count from here on
        out[1] = record.values[whole]

    assert count(work, (model,), Pair(2.0, np.ones(3)), 1, np.zeros(2)) == Operations(multiply=1, add=1)


def test_what_a_function_fills_counts_from_then_on_constants_too() -> None:
    def fill(out: Any) -> None:
        out[0] = 3.0
        out[1] = 1

    def work(functions: tuple[Any, ...], out: Any) -> None:
        functions[0](out)
        out[0] * out[1]

    assert count(work, (fill,), np.zeros(2)) == Operations(multiply=1)


class Model:
    """A model whose functions are methods."""

    gain = 2.0

    def square(self, x: Any) -> Any:
        matrix = np.zeros((2, 2))
        matrix[0, 1] = self.gain * x
        return matrix @ matrix


@pytest.mark.parametrize("function", [Model().square, partial(Model.square, Model())])
def test_methods_and_partial_functions_are_counted(function: Any) -> None:
    assert count(lambda functions, x: functions[0](x), (function,), 1.0) == Operations(multiply=5, add=3)


@njit  # type: ignore[misc]
def jitted(x: Any) -> Any:
    return np.sin(x)


@pytest.mark.parametrize("function", [jitted, lambda x: jitted(x)])
def test_functions_that_numba_compiles_are_counted_as_they_are_written(function: Any) -> None:
    assert count(lambda functions, x: functions[0](x), (function,), 1.0) == Operations(function=1)


def test_what_cannot_be_counted_is_refused_with_its_line() -> None:
    def of_table(x: Any) -> Any:
        return np.interp(x, [0.0, 1.0], [1.0, 2.0])

    with pytest.raises(
        UncountableError, match=r"^of_table\(\) in test_counted.py, line \d+: np.interp\(x, .* cannot be"
    ):
        count(lambda functions, x: functions[0](x), (of_table,), 0.5)


def test_arguments_are_not_changed() -> None:
    def work(values: Any) -> None:
        values[0] = values[1] * 2.0

    values = np.ones(2)
    count(work, values)
    np.testing.assert_array_equal(values, np.ones(2))


def test_division_by_zero_is_that_of_the_hardware() -> None:
    assert (Scalar(1.0, Tally()) / 0.0).value == np.inf
    assert np.isnan((0.0 / Scalar(0.0, Tally())).value)
    assert np.isnan((Scalar(-1.0, Tally()) ** 0.5).value)


def test_counts_add_up() -> None:
    both = Operations(1, 2, 3, 4, 5) + Operations(10, 20, 30, 40, 50)
    assert both == Operations(11, 22, 33, 44, 55)
    assert both.total == 165


def test_a_remainder_is_a_divide_a_multiply_and_an_add() -> None:
    def turned(angle: np.ndarray, out: np.ndarray) -> None:
        out[0] = angle[0] % 6.0

    out = np.zeros(1)
    assert count(turned, np.array([8.0]), out) == Operations(multiply=1, add=1, divide=1)
